#!/bin/bash
# Makes evidence/profile.md: where the instructions of a steady audio sample go, of six jobs (tests/bench/profile.py; about 8 minutes). Needs valgrind and python3. REPEATS (5) rounds of
# timing; RASP: another program than $BUILD/rasp.
# The figures of 18f57f9 in evidence/profile_before.txt were made once, on the machine of profile.md:
#     git worktree add ../before 18f57f9 && make -C ../before BUILD=/tmp/before /tmp/before/rasp
#     RAW=1 RASP=/tmp/before/rasp evidence/profile.sh
# and those of 1968b6b, beside the coupled ball's, in the same way with ONLY=coupled.
# ONLY: a part of the jobs' names in tests/bench/pipeline.py; prints their tables, and makes no report.
# RAW=1 prints lines `job|part|instructions a sample`, as that file has them, and makes no report.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export ROOT BUILD REPEATS=${REPEATS:-5} LC_ALL=C
command -v valgrind > /dev/null || { echo "valgrind is not installed: skipped"; exit 0; }
make -C "$ROOT" -s BUILD="$BUILD" "$BUILD/bench/yardstick"
BEFORE=$ROOT/evidence/profile_before.txt
if [ -n "${RAW:-}" ]; then
    python3 -B "$ROOT/tests/bench/profile.py" 2> /dev/null
    exit
fi
if [ -n "${ONLY:-}" ]; then
    python3 -B "$ROOT/tests/bench/profile.py" "$BEFORE" 2> /dev/null
    exit
fi
RESULT=$(mktemp)
trap 'rm -f "$RESULT"' EXIT
{
    echo '# Where the time of a steady sample goes'
    echo
    echo 'Made by `evidence/profile.sh`. 50 modes, 44.1 kHz, a stroke of 10 cm to and fro each second, 24-bit WAV. Instructions are those of one sample, by callgrind: a render of 4 s less one of'
    echo '2 s, over the samples between; each function counts by itself, where its source belongs. They are the same on a busy machine. Valgrind has AVX2 and no AVX-512, and no instructions'
    echo 'for SHA-256: the checksum of a file takes a fifteenth of its instructions in cycles. Work in the kernel is not counted. Cycles are of the core clock,'
    echo "the least of $REPEATS interleaved rounds (22 s less 2 s), kernel and all, of: $(sed -n 's/^model name[^:]*: //p;T;q' /proc/cpuinfo), load $(cut -d' ' -f1 /proc/loadavg); beside them the same over the"
    echo 'scalar loop of 50 modes, timed in the same run. Columns `at 18f57f9` and `at 1968b6b` are fixed: counted once on those commits.'
    python3 -B "$ROOT/tests/bench/profile.py" "$BEFORE" 2> /dev/null
    cat << 'END'

## Goals that are not reached

Goals are in cycles a sample of a core of 3.6 GHz (evidence/bench.sh); what takes the difference, as far as the tables show it:

- **1-D profile, 90 cycles (115 with CSV):** a third of draft's instructions is the modes' (6 multiplications and 7 additions per mode and sample, without contraction, so that the
  bytes are the same everywhere), which two units of eight lanes cannot do in less than 46 cycles: half the goal. Nearly all the rest is done piece by piece between
  knots, about two pieces a sample: cutting, the slope, which goes from piece to piece, and the closed-form means of tanh, more than 40 % together. Standard has four
  sub-intervals a sample, and these three are most of it.
- **2-D map with CSV, 170 cycles:** the same three, on twice the pieces (each is halved for its bulge), are nearly half; the map's 16 coefficients a point are a sixth, table and its checksum a
  ninth.
- **Given force, at rest, 45 cycles:** the recursion alone takes 11 operations per mode and sample, 39 cycles on two units. Beside it stand reading the force (8 bytes a sample,
  read twice: for the checksum, and for itself), its checksum, and the kernel's part in both, which the instructions do not show.
- **Coupled ball, implicit, 272 cycles a step (300 times real time at one step a sample):** a step of ball and 50 modes that is called for by itself (tests/bench/coupled.c) takes 230 cycles of this CPU with
  AVX-512, 160 without modes: 11 multiplications and 10 additions a mode, which one CPU of two units does in 74 cycles, laid between the pieces of the search for the force, a chain of
  a root and two divisions. (At 1968b6b it took 420; and what begins and ends a run of steps, 1900 cycles, was paid each sample, now once in up to 64.) The goal
  was set on a prototype that did nothing else; here each step reads its place on the curve, where the ball rests on a piece of it by Newton's method (110 cycles, eight places at a
  time; 370 one at a time), and a sample has its sound besides: trajectory, decimation, the same 50 modes as they ring, WAV: 250 cycles, which alone is nearly the goal.
- **rk4, 82 cycles a step:** each of its four stages goes over all modes, and each waits for the one before. As the modes are linear, all four could be had from one pass and scalars; this is not done.
- **A finished tail** still pays for the motion's and the force's zeros, sample by sample, and for the WAV: what is left when the modes are at rest.
END
} > "$RESULT"
cat "$RESULT" > "$ROOT/evidence/profile.md"

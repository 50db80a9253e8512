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
- **2-D roughness with CSV, 170 cycles (58 of 480 times real time at draft):** 1399 cycles, 1290 of them the scrape's (in another run 1472 and 1315, and 1773 and 1589 of the commit before its lattice was kept). Of 3500 instructions a sample (5180) the
  ground's second derivatives take 600 (2280; 284 on the map of the row above): it has no end and does not repeat, so that the lattice of its splines is made where the contact goes, in patches of which some
  10 MB are kept, the last that were read (`src/surface/patches.c`): what a motion to and fro has met before, up to 13 cm of way at 20 um, is not made again. On a way that does not come back making takes 780
  instructions a sample (1240), and less is kept, so that the tiles that it is made of stay in the CPU's second cache. The lattice is finer than that map's 50 um, so there are more pieces: the limiter
  takes 1070 (320 there), cutting 650 (237), the slope 480 (190).
- **32 recorded responses, 136 cycles (88 of 600 times real time):** 930. Of 2870 instructions a sample 1110 find, for each sample, which responses the place lies between and with what shares (`share_places`,
  `places_plane_at`), some 1200 are the transforms of blocks of 2048 and products of spectra, 220 the checksum of the force. Places found once in some samples and shares ramped between would take most of
  the first away, with an error to be kept like that of ramped gains; it is not done.
- **Given force, moving contact, 45 cycles (464 of 1800 times real time; glide costs the same where poles are alike everywhere, as on this plate):** 176 cycles. Beside what the object at rest pays, gains are ramped: `ring` takes 253 instructions, `ring_steady` 218; the checksum of the
  force 223 and the places the rest. What would do is less to read: the file of forces is 8 bytes a sample, read twice.
- **Start-up, 3 ms: 4.0 ms wall, 3.2 ms CPU** (4.9 and 3.7, 8.8 and 4.3 in other runs). Of 16.4 million instructions (callgrind) 21 % clear memory, 13 % decimate and 8 % resonate the sound that the tiny scene has, 5 % copy, 7 % and more link shared libraries, 5 %
  tell which keys decide on which. Fewer pages to clear, and linking statically, would save most; neither is done.
- **Stimuli of 2 s a second, 98 of 300 (with CSV at 1 kHz), 22 of 38 (ten columns at 44.1 kHz):** 37 million cycles a stimulus, 28 of which are 88200 samples at 315 cycles: the goal, 12 million, is that of the 1-D profile once
  more, and the other 9 are start and end of each render. Of 164 million with the large table some 127 are its own, see CSV.
- **CSV, 500 MB/s: 499 in memory (`tests/bench/decimal.c`: 25.9 ns a number, 7.7 times printf's speed; 479 in another run), 277 to 319 from end to end (`tests/bench/pipeline.py`):** of the 5660 instructions that a row of ten columns adds, 1570 turn numbers into
  text, 3280 are its checksum (SHA-256; far less of the cycles where the CPU has instructions for it), 225 put lines together, 210 and more gather columns; the kernel's copying comes on top. A checksum on a
  thread of its own would hide it; of one core it would not.
- **.npy, 2.5 times the render without: 3.6 with ten columns, 4.3 with 14 at draft (3.3 and 3.8 in another run; 1.9 and 2.2 at standard):** 80 and 112 bytes a sample. Of the 2980 instructions that ten columns add 2240 are their checksum, 500
  gather them, 120 write. As with CSV.
- **Given force, whole process of 10 s, 10 ms: 24** (bench.md's table of other programs). Start-up is 4; 441000 samples at 149 cycles are 18, which the rows of the given force and of start-up tell; the 2 that are left, of reading the file for the first time or not, were not looked into.
- **csound, 5 times: 3.1 to 3.5; SciPy's lfilter, 25 times: 19 to 21.** Whole processes: of 24 ms of rasp's, for 10 s of force on an object at rest, start-up is 4, and of the rest the modes are half (46 %), reading the force and its checksum a third: what csound, which
  makes its noise or reads it once, has not. The modes cannot be had for less without contraction (see given force, at rest), so it is again reading and start-up.
- **rk4, 82 cycles a step: 815.** (1485 in the same rounds for 0b5dd52, which went over the modes five times a step, once for each stage and once for its end, each waiting for the last.) Of 3030 instructions a step (5650 at 0b5dd52) 2580 are rk4's
  (5190), nearly all of them one pass over the modes: 46 multiplications and additions a mode for the end of the step and what is lost in it, 27 for the sums that the ball will feel at the stages of the step after the next, 16 more where the place moves. Two
  units of eight lanes cannot do them in less than 260 cycles, 310 where it moves; called for by itself (evidence/rolling.md) a step takes 340 of the time stamp counter's.
- **rk4, one step a sample, 1000 times real time: 650 to 760 on rigid ground, 170 with 50 modes** (365 and 65 at 0b5dd52; evidence/rolling.md; it is refused there where a contact has fewer than 12 steps). On rigid ground what is left is a chain: four forces, each of
  which has its root and waits for those before it; 1000 times would be 59 cycles a step.
- **Coupled ball, implicit, 8 steps, 38 times real time: 23.** 440 cycles a step, 405 of them the stage's (bench.md); what they are is told above.
- **Roughness on a line, 900 times real time: 266.** The scrape takes 223 cycles where that on the 1-D profile takes 152, making the roughness 22 (bench.md); why the first is more was not looked into.
- **Batch on two cores, 520 and 70 a second:** 70 a second of a shipped scene with 2 s at draft, WAV and 1 kHz CSV (evidence/batch.md; 37 on one): stimuli share no work, so that two cores do twice what one does, and what a stimulus costs is
  told above.
- **50 more modes, the same within 30 %: 48 and 62 cycles, which is within** (71 and 50, 51 and 74 in other runs, which are not): differences of two times of some 270 cycles, each of which moves by 10 and more; by instructions (callgrind, a scrape over roughness on a line,
  draft) 187 and 188.
- **What lies beyond the goals** (a third fewer cycles, start-up in 1 ms, csound 10 times) is nowhere near: what is known to be left there is single precision, contraction, whose bytes differ from CPU to CPU, or eight scenes in
  lanes, which evidence/rolling.md works out not to pay beside `--jobs`.
- **A finished tail** costs what is left when the modes are at rest: 121 instructions a sample 28 s after the motion, 227 from 2 to 4 s after it (235 and 340 while the motion's and the force's zeros were still paid: `src/pipeline/run_limits.c`), of which the WAV takes some 24.
END
} > "$RESULT"
cat "$RESULT" > "$ROOT/evidence/profile.md"

#!/bin/bash
# Makes evidence/planned.md: what rasp plan says that a round tip or a ball over roughness in the plane costs, beside what it does (tests/bench/planned.py; about 6 minutes on a quiet machine). Needs python3.
# Then random scenes (SEEDS, SCENES of each; BEFORE: another program, which is planned with, too; some 20 minutes).
# REPEATS (3) rounds; ONLY: a part of the scenes' names, prints their rows and makes no report.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export ROOT BUILD REPEATS=${REPEATS:-3} LC_ALL=C
make -C "$ROOT" -s BUILD="$BUILD" "$BUILD/rasp" "$BUILD/bench/yardstick"
if [ -n "${ONLY:-}" ]; then
    python3 -B "$ROOT/tests/bench/planned.py"
    exit
fi
RESULT=$(mktemp)
trap 'rm -f "$RESULT"' EXIT
{
    echo '# Predicted cost of roughness in the plane'
    echo
    echo 'Made by `evidence/planned.sh`. Cycles are the CPU time of all stages of a contact, opening with it, least of several renders, times the core clock, over the samples of its motion,'
    echo "on: $(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -n 1). The model (\`src/surface/tip.c\`) knows the scene's keys alone: how far the ground's heights span is a guess."
    echo 'Wanted: within a factor of 1.5.'
    echo
    python3 -B "$ROOT/tests/bench/planned.py"
    echo
    echo '# Predicted cost of random scenes'
    echo
    echo 'Scenes of tests/torture, without faults (`evidence/planned_random.py`, which says how): cycles of the whole render, knobs chosen, responses read, files written, as `rasp plan --measure` has both.'
    echo
    python3 -B "$ROOT/evidence/planned_random.py" --rasp "$BUILD/rasp" ${BEFORE:+--before "$BEFORE"} --seeds "${SEEDS:-1,2,3}" --scenes "${SCENES:-150}" --runs "$REPEATS"
} > "$RESULT"
cat "$RESULT" > "$ROOT/evidence/planned.md"

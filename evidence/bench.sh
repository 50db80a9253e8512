#!/bin/bash
# Makes evidence/bench.md: what renders cost, beside their goals, and beside other programs (tests/bench/pipeline.py, peers.py). On a quiet machine; REPEATS (5), LONG (3600 s).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export BUILD REPEATS=${REPEATS:-5} LONG=${LONG:-3600}
make -C "$ROOT" -s BUILD="$BUILD" "$BUILD/bench/yardstick"
RESULT=$(mktemp)
trap 'rm -f "$RESULT"' EXIT
load=$(cut -d' ' -f1-3 /proc/loadavg)
{
    echo '# What renders cost'
    echo
    echo "Made by \`evidence/bench.sh\`, $REPEATS rounds, on one core of: $(sed -n 's/^model name[^:]*: //p;T;q' /proc/cpuinfo); load before it: $load. Times of another machine are"
    echo 'others; cycles and the ratio to the scalar loop move less. Each job has its accuracy beside it: goals were set on a prototype that took the force once a sample,'
    echo 'as draft does. The preset chooses its knobs by pilot runs: that is among summing, writing, reading.'
    echo
    bash "$ROOT/tests/bench/pipeline.sh"
    echo
    echo '## The same job by other programs'
    echo
    echo '10 s of noise at 44.1 kHz as a force on 50 modes, to a WAV; whole processes. sox convolves with a fixed response of 1 s; csound and scsynth (single precision)'
    echo 'have other resonators: only the work is comparable.'
    echo
    bash "$ROOT/tests/bench/peers.sh"
} > "$RESULT"
cp "$RESULT" "$ROOT/evidence/bench.md"

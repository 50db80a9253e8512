#!/bin/bash
# Makes evidence/promise.md: accuracy.error on SCENES (default 240) random scenes of SEED (default promise). Some six minutes of two cores.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
SCENES=${SCENES:-240} SEED=${SEED:-promise}
export LC_ALL=C
report=$(mktemp)
trap 'rm -f "$report"' EXIT
"$ROOT/tests/torture/promise.py" --rasp "$BUILD/rasp" --seed "$SEED" --scenes "$SCENES" > "$report" || true
{
    cat << END
# accuracy.error on random scenes

Made by \`evidence/promise.sh\`: \`tests/torture/promise.py --seed $SEED --scenes $SCENES\`. The scenes are those of tests/torture, of every model, most of
them 0.1 to 0.3 s long; each is asked for one error and measured against itself with every knob twice as fine or finer. Scenes that take longer than 20 s are left out.

END
    sed 's/^MISSED/- MISSED/; /passed, .* failed$/d' "$report"
    cat << END
Before whole motions were run, excerpts drawn by the square of the speed chose the knobs: of the first 84 measured scenes of seed promise 8 missed, by up to 29 dB.
Choosing costs more than such a short render, for a value is accepted only beside one twice as fine.
END
} > "$ROOT/evidence/promise.md"
tail -n 1 "$report"

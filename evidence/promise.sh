#!/bin/bash
# Prints how accuracy.error and the presets do on SCENES (default 240) random scenes each of SEED (default promise), for evidence/promise.md.
# Some half an hour of two cores.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
SCENES=${SCENES:-240} SEED=${SEED:-promise}
export LC_ALL=C
report=$(mktemp)
trap 'rm -f "$report"' EXIT
commit=$(git -C "$ROOT" rev-parse --short HEAD)$(git -C "$ROOT" diff --quiet HEAD -- src tests/torture || echo +)
measured() { # of the options given, as a list and tables
    "$ROOT/tests/torture/promise.py" --rasp "$BUILD/rasp" --seed "$SEED" --scenes "$SCENES" "$@" > "$report" || true
    sed 's/^MISSED/- MISSED/; /passed, .* failed$/d' "$report"
}
{
    cat << END
At $commit: \`tests/torture/promise.py --seed $SEED --scenes $SCENES\`.

## An error that is asked for

END
    measured
    for preset in draft standard high; do
        printf '\n## The preset %s\n\n' "$preset"
        measured --preset "$preset"
    done
}

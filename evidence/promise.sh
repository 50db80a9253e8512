#!/bin/bash
# Makes evidence/promise.md: accuracy.error and the presets on SCENES (default 240) random scenes each of SEED (default promise).
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
# accuracy.error and presets on random scenes

Made by \`evidence/promise.sh\` at $commit: \`tests/torture/promise.py --seed $SEED --scenes $SCENES\`. The scenes are those of tests/torture, of every model,
most of them 0.1 to 0.3 s long; each is measured against itself with every knob twice as fine or finer. Scenes that take longer than 20 s are left out.

## An error that is asked for

END
    measured
    for preset in draft standard high; do
        printf '\n## The preset %s\n\n' "$preset"
        measured --preset "$preset"
    done
} > "$ROOT/evidence/promise.md"
grep -c MISSED "$ROOT/evidence/promise.md" || true

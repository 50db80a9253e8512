#!/bin/bash
# rasp decompose on recordings whose truth is known: makes evidence/decompose.md. ROUNDS (50) of there and back.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
ROUNDS=${ROUNDS:-50}
export LC_ALL=C
command -v python3 > /dev/null || { echo "python3 is not installed: skipped"; exit 0; }
work=$(mktemp -d)
report=$(mktemp)
trap 'rm -rf "$work" "$report"' EXIT
commit=$(git -C "$ROOT" rev-parse --short HEAD)$(git -C "$ROOT" diff --quiet HEAD -- src || echo +)
{
    echo '# A recording taken apart: rasp decompose'
    echo
    echo "Made by \`evidence/decompose.sh\` at $commit, ROUNDS=$ROUNDS. No recording of real rolling is at hand: all are renders, whose truth is known."
    echo
    "$ROOT/evidence/decompose.py" "$BUILD/rasp" "$work" "$ROUNDS"
} > "$report"
cp "$report" "$ROOT/evidence/decompose.md"

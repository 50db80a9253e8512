#!/bin/bash
# Random scenes over the whole legal range, a third of them with a fault planted (tests/torture): what came of SCENES
# (default 20000, some eight hours of one core) of SEED (default T20), EVERY (16) one of them once more with sanitizers.
# Makes evidence/torture.md.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
SCENES=${SCENES:-20000} SEED=${SEED:-T20} EVERY=${EVERY:-16}
export LC_ALL=C
cd "$ROOT"
command -v clang > /dev/null || { echo "clang is not installed: skipped"; exit 0; }
make --no-print-directory -s BUILD="$BUILD" all
fused= # as the Makefile does
! grep -qw avx2 /proc/cpuinfo || fused=ISA=v3
make --no-print-directory -s BUILD="$BUILD/sanitize" CC=clang SAN=1 OPT="-O2 -g1" ${fused:+"$fused"} all
commit=$(git rev-parse --short HEAD)$(git diff --quiet HEAD -- src tests/torture || echo +)
report=$(mktemp)
trap 'rm -f "$report"' EXIT
code=0
tests/torture/torture.py --rasp "$BUILD/rasp" --sanitized "$BUILD/sanitize/rasp" --every "$EVERY" \
    --scenes "$SCENES" --seed "$SEED" --rows 60 > "$report" || code=$?
{
    cat << END
# Random scenes

Made by \`evidence/torture.sh\` at $commit: \`tests/torture/torture.py --seed $SEED --scenes $SCENES --every $EVERY\`.
What a scene is held to is in [tests/README.md](../tests/README.md). One scene in $EVERY is rendered once more by the
program under the address and undefined-behaviour sanitizers (clang $(clang -dumpversion)) and must have the same bytes.
Limits: 20 s of CPU time for a command (80 s sanitized), 4 GiB of memory.

END
    sed -n '/^Scenes: /,$p' "$report" | sed -E 's/^(refus|faults|what|over)(.*):$/**\1\2**/'
} > evidence/torture.md
grep '^FINDING' "$report" || true
tail -n 1 "$report"
exit "$code"

#!/bin/bash
# Makes evidence/memory.md: tests/faults/memory.sh with every single allocation failing, not one in so many (about an hour on one core; MOST=1000: at most so many of each but the render).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
MOST=${MOST:-1000000000}
export ROOT BUILD PATH LC_ALL=C
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
begin=$EPOCHSECONDS
code=0
mkdir "$WORK/test"
(cd "$WORK/test" && FAULTS_MOST=$MOST FAULTS_WHOLE='^a render$' FAULTS_SHOW=1 bash "$ROOT/tests/faults/memory.sh") > "$WORK/log" 2>&1 || code=$?
{
    cat << END
# Memory that runs out

Made by \`$([ "$MOST" = 1000000000 ] || echo "MOST=$MOST ")evidence/memory.sh\` in $((EPOCHSECONDS - begin)) s. A program is run once for each allocation that it makes, in which that one fails (tests/faults/memory.c, which stands
in for malloc and its like; allocations of the C library and of all other libraries count too). It must end with exit code 71 and say so, or do without (a library that takes another way) and then
leave the same bytes; never by a signal. A render must leave nothing; a set, run again in what was left, must be what an undisturbed run makes. No more blocks may be held at the end of a run
that returns than at that of an undisturbed one. Two kinds of allocations do not fail, since
these libraries use what they did not get: libsoxr 0.1.3's, and libsndfile 1.2's of a table of the chunks of a WAV that it reads. Before both rasp asks whether enough memory is there.

| command | allocations | runs | done without | exit 71 | wrong |
|---|---|---|---|---|---|
END
    sed -nE 's/^(.*): ([0-9]+) allocations, ([0-9]+) runs: ([0-9]+) done without, ([0-9]+) out of memory, ([0-9]+) wrong$/| \1 | \2 | \3 | \4 | \5 | \6 |/p' "$WORK/log"
    if [ $code != 0 ]; then
        printf '\nNot as it should be:\n\n```\n'
        grep -A 3 '^allocation' "$WORK/log"
        printf '```\n'
    fi
} > "$ROOT/evidence/memory.md"
exit $code

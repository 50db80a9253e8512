#!/bin/bash
# Makes evidence/fuzz.md: every fuzz target of tests/fuzz for EACH seconds (default 60, which takes about ten minutes; an hour of each: EACH=3600, ten hours), two at a time at the
# lowest priority. What earlier runs in the same build folder found new is started from. TARGETS="wav mesh": only these.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
EACH=${EACH:-60}
export LC_ALL=C
cd "$ROOT"
command -v clang > /dev/null || { echo "clang is not installed: skipped"; exit 0; }
read -r -a targets <<< "${TARGETS:-}"
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(cd tests/fuzz && printf '%s\n' fuzz_*.c | sed 's/fuzz_//; s/\.c$//')

describe() { sed -n '1,/\*\//p' "tests/fuzz/fuzz_$1.c" | tr '\n' ' ' | sed 's|^/\* *||; s| *\*/.*||; s|  *| |g; s/|/\\|/g'; }
stat_of() { sed -n "s/^stat::$2: *//p" "$BUILD/fuzz/$1.log"; }
cover() { grep -oE 'cov: [0-9]+ ft: [0-9]+' "$BUILD/fuzz/$1.log" | sed 's/cov: //; s/ ft: /, /' | "$2" -n 1; }

make --no-print-directory -s BUILD="$BUILD" fuzz SECONDS=0 > /dev/null 2>&1 || true # builds; a run of a second each
rm -rf "$BUILD/fuzz/found"
nice -n 19 tests/fuzz/run.sh "$BUILD/fuzz" $((EACH * ((${#targets[@]} + 1) / 2))) "${targets[@]}" > "$BUILD/fuzz/report" 2>&1 || true

{
    cat << END
# Fuzzing

Made by \`EACH=$EACH evidence/fuzz.sh\`: libFuzzer under the address and undefined-behaviour sanitizers (clang $(clang -dumpversion)), inputs of at most 16 KiB, **$EACH seconds of each target**, two
at a time at the lowest priority of a machine that had other work to do. A finding is a crash, a sanitizer's word, a leak, more than 10 s or 1 GB for an input, or a promise of the reader
that does not hold (the targets check: what is accepted is finite, in range, and says so; what is refused says why).$([ "$EACH" -ge 3600 ] || printf ' %s' "An hour of each, which is meant (EACH=3600, ten hours of two cores), was not run.")

Coverage is libFuzzer's: branches of rasp's own code that were taken, and features (how often, in which combination), with the kept inputs at the start and at the end. The libraries' code
is not counted. The kept inputs are tests/fuzz/corpus ($(find tests/fuzz/corpus -type f | wc -l) files, $(find tests/fuzz/corpus -type f -printf '%s\n' | awk '{ n += $1 } END { printf "%.0f", n / 1000 }') kB) and what earlier runs added.

| target | what it reads | inputs | seconds | coverage at the start | at the end | findings |
|---|---|---|---|---|---|---|
END
    for name in "${targets[@]}"; do
        found=$(find "$BUILD/fuzz/found" -name "$name-*" 2> /dev/null | wc -l)
        grep -q "^ok fuzz/$name " "$BUILD/fuzz/report" || [ "$found" -gt 0 ] || found="did not end"
        echo "| $name | $(describe "$name") | $(stat_of "$name" number_of_executed_units) | $(sed -n 's/^Done [0-9]* runs in \([0-9]*\) .*/\1/p' "$BUILD/fuzz/$name.log") | $(cover "$name" head) | $(cover "$name" tail) | $found |"
    done
} > evidence/fuzz.md
tail -n 3 "$BUILD/fuzz/report"

#!/bin/bash
# Fuzzes every target of tests/fuzz for EACH seconds (default 60, which takes about ten minutes), two at a time at the lowest priority, adds a line of each to evidence/fuzz.csv and makes
# evidence/fuzz.md of all its lines: an hour of each is ten hours of two cores, which need not be in one piece. What earlier runs in the same build folder found new is started from.
# TARGETS="wav mesh": only these. EACH=0: only the report.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
EACH=${EACH:-60}
export LC_ALL=C
cd "$ROOT"
command -v clang > /dev/null || { echo "clang is not installed: skipped"; exit 0; }
read -r -a targets <<< "${TARGETS:-}"
mapfile -t all < <(cd tests/fuzz && printf '%s\n' fuzz_*.c | sed 's/fuzz_//; s/\.c$//')
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")

describe() { sed -n '1,/\*\//p' "tests/fuzz/fuzz_$1.c" | tr '\n' ' ' | sed 's|^/\* *||; s| *\*/.*||; s|  *| |g; s/|/\\|/g'; }
stat_of() { sed -n "s/^stat::$2: *//p" "$BUILD/fuzz/$1.log"; }
cover() { grep -oE 'cov: [0-9]+ ft: [0-9]+' "$BUILD/fuzz/$1.log" | sed 's/cov: //; s/ ft: /,/' | "$2" -n 1; }

if [ "$EACH" -gt 0 ]; then
    commit=$(git rev-parse --short HEAD)$(git diff --quiet HEAD -- src 'tests/fuzz/*.c' || echo +)
    make --no-print-directory -s BUILD="$BUILD" fuzz SECONDS=0 > /dev/null # builds
    touch "$BUILD/fuzz/started"
    nice -n 19 tests/fuzz/run.sh "$BUILD/fuzz" $((EACH * ((${#targets[@]} + 1) / 2))) "${targets[@]}" > "$BUILD/fuzz/report" 2>&1 || true
    for name in "${targets[@]}"; do
        found=$(find "$BUILD/fuzz/found" -name "$name-*" -newer "$BUILD/fuzz/started" 2> /dev/null | wc -l)
        grep -q "^ok fuzz/$name " "$BUILD/fuzz/report" || [ "$found" -gt 0 ] || found=1 # it did not end
        seconds=$(sed -n 's/^Done [0-9]* runs in \([0-9]*\) .*/\1/p' "$BUILD/fuzz/$name.log")
        echo "$name,$commit,${seconds:-0},$(($(stat_of "$name" cpu_seconds))),$(stat_of "$name" number_of_executed_units),$(cover "$name" head),$(cover "$name" tail),$found"
    done >> evidence/fuzz.csv
    tail -n 3 "$BUILD/fuzz/report"
fi

# What column $2 of target $1 comes to: sum, first or last ($3); or since: the sum of the runs after the last one that found something.
of() { awk -F, -v target="$1" -v column="$2" -v how="$3" '$1 == target { sum += $column; since = $10 > 0 ? 0 : since + $column; last = $column; if (!n++) first = $column } END { print how == "sum" ? sum + 0 : how == "since" ? since + 0 : how == "first" ? first : last }' evidence/fuzz.csv; }
readers="scene design gsf sdf npy png gwy csv modes wav mesh motion" # of files that users bring
least_of() { for name; do of "$name" 4 since; done | sort -n | head -n 1; }
# shellcheck disable=SC2086
least=$(least_of $readers)
{
    cat << END
# Fuzzing

Made by \`evidence/fuzz.sh\` in several runs, whose lines are in [fuzz.csv](fuzz.csv): libFuzzer under the address and undefined-behaviour sanitizers (clang $(clang -dumpversion)), inputs of
at most 16 KiB, two targets at a time at the lowest priority. A finding is a crash, a sanitizer's word, a leak, more than 10 s or 1 GB for an input, or a promise of the reader that
does not hold (the targets check: what is accepted is finite, in range, and says so; what is refused says why). Seconds are of CPU: a target that had a core for itself would have
run as long. An hour of each reader of files that users bring is meant ($readers); the least that one of them had is **$least s**. The other targets are readers within these, or parts behind them; the least of all is $(least_of "${all[@]}") s. What was found was mended, its input is in tests/fuzz/corpus from then on, and the hour counts from there.

Coverage is libFuzzer's: branches of rasp's own code that were taken, and features (how often, in which combination), with the kept inputs at the start of the first run and at the end of
the last. The libraries' code is not counted. The kept inputs are tests/fuzz/corpus ($(find tests/fuzz/corpus -type f | wc -l) files, $(find tests/fuzz/corpus -type f -printf '%s\n' | awk '{ n += $1 } END { printf "%.0f", n / 1000 }') kB) and what earlier runs added.
Commits that were run: $(awk -F, 'NR > 1 && !seen[$2]++ { printf "%s%s", n++ ? ", " : "", $2 }' evidence/fuzz.csv).

| target | what it reads | inputs | CPU seconds since the last finding | coverage at the start | at the end | findings |
|---|---|---|---|---|---|---|
END
    for name in "${all[@]}"; do
        echo "| $name | $(describe "$name") | $(of "$name" 5 sum) | $(of "$name" 4 since) | $(of "$name" 6 first), $(of "$name" 7 first) | $(of "$name" 8 last), $(of "$name" 9 last) | $(of "$name" 10 sum) |"
    done
} > evidence/fuzz.md

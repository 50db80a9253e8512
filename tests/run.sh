#!/bin/bash
# Runs the tests and counts them.
#     tests/run.sh [KIND | KIND/NAME ...]      default: every kind but bytes
#     tests/run.sh --list [KIND ...]
#     tests/run.sh --set KIND[/NAME] ...       renews the expected files of cli, plans and golden tests: look at the diff
# Long tests, scripts that say so in a line "# Long: ..." and UNIT_LONG of unit tests, run where LONG is set or where tests are named only.
# BUILD is the build folder (default build), JOBS how many run at once. The last line is "N passed, N failed[, N skipped]";
# the exit code is 0 only if something ran and nothing failed. AFTER is a command whose output stands before that line. What each kind is: tests/README.md.
set -uo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
JOBS=${JOBS:-$(getconf _NPROCESSORS_ONLN)}
# A python3 that only looks for the real one takes up to a second a call: tests call the real one.
real=$(python3 -c 'import os, sys; print(os.path.dirname(sys.executable))' 2> /dev/null) || real=
[ -z "$real" ] || [ "$(command -v python3)" = "$real/python3" ] || PATH=$real:$PATH
PATH=$BUILD:$PATH # so no folder in $BUILD may be called like a program
export ROOT BUILD PATH LC_ALL=C
unset CDPATH
cd "$ROOT" || exit 1
shopt -s nullglob
. tests/lib/kinds.sh

ALL_KINDS="golden unit docs hard tidy faults cli plans"

# tests_of KIND: its tests, one KIND/NAME per line.
tests_of() {
    local path
    case $1 in
        unit) for path in tests/unit/test_*.c; do name_of unit "$path" .c; done ;;
        cli) for path in tests/cli/*.sh; do name_of cli "$path" .sh; done ;;
        plans | golden) for path in scenes/*.yaml; do name_of "$1" "$path" .yaml; done ;;
        docs) grep -lE '^(```sh$|\.S[hH] .*EXAMPLES)' *.md src/*.md tests/*.md man/*.[157] | sed 's|^|docs/|' ;;
        tidy | faults | hard | bytes) for path in tests/"$1"/*.sh; do name_of "$1" "$path" .sh; done ;;
        *) echo "tests/run.sh: no kind of test is called '$1'" >&2; exit 64 ;;
    esac
}

name_of() {
    local name=${2##*/}
    echo "$1/${name%"$3"}"
}

# run_one KIND/NAME: one line (and the output of a failure), and a line "passed failed skipped" in $COUNTS.
run_one() {
    local kind=${1%%/*} name=${1#*/} log folder code=0 counts
    SECONDS=0
    folder=$(mktemp -d "$SCRATCH/run.XXXXXXXX")
    log=$(mktemp "$SCRATCH/log.XXXXXXXX")
    (cd "$folder" && "kind_$kind" "$name") > "$log" 2>&1 < /dev/null || code=$?
    counts=$(counts_of "$code" "$log")
    echo "$counts" >> "$COUNTS"
    report "$code" "$1" "$log" "$counts"
    rm -rf "$folder" "$log"
}

# A unit test program says how many tests it holds; any other test is one.
counts_of() {
    local line
    if line=$(tail -n 1 "$2" | grep -Eo '[0-9]+ passed, [0-9]+ failed$'); then
        set -- "$1" $line
        [ "$1" = 0 ] || [ "$4" != 0 ] || set -- "$1" "$2" passed, 1
        echo "$2 $4 0"
    else
        case $1 in 0) echo 1 0 0 ;; 77) echo 0 0 1 ;; *) echo 0 1 0 ;; esac
    fi
}

# One write, so that lines of tests that run at the same time do not mix.
report() {
    local text
    case $1 in
        0)
            text="ok $2"
            [ "${4%% *}" = 1 ] || text+=" (${4%% *})"
            [ "$SECONDS" -lt 10 ] || text+=", $SECONDS s" # what makes the whole long
            ;;
        77) text="skip $2: $(tail -n 1 "$3")" ;;
        *) text="FAILED $2"$'\n'"$(tail -n 60 "$3" | sed 's/^/    /')" ;;
    esac
    printf '%s\n' "$text"
}

if [ "${1:-}" = --one ]; then
    run_one "$2"
    exit
fi

# named WORD...: the tests that kinds and names stand for, one KIND/NAME per line.
named() {
    local word tests test
    for word; do
        case $word in */*) echo "$word"; continue ;; esac
        tests=$(tests_of "$word") || return
        for test in $tests; do
            [ -z "${LONG:-}" ] && grep -qs '^# Long: ' "tests/$test.sh" || echo "$test"
        done
    done
}

if [ "${1:-}" = --set ]; then
    shift
    tests=$(LONG=1 named "$@") || exit
    # shellcheck disable=SC2086
    set_tests $tests
    exit
fi
list=false
if [ "${1:-}" = --list ]; then
    list=true
    shift
fi

# shellcheck disable=SC2086
[ $# -gt 0 ] || set -- $ALL_KINDS
kinds=false
for word; do case $word in */*) ;; *) kinds=true ;; esac; done
$kinds || LONG=1
export LONG=${LONG:-}
tests=$(named "$@") || exit
if $list; then
    echo "$tests"
    exit
fi

SCRATCH=$(mktemp -d)
COUNTS=$SCRATCH/counts
export SCRATCH COUNTS
: > "$COUNTS"
trap 'rm -rf "$SCRATCH"' EXIT
echo "$tests" | sed '/^$/d' | xargs -r -d '\n' -P "$JOBS" -I{} tests/run.sh --one {}

[ -n "$LONG" ] ||
    echo "left out: $(($(LONG=1 named "$@" | grep -c .) - $(echo "$tests" | grep -c .))) long scripts, and long parts of unit tests (LONG=1)"
${AFTER:-:}

awk -v expected="$(echo "$tests" | grep -c .)" '
    { passed += $1; failed += $2; skipped += $3 }
    END {
        if (NR < expected) { print expected - NR " tests did not report"; failed += expected - NR }
        if (!passed && !failed) print "no test ran"
        printf "%d passed, %d failed", passed, failed
        if (skipped) printf ", %d skipped", skipped
        printf "\n"
        exit failed > 0 || passed == 0
    }' "$COUNTS"

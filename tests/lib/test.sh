# For test scripts: `. "$ROOT/tests/lib/test.sh"`. A test script runs in an empty folder of its own with ROOT (the source tree),
# BUILD (the build folder), `rasp` on PATH and LC_ALL=C. It prints its reasons and exits 0 (passed), 77 (skipped: the last line
# says why) or anything else (failed).
# shellcheck shell=bash
set -uo pipefail

FAILURES=0
# A script that is run by hand in the source tree would leave its files there.
[ ! -e Makefile ] || { echo "this runs in an empty folder: tests/run.sh makes one"; exit 1; }
[ -n "${ROOT:-}" ] || { echo "ROOT is not set: run it by tests/run.sh"; exit 1; }

# fail TEXT...: notes a failure and goes on; `finish` makes it count.
fail() {
    echo "$*"
    FAILURES=$((FAILURES + 1))
}

skip() {
    echo "$*"
    exit 77
}

finish() {
    [ "$FAILURES" = 0 ]
    exit
}

# expect_exit CODE COMMAND...: runs it, keeps its output in ./out and ./err.
expect_exit() {
    local want=$1 got=0
    shift
    "$@" > out 2> err < /dev/null || got=$?
    [ "$got" = "$want" ] && return
    fail "exit code $got instead of $want: $*"
    sed 's/^/    /' err
}

# expect_text FILE PATTERN: an extended regular expression that some line of the file must match.
expect_text() {
    grep -Eq -- "$2" "$1" && return
    fail "no line of $1 matches: $2"
    sed 's/^/    /' "$1"
}

# expect_files NAME...: the folder . holds exactly these (hidden ones too), apart from out and err.
expect_files() {
    local want got
    want=$(printf '%s\n' "$@" | sed '/^$/d' | sort)
    got=$(find . -mindepth 1 ! -path ./out ! -path ./err -printf '%P\n' | sort)
    [ "$want" = "$got" ] || fail "files: $(echo $got); expected: $(echo $want)"
}

# A short scene that renders in milliseconds, for tests that need any scene at all.
short_scene() {
    local scene
    for scene in "$ROOT"/scenes/*.yaml; do
        echo "$scene"
        return
    done
    skip "no scene in scenes/" >&2
}

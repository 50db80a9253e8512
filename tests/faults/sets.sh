# Sets of stimuli: whatever happens to a run, one more leaves what a fresh folder has, byte for byte (faults/sets.py).
# Long: see tests/run.sh.
. "$ROOT/tests/lib/test.sh"
command -v python3 > /dev/null || skip "python3 is not installed"
[ "$(nm "$BUILD/rasp" | grep -c __asan_init)" = 0 ] || skip "the address sanitizer has calls of its own"
"${CC:-gcc}" -O1 -Wall -Wextra -shared -fPIC -o calls.so "$ROOT/tests/faults/calls.c" || fail "tests/faults/calls.c does not compile"
fast=$(mktemp -d /dev/shm/rasp-test.XXXXXX 2> /dev/null) || fast=$(mktemp -d)
trap 'rm -rf "$fast"' EXIT
cp calls.so "$fast"
(cd "$fast" && python3 "$ROOT/tests/faults/sets.py") > log 2>&1 || { fail "sets"; cat log; }
finish

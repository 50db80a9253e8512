# The test runner counts what fails: a tree with one test of each fate.
. "$ROOT/tests/lib/test.sh"
mkdir -p tree/tests/cli tree/scenes
cp -r "$ROOT/tests/run.sh" "$ROOT/tests/lib" tree/tests/
cd tree || exit 1
run() { env -u SCRATCH -u COUNTS -u LONG "${MORE[@]}" tests/run.sh "$@" > ../out 2>&1; }

MORE=()

run cli && fail "no test ran, exit code 0"
[ "$(tail -n 1 ../out)" = "0 passed, 0 failed" ] || fail "no tests: $(tail -n 1 ../out)"

cd tests/cli || exit 1
echo 'echo right; echo "in $PWD" >&2; exit 3' > good.sh
echo right > good.out; echo "in TMP" > good.err; echo 3 > good.exit
echo 'echo left' > wrong_out.sh; echo right > wrong_out.out
echo 'exit 1' > wrong_exit.sh
echo ': > .half.tmp1' > left_over.sh
echo 'echo "no such device"; exit 77' > left_out.sh
cd ../..
run cli && fail "tests failed, exit code 0"
[ "$(tail -n 1 ../out)" = "1 passed, 3 failed, 1 skipped" ] || fail "counted: $(tail -n 1 ../out)"
grep -qx 'ok cli/good' ../out || fail "good: $(cat ../out)"
grep -qx 'skip cli/left_out: no such device' ../out || fail "left_out: $(cat ../out)"

run --set cli/wrong_out cli/wrong_exit || fail "--set: $(cat ../out)"
rm tests/cli/left_over.sh
run cli || fail "after --set: $(cat ../out)"
[ "$(tail -n 1 ../out)" = "3 passed, 0 failed, 1 skipped" ] || fail "after --set: $(tail -n 1 ../out)"

# Long scripts: left out by kind, run by name and with LONG.
printf '# Long: to try it\necho "$LONG"\n' > tests/cli/long.sh
echo 1 > tests/cli/long.out
run cli || fail "long: $(cat ../out)"
[ "$(tail -n 1 ../out)" = "3 passed, 0 failed, 1 skipped" ] || fail "long, by kind: $(cat ../out)"
grep -q '^left out: 1 long scripts' ../out || fail "long, by kind: $(cat ../out)"
run cli/long || fail "long, by name: $(cat ../out)"
run --list cli && grep -q long ../out && fail "long: listed"
MORE=(LONG=1)
run cli || fail "LONG=1: $(cat ../out)"
[ "$(tail -n 1 ../out)" = "4 passed, 0 failed, 1 skipped" ] || fail "LONG=1: $(cat ../out)"
MORE=()
rm tests/cli/long.*

# Examples of documents: each kind of block, and one that fails.
printf '%s\n' '```sh' 'echo one > made' '```' '```sh no-run' 'false' '```' '```sh' 'grep -q one made' '```' > good.md
printf '%s\n' '```sh' 'true' 'false' 'true' '```' > wrong.md
printf '%s\n' '.Sh NAME' '.Dl false' '.Sh EXAMPLES' '.Dl $ true' '.Bd -literal' 'test 1 \-eq 1' '.Ed' '.Sh SEE ALSO' '.Dl false' > page.1
run docs/good.md docs/wrong.md docs/page.1 && fail "an example failed, exit code 0"
[ "$(tail -n 1 ../out)" = "2 passed, 1 failed" ] || fail "examples: $(cat ../out)"
finish

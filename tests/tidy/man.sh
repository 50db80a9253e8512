# Man pages are well-formed, and say what rasp says: scripts/man.sh makes them again as they are.
. "$ROOT/tests/lib/test.sh"

# stale FOLDER: pages in it that scripts/man.sh would make otherwise.
stale() {
    local name
    mkdir -p fresh
    "$ROOT/scripts/man.sh" fresh || echo "scripts/man.sh failed"
    for name in rasp.1 rasp-scene.5; do
        cmp -s "fresh/$name" "$1/$name" || echo "man/$name is not fresh: run scripts/man.sh and look at the diff"
    done
}

mkdir planted
"$ROOT/scripts/man.sh" planted
echo planted >> planted/rasp.1
[ "$(stale planted)" = "man/rasp.1 is not fresh: run scripts/man.sh and look at the diff" ] || fail "man: a planted line was not caught"

wrong=$(stale "$ROOT/man")
[ -z "$wrong" ] || fail "$wrong"

# Every page has examples, in a form that the tests of kind docs find and run.
exemplified() { awk '/^\.Sh / { on = /EXAMPLES/ } on && /^\.(Bd -literal|Dl |EX|nf)/ { n++ } END { exit !n }' "$1"; }
sed 's/^\.Sh EXAMPLES/.Sh SAMPLES/' "$ROOT/man/rasp.1" > planted/no_examples.1
! exemplified planted/no_examples.1 || fail "man: a page without examples was not caught"
shopt -s nullglob
for page in "$ROOT"/man/*.[157]; do
    exemplified "$page" || fail "${page##*/} has no examples"
done

command -v mandoc > /dev/null || { [ "$FAILURES" != 0 ] || skip "mandoc is not installed"; finish; }
mandoc -T lint -W warning "$ROOT"/man/*.[157] || fail "mandoc: see above"
finish

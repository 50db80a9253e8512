# `make bundle` packs a program that runs elsewhere, by its own libraries, and makes the same bytes.
. "$ROOT/tests/lib/test.sh"
BUILD=$BUILD "$ROOT/scripts/bundle.sh" "$PWD/rasp-x.tar.gz" > log 2>&1 || fail "scripts/bundle.sh: $(cat log)"
tar -xf rasp-x.tar.gz
own=rasp-x/bin/rasp
foreign=$(ldd $own | awk '$3 ~ /^\// { print $3 }' | grep -v "^$PWD/rasp-x/lib/\|$PWD/rasp-x/bin/../lib/" | grep -Ev '/lib(c|m|pthread|dl|rt)\.so' || true)
[ -z "$foreign" ] || fail "libraries from elsewhere: $foreign"
$own render -q rasp-x/share/rasp/scenes/strike.yaml -o a.wav
"$BUILD/rasp" render -q "$ROOT/scenes/strike.yaml" -o b.wav
cmp a.wav b.wav || fail "other bytes"
$own render -q rasp-x/share/rasp/scenes/strike.yaml --verify -o c.wav || fail "--verify, which starts it once more"
finish

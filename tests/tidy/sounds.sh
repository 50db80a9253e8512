# The sounds that README.md links to are those that the program makes, sample by sample.
. "$ROOT/tests/lib/test.sh"
BUILD=$BUILD "$ROOT/scripts/sounds.sh" "$PWD/sounds" || fail "scripts/sounds.sh"
[ "$(ls sounds)" = "$(ls "$ROOT/sounds")" ] || fail "other sounds: $(ls sounds)"
for sound in sounds/*.flac; do
    "$BUILD/rasp" compare --quiet "$ROOT/$sound" "$sound" || fail "$sound has changed: scripts/sounds.sh"
done
for name in $(sed -n 's/.*(\(sounds\/[^)]*\)).*/\1/p' "$ROOT/README.md"); do [ -f "$ROOT/$name" ] || fail "README.md: no $name"; done
finish

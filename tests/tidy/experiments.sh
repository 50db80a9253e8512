# scenes/experiments/ is what scripts/experiments.sh writes, byte for byte, and every stimulus in it, also of its designs, is a scene that can be rendered.
. "$ROOT/tests/lib/test.sh"
sh "$ROOT/scripts/experiments.sh" made > log 2>&1 || fail "scripts/experiments.sh fails: $(cat log)"
diff -r made "$ROOT/scenes/experiments" || fail "scenes/experiments is out of date: run scripts/experiments.sh"
[ "$(find made/002_rolling -maxdepth 1 -name '*.yaml' | wc -l)" = 36 ] || fail "002 III-B: not 36 stimuli"
[ "$(find made/000_rolling -maxdepth 1 -name '*.yaml' | wc -l)" = 18 ] || fail "000 experiment 3: not 18 stimuli"
for scene in "$ROOT"/scenes/experiments/*.yaml "$ROOT"/scenes/experiments/*/*.yaml; do
    rasp check "$scene" > checked 2>&1 || fail "${scene##*/}: $(cat checked)"
done
# A planted mistake is found.
cp -r made "$PWD/scenes"
echo 'ball: {radius: 0}' >> "$(find scenes/002_rolling -maxdepth 1 -name '*.yaml' | head -n 1)"
bad=$(for scene in scenes/002_rolling/*.yaml; do rasp check "$scene" > /dev/null 2>&1 || echo bad; done)
[ "$bad" = bad ] || fail "a scene with a ball of no size passes"
finish

# An effect is one file and one line: new_effect.c, with its parameters, keys, a rule, a column and a figure in the summary, goes into a copy of the tree, and all that
# describes scenes knows of it.
. "$ROOT/tests/lib/test.sh"

# The copy is built as the original was, from its objects.
mkdir -p tree/build
cp -a "$ROOT/src" "$ROOT/Makefile" tree/
here=$PWD
(cd "$BUILD" && find . -maxdepth 2 \( -name '*.o' -o -name '*.d' -o -name flags \) -print0 | xargs -0 cp -a --parents -t "$here/tree/build")
cp "$ROOT/tests/tidy/new_effect.c" tree/src/force/swell.c
sed -i 's/^STAGE(gesture)$/STAGE(gesture)\nSTAGE(swell)/' tree/src/pipeline/stages.def
read -r compiler flags < "$BUILD/flags"
make -s -C tree -j2 BUILD=build CC="$compiler" CFLAGS="$flags" build/rasp > log 2>&1 || fail "it does not build: $(tail -n 5 log)"
compiled=$(cd tree && find build -name '*.o' -newer src/force/swell.c | wc -l)
PATH=$PWD/tree/build:$PATH
hash -r

cat > scene.yaml << 'END'
rasp: 1
surface: {roughness: {rms: 3 um}}
scraper: {mass: 10 g}
contact: {swell: {depth: 0.25}}
motion: {path: line, to: [10 cm, 0 cm], speed: 20 cm/s}
output: {diagnostics: {rate: 40 Hz, columns: [time_s, swell_gain]}, quantity: force}
END

# What describes the keys.
expect_exit 0 rasp explain contact.swell.period
expect_text out 'time from swell to swell'
expect_exit 0 rasp explain
expect_text out 'depth: 0.5'
expect_exit 0 rasp explain --man=keys
expect_text out 'contact\.swell'
expect_exit 0 rasp explain --man=columns
expect_text out 'swell_gain'
expect_exit 0 rasp explain --schema=scene
python3 - out << 'END' || fail "the schema has no swell"
import json, sys
text = json.dumps(json.load(open(sys.argv[1])))
sys.exit(not ('"swell"' in text and '"swell_gain"' in text and "reatest factor on the force" in text))
END
expect_exit 0 rasp completion words -- plan --set ""
expect_text out 'contact\.swell\.most'

# What describes a scene.
expect_exit 0 rasp explain scene.yaml
expect_text out '^ +depth: 0.25$'
expect_text out '^ +period: 0.1$'
expect_exit 0 rasp plan scene.yaml
expect_text out '^ *swell .*force -> force'
sed 's/swell: {depth: 0.25}//; s/, columns: .time_s, swell_gain.//' scene.yaml > without.yaml
expect_exit 0 rasp plan without.yaml
expect_text out 'no contact\.swell'

# Errors.
expect_exit 65 rasp check scene.yaml --set 'contact.swell.depth=1.5'
expect_text err 'contact\.swell\.depth'
expect_exit 65 rasp check scene.yaml --set 'contact.swell.period=2 m'
expect_text err 'contact\.swell\.period'
expect_exit 65 rasp check scene.yaml --set 'contact.swell.perod=2 s'
expect_text err "did you mean '?contact.swell.period|did you mean 'period'"
expect_exit 65 rasp check scene.yaml --set 'contact.swell.period=0.4 s' --set 'motion.duration=0.5 s' --set motion.speed=null
expect_text err 'contact\.swell\.period, 0\.4 s, must be at most 0\.5 times motion\.duration, 0\.5 s'
expect_exit 65 rasp check without.yaml --set 'output.diagnostics.columns=[swell_gain]'
expect_text err 'swell_gain: it needs contact\.swell'

# What a render says: in the table 1 + 0.25 sin(2 pi t / 0.1 s) at t = 0, 25, 50, 75 ms; 5 swells in 0.5 s.
expect_exit 0 rasp render scene.yaml -o out.wav
cat out err > said
expect_text said 'the force swells 5 times'
expect_text out.json '"swells": 5'
[ "$(head -n 5 out.csv | tr '\n' ' ')" = "time_s,swell_gain 0,1 0.025,1.25 0.05,1 0.075,0.75 " ] || fail "$(head -n 5 out.csv)"
[ "$compiled" -le 20 ] || fail "$compiled files were compiled for one effect"
finish

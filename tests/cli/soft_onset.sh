# Refusals of soft onsets (gammatone), of a force made louder near modes (enhance), and of heights that are played.
scene()
{
    cat > s.yaml << END
rasp: 1
surface: {$1}
motion: {path: line, from: [5 cm, 0 cm], to: [9 cm, 0 cm], duration: 0.1 s}
contact: {$2}
${3:-}
END
    rasp plan s.yaml > plan.txt 2> said.txt && sed -nE '/^  (enhance|surface_)/s/ +[0-9.]+ %.*//p' plan.txt || { echo "refused: $?"; cat said.txt; }
}
strike='model: strike, strike: {pulse: half_sine, stiffness: 1 MN/m, speed: 1 m/s}}
scraper: {mass: 1 g'
table=plank.csv
ir=tap.wav
cp "$ROOT/irs/basswood_plank.csv" plank.csv
cp "$ROOT/irs/ceramic_tile_tap.wav" tap.wav
printf '# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n0,0,0,1,400,0,1,0\n' > undamped.csv
cat > separate.csv << 'END'
# poles: separate
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
0,0,0,1,400,20,1,0
1,0.1,0,1,410,25,1,0
END

echo "== gammatone"
scene "response: $table, gammatone: 2" "$strike"
scene "response: $table, gammatone: 2, response_length: 0.1 s" "$strike"
scene "response: $table, gammatone: 5" "$strike"
scene "response: $ir, gammatone: 2" "$strike"
scene "gammatone: 2" "$strike" "output: {quantity: force}"
scene "response: undamped.csv, gammatone: 2" "$strike"
scene "response: separate.csv, gammatone: 2" "$strike"
scene "response: separate.csv, gammatone: 2, convolution: resonators" "$strike"
scene "response: separate.csv, gammatone: 2, moving: readout" "$strike"
scene "response: separate.csv, gammatone: 2, moving: glide" "$strike"
scene "response: separate.csv, gammatone: 2, convolution: nodes" "$strike"
scene "space: {from: [0, 0], to: [0.5, 0]}, gammatone: 3" "$strike"
scene "space: {from: [0, 0], to: [0.5, 0]}, gammatone: 3, moving: launch" "$strike"

echo "== enhance"
enhanced="enhance: {gain: 20 dB}, $strike"
scene "response: $table" "$enhanced"
scene "response: $ir" "$enhanced"
scene "" "$enhanced" "output: {quantity: force}"
scene "response: $table" "$enhanced" "output: {quantity: force}"
rasp render s.yaml > /dev/null 2>&1 || echo "a force with the surface's modes does not render"
scene "response: undamped.csv" "$enhanced"
rasp render s.yaml || echo "refused: $?"

echo "== playback"
scene "response: $table" "model: playback"
scene "response: $table, fractal: {exponent: -1, maximum: 1 um, pitch: 50 um}" "model: playback}
grip: {angle: 10 deg"
sed -e 's/grip.*/load: {approach: 1 ms}/' -e 's/path: line.*duration/path: still, at: [6 cm, 0 cm], duration/' s.yaml > still.yaml
rasp check still.yaml
true

# Modes from a recording of strikes: a scene renders three strikes on a plate, their force is the second channel, and the plate's modes come back. What is refused.
. "$ROOT/tests/cli/modes-extract-make.inc"
rasp render -q plate.yaml
python3 wav.py join plate.wav plate.force.wav strikes.wav 1e-6
rasp modes object plate.yaml --at 7cm,6cm --modes 10 -q -o true.csv 2> /dev/null
extract strikes.wav@7cm,6cm --force-channel 2 --scale 10 --force-scale 1 --quantity velocity -o found.csv --resynthesis s.wav --residual d.wav > report.txt
grep -E '^strikes' report.txt
sed -n 's/^[0-9]* modes \(between .* Hz\),.*/modes \1/p' report.txt
grep -E '^# (poles|quantity|normalisation|strikes)' found.csv
# near TABLE HZ DECAY GAIN [BELOW ABOVE]: of the true modes below that frequency and above that gain, how many have one
# within those limits (shares but for Hz) in another table.
# false TABLE DECIBEL: modes of a table further than 1 Hz from any true one, that much below its strongest or louder.
# Fainter ones are not counted: whether there is one is a matter of the noise's seed (of 6 seeds one has one, at -81 dB).
cat > near.py << 'END'
import sys
def modes(name):
    return [[float(c) for c in line.split(",")[4:8]] for line in open(name) if line[0] not in "#p"]
true, found = modes("true.csv"), modes(sys.argv[2])
if sys.argv[1] == "near":
    hz, decay, gain, below, above = map(float, (sys.argv[3:] + ["1e9", "0"])[:5])
    true = [t for t in true if t[0] < below and abs(t[2]) > above]
    good = sum(any(abs(t[0] - f[0]) < hz and abs(t[1] / f[1] - 1) < decay and abs(t[2] / f[2] - 1) < gain for f in found) for t in true)
    print(good, "of", len(true), "modes")
else:
    least = 10 ** (float(sys.argv[3]) / 20) * max(abs(f[2]) for f in found)
    print([f for f in found if abs(f[2]) > least and min(abs(t[0] - f[0]) for t in true) > 1] or "none")
END
echo "within 1 Hz, 5 % of decay, 12 % of gain (the weakest lies 8 Hz beside one 20 times as strong: over seeds its deviations are 0.1 Hz, 1 %, 2.3 %):"
python3 near.py near found.csv 1 0.05 0.12
echo "those below 500 Hz, which stand alone, within 0.01 Hz, 0.1 % of decay, 0.2 % of gain:"
python3 near.py near found.csv 0.01 0.001 0.002 500 0
echo "others above -60 dB:"
python3 near.py false found.csv -60
rasp modes list found.csv --modes 3 | sed -n 's/^[0-9]* modes at/modes at/; 1,2p'
echo "the same again is the same table, a scene takes it, a --json report has it"
extract strikes.wav@7cm,6cm --force-channel 2 --scale 10 --force-scale 1 --quantity velocity --json -o again.csv > again.json
cmp found.csv again.csv
sed '/material/,/object/d; s/^surface:/surface: {response: found.csv}/' plate.yaml > with.yaml
rasp render -q with.yaml
python3 -c 'import json; d = json.load(open("again.json")); print(len(d["modes"]) >= 10, d["physical"], len(d["places"][0]["strikes"]))'
echo "without the force: the six strongest, within 3 Hz (a quarter of the spectrogram's bin) and 5 % of decay"
extract strikes.wav --method spectrogram -q -o sound.csv
grep normalisation sound.csv
python3 near.py near sound.csv 3 0.05 1e9 1e9 1.5
python3 wav.py make impulse.wav 8000 float 8000
extract impulse.wav --impulse --scale 1 --quantity velocity --modes 1 -q -o impulse.csv
tail -1 impulse.csv | awk -F, '{ printf "%.3f Hz, %.2f/s, %.3f\n", $5, $6, sqrt($7 * $7) }'
extract impulse.wav --impulse --quantity pressure --radius 5cm --distance 50cm --modes 1 -q -o radiated.csv
grep -E '^# (quantity|radius_m|radiation)' radiated.csv
echo "silence before a response is taken off"
python3 wav.py make late.wav 8000 late 8000
extract late.wav --impulse --scale 1 --quantity velocity --modes 1 -o late.csv | grep begins
tail -1 late.csv | awk -F, '{ printf "%.2f Hz, %.1f/s, %.2f\n", $5, $6, sqrt($7 * $7) }'

echo refused >&2
python3 wav.py make silent.wav 8000 silent 8000
python3 wav.py make noise.wav 8000 noise 16000
python3 wav.py make clipped.wav 8000 clipped 8000
python3 wav.py make short.wav 8000 clipped 40
python3 wav.py make other.wav 16000 float 8000
for file in silent noise clipped short missing; do try extract $file.wav -o x.csv; done
try extract impulse.wav --force-channel 2 -o x.csv
try extract strikes.wav --channel 3 -o x.csv
try extract strikes.wav --force-channel 1 -o x.csv
try extract impulse.wav@1cm,0 other.wav@2cm,0 --impulse -o x.csv
try extract impulse.wav other.wav --impulse -o x.csv
try extract impulse.wav@1cm,0 impulse.wav@1cm,0 --impulse -o x.csv
try extract impulse.wav@1s,0 --impulse -o x.csv
try extract strikes.wav --force-channel 2 --scale 10 -o x.csv
try extract strikes.wav --scale 10 -o x.csv
try extract impulse.wav --impulse --radius 5cm -o x.csv
try extract impulse.wav --impulse --quantity velocity --radius 5cm --distance 1m -o x.csv
try extract impulse.wav --impulse --force-channel 2 -o x.csv
try extract impulse.wav --impulse --quantity loudness -o x.csv
try extract impulse.wav --impulse --method music -o x.csv
try extract impulse.wav --impulse --low 2kHz --high 1kHz -o x.csv
try extract impulse.wav --impulse --plot x.pdf -o x.csv
try extract impulse.wav --impulse
try extract impulse.wav --impulse -o impulse.csv
try extract impulse.wav --impulse -o nowhere/x.csv
ls x.* 2> /dev/null || true

# One plate struck at three places and heard at a fourth: poles are shared, gains have the mode shapes' signs, and a contact that moves over the table sounds as over
# the true one. A folder with index.csv is the same as FILE@X,Y.
. "$ROOT/tests/cli/modes-extract-make.inc"
listen='listen: {radiator: point, places: [[23 cm, 14 cm, 0]]}'
mkdir taps
echo file_name,x_m,y_m,gain_db > taps/index.csv
for x in 5 10 15; do
    sed "s/at: .7 cm/at: [$x cm/; s/modes: 10/modes: 6/; s/24 kHz/12 kHz/; s/quantity: velocity/$listen/" plate.yaml > p$x.yaml
    rasp render -q p$x.yaml
    python3 wav.py join p$x.wav p$x.force.wav taps/$x.wav 1e-6
    echo "$x.wav,0.$(printf %02d $x),0.06,0" >> taps/index.csv
done
words="--force-channel 2 --scale 10 --force-scale 1 --quantity velocity --modes 6 -q"
# shellcheck disable=SC2086
extract taps $words -o folder.csv
# shellcheck disable=SC2086
(cd taps && extract 5.wav@5cm,6cm 10.wav@10cm,6cm 15.wav@15cm,6cm $words -o ../named.csv)
cmp folder.csv named.csv && grep -E '^# (poles|quantity|normalisation|strikes)' folder.csv
rasp modes object p5.yaml --line 5cm,6cm,15cm,6cm --places 3 --listen 23cm,14cm --modes 6 -q -o true.csv 2> /dev/null
python3 << 'PY'
def table(name):
    rows = [line.split(",") for line in open(name) if line[0] not in "#p"]
    return {(round(float(r[1]), 6), round(float(r[2]), 6), round(float(r[4]))): [float(v) for v in r[4:8]] for r in rows}
true, found = table("true.csv"), table("folder.csv")
good = [k for k in true if k in found and abs(true[k][0] - found[k][0]) < 0.01 and abs(true[k][1] / found[k][1] - 1) < 0.002]
print(len(good), "of", len(true), "frequencies within 0.01 Hz, decays within 0.2 %")
most = {}
for k in true:
    most[k[2]] = max(most.get(k[2], 0), abs(true[k][2]))
print(sum(abs(true[k][2] - found[k][2]) < 0.005 * most[k[2]] for k in good), "gains, signs too, within 0.5 % of the mode's largest;",
      sum(true[k][2] < 0 for k in good), "are negative")
PY
rasp modes list folder.csv | head -2
rasp modes list folder.csv --at 10cm,6cm --modes 2 | head -1
cat > moving.yaml << 'YAML'
rasp: 1
surface: {roughness: {rms: 3 um}, response: folder.csv}
scraper: {mass: 10 g}
motion: {path: line, from: [5 cm, 6 cm], to: [15 cm, 6 cm], duration: 0.5 s}
load: {constant: 1 N}
output: {sample_rate: 16 kHz, encoding: float32, level: {full_scale: 1 m/s}}
YAML
rasp render -q moving.yaml -o found.wav
rasp render -q moving.yaml --set surface.response=true.csv -o true.wav
python3 - << 'PY'
import struct
def read(name):
    b = open(name, "rb").read()
    at = b.index(b"data")
    n = struct.unpack("<I", b[at + 4:at + 8])[0] // 4
    return struct.unpack("<%df" % n, b[at + 8:at + 8 + 4 * n])
a, b = read("true.wav"), read("found.wav")
off = sum((x - y) ** 2 for x, y in zip(a, b)) / sum(x * x for x in a)
print("a moving contact on it is within -40 dB of one on the true table:", off < 1e-4 or off)
PY

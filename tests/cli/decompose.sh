# A recording taken apart: modes and impacts that are known come back, what is written renders, and what a recording
# cannot say is said.
. "$ROOT/tests/lib/test.sh"
[ -z "${SANITIZED:-}" ] || skip "minutes under sanitizers; unit/test_source_filter runs the same"
cat > modes.csv <<'CSV'
# poles: shared
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
1,0,0,1,412.5,22,1,0
1,0,0,2,1033,31,0.8,0
1,0,0,3,2310,40,0.7,0
1,0,0,4,4875,55,0.5,0
CSV
cat > truth.yaml <<'YAML'
rasp: 1
surface: {response: modes.csv}
motion: {path: still, at: [0, 0], duration: 4 s}
contact:
  model: impacts
  impacts:
    prototype: custom
    amplitude: {mean: 1, deviation: 0.3}
    interval: {mean: 30 ms, deviation: 9 ms}
    duration: {zeta: 0.2 ms, theta: 0}
    modulation: {depth: 0}
    floor: {amplitude: 0.1, interval: 5 ms}
output: {ramp: 0, encoding: float32, impacts: table, level: {full_scale: 1e-2}}
YAML
rasp render truth.yaml -q -o truth.wav
near() { # a value, what it should be, by how much it may be off
    awk -v x="$1" -v y="$2" -v d="$3" 'BEGIN { exit !(x - y <= d && y - x <= d) }' || fail "$4: $1 is not $2 within $3"
}
said() { # the JSON's figure of that path
    python3 -c "import json, sys; d = json.load(open('$1'))
for k in sys.argv[1].split('.'): d = d[int(k) if k.isdigit() else k]
print(d)" "$2"
}
rasp decompose truth.wav -q -o parts
n=$(($(wc -l < truth.impacts.csv) - 1))
near "$(said parts/decompose.json impacts.number)" "$n" $((n / 20 + 1)) 'impacts'
for hertz in 412.5 1033 2310 4875; do
    awk -F, -v f="$hertz" '/^1,/ { d = $5 - f; if (d < 1 && d > -1) ok = 1 } END { exit !ok }' parts/modes.csv || fail "no mode at $hertz Hz"
done
near "$(said parts/decompose.json impacts.interval_mean_s.value)" "$(awk -F, 'NR == 2 { a = $1 } { b = $1 } END { print (b - a) / (NR - 2) }' truth.impacts.csv)" 0.0015 'mean interval'
[ "$(said parts/decompose.json scene)" = impacts ] || fail 'the scene has no impacts'
for scene in scene force; do
    rasp render parts/$scene.yaml -q -o $scene.wav 2> said || { cat said; fail "$scene.yaml"; }
done
cp force.wav twice.wav
rasp decompose twice.wav -q -o again
near "$(said again/decompose.json impacts.number)" "$(said parts/decompose.json impacts.number)" $((n / 20 + 1)) 'taken apart twice'
echo "-- what is written gives the recording back: the force by modes and click, and so do the impacts"
rasp render parts/force.yaml -q -o given.wav --set output.encoding=float32 --set 'output.level={full_scale: 1}' 2> said || { cat said; fail 'force.yaml'; }
python3 - <<'PY' || fail "what is written does not give back what the report says: $(cat shares)"
import array, cmath, csv, json, math
def wav(path):
    data = open(path, 'rb').read()
    at = data.index(b'data')
    return array.array('f', data[at + 8:at + 8 + int.from_bytes(data[at + 4:at + 8], 'little')])
def share(y):
    return 1 - sum((a - b) ** 2 for a, b in zip(x, y)) / sum(a * a for a in x)
x, click = wav('truth.wav'), wav('parts/click.wav')
report = json.load(open('parts/decompose.json'))
rate = int(report['sample_rate'])
modes = [0.0] * (rate // 4)
for row in csv.DictReader(line for line in open('parts/modes.csv') if line[0] != '#'):
    z = cmath.rect(float(row['gain']), float(row['phase_rad']))
    turn = cmath.exp(complex(-float(row['decay_per_s']), 2 * math.pi * float(row['frequency_hz'])) / rate)
    for t in range(len(modes)):
        modes[t] += z.imag
        z *= turn
def struck(h): # by all impacts, between samples by a line; a push is newtons over a sample
    y = [0.0] * (len(x) + len(h) + 1)
    for row in csv.DictReader(open('parts/impacts.csv')):
        at, push = float(row['time_s']) * rate, float(row['amplitude_n']) / rate
        for first, part in ((int(at), 1 - at % 1), (int(at) + 1, at % 1)):
            for t, v in enumerate(h):
                y[first + t] += push * part * v
    return share(y)
force, alone = share(wav('given.wav')), struck(modes)
both = struck([m + c for m, c in zip(modes, list(click) + [0.0] * (len(modes) - len(click)))])
print(f"report {report['given_back']:.4f}, force {force:.4f}, impacts {both:.4f}, without the click {alone:.4f}", file=open('shares', 'w'))
raise SystemExit(not (abs(force - report['given_back']) < 2e-3 and both > report['given_back'] - 2e-3 and both > alone + 1e-2))
PY
echo "-- with the table of a strike, and with gains of their own"
rasp decompose truth.wav --table modes.csv -q -o known
# Newtons: a raised cosine of 0.2 ms has half its peak's momentum, a recording of full_scale 1e-2 a hundred times as much;
# what is written lasts two samples.
near "$(said known/decompose.json impacts.amplitude_mean_n.value)" \
    "$(awk -F, 'NR > 1 { s += $2 } END { print s / (NR - 1) * 0.2e-3 / 2 * 100 * 48000 }' truth.impacts.csv)" 15 'amplitudes'
rasp decompose truth.wav --method lee -q -o lee
near "$(said lee/decompose.json impacts.number)" "$n" $((n / 10)) 'impacts with gains of their own'
rasp render lee/force.yaml -q -o lee.wav 2> said || { cat said; fail 'lee/force.yaml'; }
echo "-- what a recording cannot say"
for bad in silent short; do
    case $bad in
    silent) sox -n -r 44100 -c 1 silent.wav trim 0 1 ;;
    short) sox -D truth.wav short.wav trim 0 0.05 2> /dev/null ;;
    esac
    code=0
    rasp decompose $bad.wav -o bad || code=$?
    echo "exit code $code"
    [ ! -e bad ] || fail "$bad left something"
done
sox -D truth.wav -r 8000 -c 2 -b 16 eight.wav gain -3 rate 8000 2> /dev/null
rasp decompose eight.wav -o eight | grep -E 'warning: (of 2|at 8000)'
sox -D truth.wav -b 16 loud.wav gain 30 trim 0 1 2> /dev/null
rasp decompose loud.wav -o loud --json | grep -o 'it clips'
sox -D truth.wav one.wav trim 0 0.4 2> /dev/null
rasp decompose one.wav -o one | grep -A 1 'statistics take'
echo "-- a reflection, by its delay"
sox -D truth.wav room.wav echo 0.9 0.7 7 0.5 2> /dev/null
rasp decompose room.wav -o room | grep -A 1 'followed by another'
echo "-- options"
rasp decompose truth.wav || echo "exit code $?"
rasp decompose truth.wav -o parts || echo "exit code $?"
mkdir mine
rasp decompose truth.wav -f -o mine || echo "exit code $?"
rasp decompose truth.wav -o x --method lee --table modes.csv || echo "exit code $?"
rasp decompose truth.wav -o x --from 4.4s || echo "exit code $?"
finish

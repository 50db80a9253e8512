# Recordings as a condition: levelled by themselves, cut or continued to the set's length, in the set's form; refused where they do not have its rate.
. "$ROOT/tests/cli/batch-make.inc"
python3 -c '
import math, struct, wave
for name, rate, seconds in (("long", 48000, 0.5), ("short", 48000, 0.1), ("other", 44100, 0.2)):
    with wave.open(name + ".wav", "wb") as w:
        w.setnchannels(1), w.setsampwidth(2), w.setframerate(rate)
        w.writeframes(b"".join(struct.pack("<h", int(8000 * math.sin(0.1 * i))) for i in range(int(rate * seconds))))'
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'length: 300 ms' 'factors: {kind: [made, real]}' 'cells: [{kind: made}]' \
    'recordings: [{file: long.wav, kind: real, name: long}, {file: short.wav, kind: real, name: short}]' > set.yaml
sed -i 's/made, real/{label: made}, {label: real}/' set.yaml
rasp batch set.yaml -o out -q
columns out/manifest.csv file_name scene_file kind recording frames onset_ramp_s status
python3 -c '
import csv, math, struct, wave
for r in csv.DictReader(open("out/manifest.csv")):
    w = wave.open("out/" + r["file_name"])
    b = w.readframes(w.getnframes())
    x = [int.from_bytes(b[3 * i:3 * i + 3], "little", signed=True) for i in range(w.getnframes())]
    print(r["stimulus_id"], w.getnframes(), abs(float(r["peak_dbfs"]) + 3) < 1e-4, x[-1] == 0, r["offset_ramp_s"])'
rasp batch set.yaml -o out | sed 's/, in.*//'
sed 's/short.wav/other.wav/' set.yaml > wrong.yaml
rasp batch wrong.yaml -o wrong || echo "exit $?" >&2

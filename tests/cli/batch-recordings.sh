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
echo "-- a level is that of the whole file, cut or continued, as a render's is"
for level in 'rms: -26 dB' 'lufs: -30' 'peak: -6 dB'; do
    { sed 's/^length.*/length: 450 ms/' set.yaml; echo "level: {each: {$level}}"; } > each.yaml
    rm -rf each
    rasp batch each.yaml -o each -q 2> told.txt || cat told.txt
    columns each/manifest.csv stimulus_id rms_dbfs loudness_lufs peak_dbfs | awk -F' [|] ' -v l="$level" '
        { v = l ~ /rms/ ? $2 : l ~ /lufs/ ? $3 : $4; print $1, l, (v - (l ~ /rms/ ? -26 : l ~ /lufs/ ? -30 : -6)) ^ 2 < 1e-6 ? "met" : v }'
done
sed 's/, where.*//' told.txt
sed 's/short.wav/other.wav/' set.yaml > wrong.yaml
rasp batch wrong.yaml -o wrong || echo "exit $?" >&2
echo "-- a level that only recordings have: no cell is crossed with it"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors:' '  kind: [{label: made}, {label: real, of: recordings}]' '  motion.duration: [0.2 s, 0.3 s]' \
    'recordings: [{file: long.wav, kind: real}]' > only.yaml
rasp batch only.yaml -o only -q
columns only/manifest.csv stimulus_id kind motion_duration_s
for wrong in 's/kind: real}\]/kind: physical}]/' 's/kind: real}\]/kind: rael}]/' 's/, kind: real}\]/}]/' 's/of: recordings/of: cells, set: {seed: 1}/' 's/{label: made}, //' \
    's/^rec/cells: [{kind: real, motion.duration: 0.2 s}]\nrec/' 's/^rec/exclude: [{kind: made}]\nrec/' \
    's/0.3 s\]/0.3 s, {label: recorded, of: recordings}]/; s/kind: real}\]/motion.duration: recorded, kind: real}]/' 's/0.3 s\]/0.3 s, 0.30 s, {label: 500 ms, of: recordings}]/; s/kind: real}\]/motion.duration: 500 ms, kind: real}]/'; do
    sed "$wrong" only.yaml > bad.yaml
    rasp check bad.yaml || true
done
echo "-- what the dry run says of a recording is what the manifest says"
sed '/^length/a replicates: 2' set.yaml > twice.yaml
rasp batch twice.yaml --dry-run | awk '{ print $2, $4 }' | head -5
rasp batch twice.yaml -o twice -q
columns twice/manifest.csv stimulus_id replicate
rasp batch set.yaml --dry-run --json | grep wav_bytes
echo "-- one that has no loudness is told before anything is rendered; it may have a peak or an rms"
for level in '{common: {lufs: -30}}' '{each: {lufs: -30}}'; do
    { grep -v length set.yaml; echo 'length: own'; echo "level: $level"; } > loud.yaml
    rasp batch loud.yaml -o loud || echo "exit $?" >&2
    rasp batch loud.yaml --dry-run --quiet || echo "exit $?" >&2
    ls loud 2> /dev/null || true
done
sed -i 's/lufs: -30/rms: -30 dB/' loud.yaml
rasp batch loud.yaml -o loud -q && columns loud/manifest.csv stimulus_id status
echo "-- rasp check finds the same, and counts recordings among what the longest is of"
rasp check wrong.yaml || echo "exit $?" >&2
sed '/^length/d' set.yaml > longest.yaml
rasp check longest.yaml
rasp batch longest.yaml --dry-run | grep longest

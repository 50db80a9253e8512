# A set from a design: what is written, that it can be checked, resumed and rendered again one by one, that neither threads nor shards change a byte.
. "$ROOT/tests/cli/batch-make.inc"
rasp batch six.yaml -o one -j 1 | sed 's/ in [0-9:]*;.*//'
ls -A one one/.rasp
head -n 1 one/manifest.csv
columns one/manifest.csv file_name plan_row material motion_duration_ms text replicate seed frames duration_s level_mode offset_ramp_s status error_code error
(cd one && sha256sum --quiet -c SHA256SUMS) && echo "sums hold: $(wc -l < one/SHA256SUMS)"
echo "-- each stimulus is what its effective scene renders to"
for scene in one/*.scene.yaml; do
    rasp render "$scene" -q -o again.wav
    cmp again.wav "${scene%.scene.yaml}.wav"
    cmp "${scene%.scene.yaml}.wav" again.wav && rm again.*
done
echo "-- the side-car describes every column"
python3 -c '
import csv, json
d, head = json.load(open("one/manifest.json")), next(csv.reader(open("one/manifest.csv")))
print(sorted(head) == sorted(d), d["motion_duration_ms"], d["material"]["Levels"])'
echo "-- one gain: the greatest peak is the level, and only one stimulus has it"
python3 -c '
import csv
rows = list(csv.DictReader(open("one/manifest.csv")))
peaks = sorted(float(r["peak_dbfs"]) for r in rows)
print(len({r["gain_db"] for r in rows}), abs(peaks[-1] + 3) < 1e-5, peaks[-2] < -3.01)'
echo "-- threads, shards"
rasp batch six.yaml -o two -j 4 -q && same one two
for i in 2 3 1; do rasp batch six.yaml -o parts --shard $i/3 -q; done
rasp batch six.yaml -o parts | sed 's/, in .*//' && same one parts
echo "-- again: nothing to do; after damage: that alone"
count() { sed 's/^[^:]*: //; s/, in.*//'; }
rasp batch six.yaml -o one | count
echo x >> one/low_200ms.wav
rm one/*300ms.scene.yaml
rasp batch six.yaml -o one | count && same one two
rasp batch six.yaml -o one --force | count && same one two
echo "-- --json, --dry-run"
rasp batch six.yaml -o one --json | python3 -c 'import json, sys; d = json.load(sys.stdin); print(d["stimuli"], d["ok"], d["kept"], d["failed"], d["full_scale"] > 0)'
rasp batch six.yaml --dry-run | tail -n 3 | sed 's/CPU.*//'
rasp check six.yaml
{ cat six.yaml; echo 'length: own'; } > own.yaml
rasp batch own.yaml --dry-run | tail -n 2 | sed 's/CPU.*//'
rasp check own.yaml
sed 's/low.csv/none.csv/' six.yaml > bad.yaml
rasp check bad.yaml 2> /dev/null || echo "exit $?, and nothing more"
echo "-- a folder elsewhere: the same jobs; moved, its scenes are written again"
mkdir -p far/away
rasp batch six.yaml -o far/away/two -q && cmp <(columns two/manifest.csv job_hash audio_sha256) <(columns far/away/two/manifest.csv job_hash audio_sha256) && echo "the same jobs"
mv far/away/two moved
rasp batch six.yaml -o moved | count && same one moved
echo "-- a set without a sound says so"
rasp new -o starter.yaml
printf '%s\n' 'rasp-design: 1' 'base: starter.yaml' 'set: {surface.object: null}' 'factors: {motion.duration: [0.1 s, 0.2 s]}' > starters.yaml
rasp batch starters.yaml --dry-run | tail -n 2 | sed 's/CPU.*//'
rasp batch starters.yaml -o starters | sed 's/, in .*//'
echo "-- what a dry run lists: what is there, and why the rest would be made; as JSON and of a shard"
cp -r one partly
rm partly/low_200ms.json partly/low_250ms.wav
sed 's/modes.csv/other.csv/' tiny.yaml > tiny.new && cp modes.csv other.csv && sed -i 's/,1000,/,1100,/' other.csv
rasp batch six.yaml -o partly --dry-run | awk 'NF == 7 || NF == 8 { print $2, $NF }' | head -n 7
rasp batch six.yaml -o partly --dry-run --json | python3 -c 'import json, sys; print([r["state"] for r in json.load(sys.stdin)["list"]])'
cp tiny.yaml tiny.old && cp tiny.new tiny.yaml
rasp batch six.yaml -o partly -n --json | python3 -c 'import json, sys; print([r["state"] for r in json.load(sys.stdin)["list"]])'
cp tiny.old tiny.yaml
{ cat six.yaml; echo 'level: {common: {peak: -6 dB}}'; } > quieter.yaml
mv six.yaml six.txt && cp quieter.yaml six.yaml
rasp batch six.yaml -o one -n --json | python3 -c 'import json, sys; print([r["state"] for r in json.load(sys.stdin)["list"]])'
mv six.txt six.yaml
rasp batch six.yaml -o one -n --json > /dev/null && same one two && echo "nothing was written"

rasp batch six.yaml --dry-run --json | python3 -c 'import json, sys
for r in json.load(sys.stdin)["list"]: print(r["row"], r["name"], r["factors"], r["replicate"], r["seed"], r["recording"], round(r["length_s"], 3))'
rasp batch six.yaml --dry-run --shard 2/4 | awk '{ print $1, $2 }'
rasp batch six.yaml --dry-run --shard 2/4 --json | python3 -c 'import json, sys; print([r["name"] for r in json.load(sys.stdin)["list"]])'

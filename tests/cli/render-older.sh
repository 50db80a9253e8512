# What an earlier render left is not replaced silently by nothing: it stays, with a warning, which is in the summary too; a summary lists
# what was written, with the hashes of what is whole before it.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
files() { python3 -c '
import hashlib, json, sys
for f in json.load(open(sys.argv[1]))["files"]:
    right = "sha256" in f and hashlib.sha256(open(f["name"], "rb").read()).hexdigest() == f["sha256"]
    print(f["kind"], f["name"], f.get("contact", "-"), "hash is right" if right else f.get("sha256", "no hash"))' "$1"; }
contact='surface: {roughness: {}, response: modes.csv}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}'
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
printf '%s\n' 'rasp: 1' "contacts: [{name: rod, $contact}]" > one.yaml
printf '%s\n' 'rasp: 1' 'contacts:' "  - {name: rod, $contact}" "  - {name: nail, $contact}" > two.yaml

rasp render -q one.yaml two.yaml --set 'output.diagnostics={}'
files one.json
files two.json
for file in *.csv; do cp $file $file.kept; done
echo "-- without tables"
rasp render -q one.yaml two.yaml
files one.json
files two.json
for file in *.csv; do cmp $file $file.kept; done
python3 -c 'import json; print(json.load(open("two.json"))["warnings"])'
echo "-- forces only; one name with two contacts"
rasp render -q one.yaml --set 'contacts.rod.surface.response=~' --set 'output.diagnostics={}' 
rasp render -q two.yaml -o one.wav
echo "-- JSON: an object of one scene, an array of several, also when one fails"
shape() { python3 -c 'import json, sys; d = json.load(sys.stdin); print(type(d).__name__, len(d) if isinstance(d, list) else "")'; }
mkdir new
rasp render --json one.yaml -o new/ | shape
rasp render --json one.yaml two.yaml -o new/ | shape
printf '%s\n' 'rasp: 1' "contacts: [{name: rod, gain: 0, $contact}]" > wrong.yaml
{ rasp render --json one.yaml two.yaml wrong.yaml -o new/ || echo "exit code $?" >&2; } | shape

# The listing of a series of impacts: its name, one row an impact, the same at any sample rate, in the scene's time; the column of the diagnostics; notes and
# warnings; what an earlier render left; and a folder that cannot be written.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
summary() { python3 -c '
import json, sys
d = json.load(open(sys.argv[1]))
for f in d["files"]: print(f["kind"], f["name"], f.get("contact", "-"))
for c in d["contacts"]: print(c["name"], {k: v for k, v in c.get("impacts", {}).items() if isinstance(v, int)})
for w in d["warnings"]: print(w)' "$1"; }
impacts='motion: {path: still, duration: 1 s}, contact: {model: impacts, impacts: {prototype: roll, roughness: 0.3}}'
printf '%s\n' 'rasp: 1' 'seed: 3' "contacts: [{name: one, $impacts}]" 'output: {impacts: table, diagnostics: {rate: 100 Hz, columns: [time_s, impacts]}}' > one.yaml
rasp render one.yaml | sed 's/ s, .* times real time/ s/'
summary one.json
head -2 one.impacts.csv
echo "-- rows of the listing, and the column's sum (but for what comes before 0)"
awk -F, 'NR > 1 && $1 >= 0' one.impacts.csv | wc -l
awk -F, 'NR > 1 { n += $2 } END { print n }' one.csv
echo "-- the same at any rate"
for rate in 22.05 192; do
    rasp render -q one.yaml -o at$rate.wav --set "output.sample_rate=$rate kHz"
    cmp one.impacts.csv at$rate.impacts.csv
done
echo "-- alone: nothing else runs"
rasp plan one.yaml --set output.diagnostics=~ | grep -v 'not run'
echo "-- of two contacts, of which one begins later; a third has no series"
printf '%s\n' 'rasp: 1' 'seed: 3' 'output: {impacts: table}' 'contacts:' "  - {name: one, $impacts}" "  - {name: two, start: 0.5 s, $impacts}" \
    '  - {name: three, motion: {path: line, to: [1 cm, 0], duration: 1}, surface: {roughness: {}, material: glass, object: {shape: bar, length: 20 cm, width: 2 cm, thickness: 1 mm}}, scraper: {mass: 1 g}}' > two.yaml
rasp render -q two.yaml -o one.wav
summary one.json
awk -F, 'NR == 2 { print ($1 > 0.49 && $1 < 0.51) }' one.two.impacts.csv
cmp one.impacts.csv one.one.impacts.csv
echo "-- without: it stays, with a warning"
rasp render -q one.yaml --set output.impacts=none
echo "-- floors and long impacts are told"
rasp render -q one.yaml -o often.wav --set contacts.one.contact.impacts.amplitude.deviation=0.3 --set contacts.one.contact.impacts.duration.zeta='0.1 s'
echo "-- told at its place"
rasp render one.yaml --set contacts.one.contact.impacts.prototype=custom || echo "exit code $?" >&2
rasp render one.yaml --set contacts.one.contact.impacts.prototype=space --set contacts.one.contact.impacts.space.walk=walk.csv || echo "exit code $?" >&2

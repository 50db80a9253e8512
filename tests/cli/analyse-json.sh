# The figures as JSON, read back by another program; null for what is not there.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
. "$ROOT/tests/cli/analyse-make.inc"
read_json() { python3 -c "import json,sys; d = json.load(sys.stdin); print($1)" < report.json; }
impacts 600 0.8e-3 0.25 > impacts.csv
force 44100 < impacts.csv > force.csv
rasp analyse force.csv --json -o part.yaml > report.json
read_json "sorted(d), sorted(d['statistics']), sorted(d['statistics']['interval_s'])"
read_json "d['source']['impacts'], d['source']['alone'], d['single'], d['written'], d['duration']['theta_from']"
read_json "'%.3f %.3f' % (d['duration']['theta'], 1e3 * d['duration']['zeta_s']), '%.3f' % d['statistics']['amplitude_n']['mean']['value']"
read_json "len(d['statistics']['cross_correlation']), '%.3f' % d['statistics']['amplitude_n']['correlation'][0], len(d['shape']['mean'])"
head -20 impacts.csv > few.csv
rasp analyse few.csv --json > report.json
read_json "d['statistics'], d['shape'], d['source']['impacts'], len(d['notes'])"

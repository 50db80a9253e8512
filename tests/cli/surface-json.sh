# The figures as JSON, read back by another program; null for what is not there.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
. "$ROOT/tests/cli/surface-make.inc"
read_json() { python3 -c "import json,sys; d = json.load(sys.stdin)['surfaces']; print($1)"; }
map > map.csv
rasp surface info --json "$ROOT/surfaces/ridged_plate.gsf" > report.json
read_json "len(d), d[0]['format'], d[0]['title'], d[0]['columns'], d[0]['rows'], d[0]['pitch_y_m'], d[0]['band_y'], d[0]['missing'], d[0]['warnings'] != []" < report.json
read_json "'%.4g %.4g' % (d[0]['heights']['sq_m'], d[0]['heights']['sz_m']), sorted(d[0])" < report.json
rasp surface info --json --pitch 20um --height-scale 1um map.csv map.csv > report.json
read_json "len(d), d[1]['pitch_y_m'], '%.6g' % d[1]['slope_x'], d[1]['quantisation']['limiter'], d[1]['ends_y']['fall_samples'], d[1]['repetition']" < report.json
rasp surface info -j --pitch 20um --height-scale 1um nothing.csv map.csv > report.json || echo "exit code $?"
read_json "len(d)" < report.json

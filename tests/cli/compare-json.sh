# The figures as JSON, read back by another program.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 0 16384 -16384 8192 > a.wav
wav 8000 1 0 16384 -16387 8192 > b.wav
printf 't,v\n0,1\n1,2\n' > a.csv
printf 't,v\n0,1\n1,2.5\n' > b.csv
read_json() { python3 -c "import json,sys; d = json.load(sys.stdin); print($1)"; }
rasp compare --json --lsb 3 a.wav b.wav | read_json "d['equal'], d['held'], d['largest_difference_lsb'], d['first_difference']['frame'], d['snr_db']"
rasp compare --json a.wav a.wav | read_json "d['equal'], d['snr_db'], d['criteria']"
rasp compare --json a.csv b.csv > report.json || echo "exit $?"
read_json "d['held'], d['rows_compared'], d['columns'][1]['misses'], d['columns'][1]['worst']" < report.json
rasp compare --json --abs 1 a.csv b.csv | read_json "d['equal'], d['held'], d['columns'][1]['largest_difference']"
rasp compare --json -q a.wav a.wav

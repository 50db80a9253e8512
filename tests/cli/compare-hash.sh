# The SHA-256 of the audio against another program's, of tables against sha256sum; --hash checks one file.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
. "$ROOT/tests/cli/compare-make.inc"
try() { rasp compare "$@" || echo "exit $?"; }
wav 8000 2 0 100 16384 -100 > a.wav
wav 8000 2 0 100 16384 -101 > b.wav
wav 8000 1 0 100 16384 -100 > mono.wav
wav 4000 2 0 100 16384 -100 > slow.wav
printf 't,v\n0,1\n' > a.csv
printf 't,v\n0,1.0\n' > b.csv
A=$(python3 -c 'import hashlib, struct; print(hashlib.sha256(struct.pack("<6d", 8000, 2, 0, 100 / 32768, 0.5, -100 / 32768)).hexdigest())')
T=$(sha256sum a.csv | cut -d ' ' -f 1)
# The same audio, other bytes: a chunk more behind the data.
{ wav 8000 2 0 100 16384 -100 && printf 'junk' && le 4 4 && printf 'more'; } > same.wav
rasp compare a.wav same.wav | grep -c "^sha256  A $A B $A$"
rasp compare a.csv a.csv | grep -c "^sha256  A $T B $T$"
rasp compare a.wav b.wav | grep '^sha256' || echo "exit $?"
rasp compare --abs 0 a.csv b.csv | grep '^sha256'
{ rasp compare --json a.wav b.wav || true; } | python3 -c "import json,sys; h = json.load(sys.stdin)['audio_sha256']; print(h[0] == '$A', len(h), h[0] == h[1])"
{ rasp compare --json a.wav slow.wav || true; } | python3 -c "
import json, sys
d = json.load(sys.stdin)
print(d['differing_samples'], d['frames_compared'], d['snr_db'], d['largest_difference'], d['largest_difference_dbfs'], d['a']['duration_s'], d['b']['duration_s'])"
{ rasp compare --json a.csv b.csv || true; } | python3 -c "import json,sys; h = json.load(sys.stdin)['file_sha256']; print(h[0] == '$T', h[0] == h[1])"
echo "one file"
try a.wav --hash "$A"
try -q --hash="$(echo "$A" | tr a-f A-F)" same.wav
try -q a.csv --hash "$T"
for file in b mono slow; do try -q $file.wav --hash "$A" | sed 's/sha256: [0-9a-f]*,/sha256: ...,/'; done
try b.csv --hash "$T"
try --json b.csv --hash "$T"
echo "wrong"
try gone.wav --hash "$A"
try a.wav --hash "${A#?}"
try a.wav --hash "${A}0"
try a.wav --hash "g${A#?}"
try a.wav --hash ""
try a.wav a.wav --hash "$A"
try a.wav --exact --hash "$A"
try --snr 3 a.wav --hash "$A"
try a.wav
printf 't,v\n' > rows.csv
try rows.csv --hash "$T"
# Hash and --exact are of one mind.
for other in a same b mono slow; do
    rasp compare -q --exact a.wav $other.wav > log && exact=0 || exact=$?
    rasp compare -q $other.wav --hash "$A" > log && hash=0 || hash=$?
    echo "$other: exact $exact, hash $hash"
done

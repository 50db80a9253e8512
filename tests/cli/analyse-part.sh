# The parameter file, by itself and with tables beside it, in a scene that includes it; and what keeps it from being written.
. "$ROOT/tests/cli/analyse-make.inc"
try() { "$@" > report || echo "exit code $?"; }
impacts 600 0.8e-3 0.25 > "it's impacts.csv"
mkdir parts
rasp analyse "it's impacts.csv" -o parts/part.yaml | grep -A 9 '^written'
cat parts/part.yaml
cat > scene.yaml <<'END'
rasp: 1
include: [parts/part.yaml]
motion: {path: still, at: [0 m, 0 m], duration: 100 ms}
output: {quantity: force}
END
rasp check scene.yaml
rasp analyse "it's impacts.csv" -o "parts/it's.yaml" --distribution table | grep -A 9 '^written'
grep -A 3 interval: "parts/it's.yaml"
head -4 "parts/it's.interval.csv"
sed "s/part.yaml/it's.yaml/" scene.yaml > tables.yaml
rasp check tables.yaml
rasp render tables.yaml -q
echo "-- not again"
try rasp analyse "it's impacts.csv" -o parts/part.yaml
try rasp analyse "it's impacts.csv" -o parts/part.yaml --force
try rasp analyse "it's impacts.csv" -o parts/part.yml
rm "parts/it's.yaml"
try rasp analyse "it's impacts.csv" -o "parts/it's.yaml" --distribution table
cp "it's impacts.csv" own.amplitude.csv
try rasp analyse own.amplitude.csv -o own.yaml --distribution table --force
try rasp analyse "it's impacts.csv" -o nowhere/part.yaml
cut -d, -f1,2 "it's impacts.csv" > lengthless.csv
try rasp analyse lengthless.csv -o lengthless.yaml
head -20 "it's impacts.csv" > few.csv
try rasp analyse few.csv -o few.yaml
mkdir parts/taken.interval.csv
try rasp analyse "it's impacts.csv" -o parts/taken.yaml --distribution table
rm report
ls . parts
echo "-- no law: a constant, or nothing"
awk -F, 'NR == 1 { print; next } { printf "%s,%s,%.9g\n", $1, $2, 0.001 * $2 }' "it's impacts.csv" > against.csv
rasp analyse against.csv --single "it's impacts.csv" -o against.yaml | grep -A 9 'step 2'
grep duration: against.yaml
awk 'BEGIN { print "time_s,force_n"; for (i = 0; i < 44100; i++) printf "%.9f,%.9g\n", i / 44100, i % 9000 < 300 ? 0 : 2 + 0.4 * sin(i / 20) * (1 + 0.2 * sin(i / 999)) }' > never.csv
rasp analyse never.csv --single "it's impacts.csv" -o never.yaml | grep -E 'alone|step 2|duration is'
grep duration: never.yaml
awk -F, 'NR == 1 || $1 > 0.01 && $1 < 0.2' never.csv > always.csv
try rasp analyse always.csv -o always.yaml; cat report | grep 'duration is'
[ ! -e always.yaml ] || echo "a part was written"

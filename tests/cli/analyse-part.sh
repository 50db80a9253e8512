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
echo "-- what is written is a scene: a metronome of seven beats, a rub"
try_scene() { rasp analyse "$1" -o parts/part.yaml --force > report && rasp render scene.yaml -q --set motion.duration="1 s" && echo "$1: ok"; }
for beat in 0.66668 2.26757e-05 0.0011837 0.029424 0.16199 0.20336 0.0001263; do
    awk -v beat=$beat 'BEGIN { print "time_s,amplitude_n,duration_s"; for (i = 0; i < 60; i++) printf "%.17g,1,0.00001\n", 0.37 + i * beat }' > "every $beat.csv"
    try_scene "every $beat.csv"
done
cat > rub.yaml <<'END'
rasp: 1
motion: {path: still, at: [0 m, 0 m], duration: 1 s}
contact: {model: impacts, impacts: {prototype: rub}}
output: {quantity: force, impacts: table}
END
rasp render rub.yaml -q
try_scene rub.impacts.csv
echo "-- nor is a part written that no scene takes: modulated at 2 kHz; a law that makes the weakest impacts last for minutes; impacts every 0.5 us"
awk -F, 'NR > 1 { $1 = NR * 1e-4; $2 *= 1 + 0.3 * sin(12740.5 * $1) } { print $1 "," $2 "," $3 }' "it's impacts.csv" > fast.csv
try rasp analyse fast.csv -o fast.yaml
awk -F, 'NR > 1 { $3 = 0.02 * $2 ^ -1.8 } { print $1 "," $2 "," $3 }' "it's impacts.csv" > long.csv
try rasp analyse long.csv -o long.yaml
awk -F, 'NR > 1 { $1 = NR * 5e-7 } { print $1 "," $2 "," $3 }' "it's impacts.csv" > short.csv
try rasp analyse short.csv -o short.yaml
for file in fast long short; do [ ! -e $file.yaml ] || echo "$file.yaml was written"; done
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

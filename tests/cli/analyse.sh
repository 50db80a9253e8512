# A series of impacts, as a table and as a force made of it: the same figures.
. "$ROOT/tests/cli/analyse-make.inc"
impacts 600 0.8e-3 0.25 > impacts.csv
force 44100 < impacts.csv > force.csv
rasp analyse impacts.csv
echo
rasp analyse force.csv
echo
echo "-- other ways to theta"
rasp analyse force.csv --theta 0.2 | grep duration
impacts 60 1e-3 0.3 | force 44100 > single.csv
rasp analyse force.csv --single single.csv | grep -E 'duration|single.csv'
rasp analyse impacts.csv --single single.csv | grep duration
echo "-- too few for statistics"
head -20 impacts.csv > few.csv
rasp analyse few.csv
echo "-- a column, and a unit of its own"
sed '1s/force_n/push/' force.csv > push.csv
rasp analyse push.csv --column push --scale 0.001 | head -3
echo "-- what counts as an impact"
rasp analyse force.csv --threshold 0.9 | head -3
echo "-- all alike"
awk 'BEGIN { print "time_s,amplitude_n,duration_s"; for (i = 0; i < 60; i++) printf "%.3f,1,0.001\n", i * 0.01 }' > alike.csv
rasp analyse alike.csv
echo "-- a contact that never parts: a force that ripples"
awk 'BEGIN { print "time_s,force_n"; for (i = 0; i < 4410; i++) { x = (i * 7919) % 101; printf "%.9f,%.9g\n", i / 44100, (i > 10 && i < 4400) ? 1 + 1e-5 * x : 0 } }' > ripple.csv
rasp analyse ripple.csv
echo "-- theta that the durations belie"
awk 'BEGIN { print "time_s,amplitude_n,duration_s"; for (i = 0; i < 60; i++) printf "%.3f,%.3f,%.9f\n", i * 0.01, 1 + i % 7 / 7, 0.001 * (1 + i % 7 / 7) ^ 0.1 }' > longer.csv
rasp analyse longer.csv --theta 1 | grep -A 2 'does not hold here'
echo "-- durations all alike under amplitudes that differ: theta is 0, and nothing against it; a theta that is given does not hold"
awk -F, 'NR > 1 { $3 = 0.001 } { print $1 "," $2 "," $3 }' impacts.csv > fixed.csv
rasp analyse fixed.csv | grep -E 'duration|hold'
rasp analyse fixed.csv --theta 1 | grep -A 2 'does not hold here'
echo "-- where no modulation is looked for: not asked for; amplitudes of both signs"
rasp analyse force.csv --keep-modulation | grep modulation
awk -F, 'NR > 1 && NR % 2 { $2 = -$2 } { print $1 "," $2 "," $3 }' impacts.csv > signed.csv
rasp analyse signed.csv | grep modulation
echo "-- outliers that leave the bulk normal"
awk -F, 'NR > 1 && NR % 150 == 0 { $2 *= 1.25 } { print $1 "," $2 "," $3 }' impacts.csv > outliers.csv
rasp analyse outliers.csv | grep -A 2 'has outliers'
echo "-- durations that scatter, whatever the amplitude: a constant, and nothing against it"
awk -F, 'NR > 1 { for (k = x = 0; k < 12; k++) { s = (s * 16807 + 5) % 2147483647; x += s / 2147483647 } $3 = 0.0005 * exp(0.6 * (x - 6)) } { print $1 "," $2 "," $3 }' impacts.csv > scattered.csv
rasp analyse scattered.csv | grep -E 'duration|hold'
rasp analyse scattered.csv --theta 0 | grep -E 'duration|hold'
echo "-- one impact that outweighs all others, in a table and in a force"
awk -F, 'NR == 300 { $2 *= 1e30 } { print $1 "," $2 "," $3 }' impacts.csv > one.csv
rasp analyse one.csv | grep -E -A 1 'outweighs|smallest'
force 44100 < one.csv > hidden.csv
rasp analyse hidden.csv | grep -B 1 -A 1 outweighs
echo "-- a floor, in a force where impacts stand apart"
awk -F, 'NR > 1 && $2 < 0.75 { $2 = 0.75 } { print $1 "," $2 "," $3 }' impacts.csv | force 44100 > floor.csv
rasp analyse floor.csv | grep -A 1 smallest
echo "-- rolling on a rough surface: its floors in the listing, modulated or not; the force says that it cannot tell"
cat > rough.yaml <<'END'
rasp: 1
motion: {path: still, at: [0 m, 0 m], duration: 30 s}
contact: {model: impacts, impacts: {prototype: roll, roughness: 1}}
load: {approach: 0 s, release: 0 s}
output: {quantity: force, encoding: float64, level: {full_scale: 1 N}, sample_rate: 48 kHz, impacts: table}
END
for depth in 0 0.3; do
    rasp render rough.yaml -q -o rough.wav --set contact.impacts.modulation.depth=$depth
    echo "depth $depth"
    rasp analyse rough.impacts.csv > report; tr -s '\n ' '  ' < report | grep -oE '[0-9.]+ % of the amplitudes are the smallest one, (about )?[0-9.]+: raised to a floor'
    rasp analyse rough.wav --scale 1 > report; tr -s '\n ' '  ' < report | grep -oE '(of the amplitudes are|whether draws|and where draws)[^,.]*'
done
echo "-- rubbing: impacts that touch do not run into each other, as its render says"
sed 's/roll, roughness: 1/rub/; s/30 s/2 s/' rough.yaml > rub.yaml
rasp render rub.yaml 2>&1 | grep -o '[0-9]* overlaps'
rasp analyse rub.impacts.csv | head -1
rasp analyse rub.impacts.csv --json | grep run_into
echo "-- amplitudes of 0, amplitudes below 0"
awk -F, 'NR > 1 { $2 = 0 } { print $1 "," $2 "," $3 }' impacts.csv > nought.csv
rasp analyse nought.csv | grep 'duration is known'
awk -F, 'NR > 1 { $2 = -$2 } { print $1 "," $2 "," $3 }' impacts.csv > below.csv
rasp analyse below.csv | grep exponential
echo "-- a recording that clips"
awk -F, 'NR > 1 && $2 > 0.8 { $2 = 0.8 } { print $1 "," $2 }' force.csv > clipped.csv
rasp analyse clipped.csv | grep -A 1 'stands still'
echo "-- impacts that keep to a beat: a zero on the circle"
awk -F, 'NR > 1 { $1 = 0.01 * NR + 0.001 * sin(NR * NR) } { print $1 "," $2 "," $3 }' impacts.csv > beat.csv
rasp analyse beat.csv | grep -E '^  (a1|b1)|intervals: a1'

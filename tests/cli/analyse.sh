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

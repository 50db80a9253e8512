# What cannot be analysed, and options that make no sense.
. "$ROOT/tests/cli/analyse-make.inc"
try() { "$@" > /dev/null || echo "exit code $?" >&2; }
impacts 60 0.8e-3 0.25 > impacts.csv
force 44100 < impacts.csv > force.csv
printf 'time_s,x\n0,1\n1,2\n' > other.csv
printf 'time_s,force_n\n0,1\n1,2\n3,1\n4,0\n' > uneven.csv
printf 'time_s,force_n\n0,0\n1,0\n2,0\n' > still.csv
awk 'BEGIN { print "time_s,force_n"; for (i = 0; i < 30000; i++) printf "%.9f,0\n", (i + (i >= 20000)) / 44100 }' > gap.csv
printf 'time_s,force_n\n0,1\n' > one.csv
printf 'time_s,amplitude_n\n0,1\n' > lone.csv
printf 'time_s,amplitude_n\n0,1\n0,2\n' > backwards.csv
printf 'time_s,amplitude_n,duration_s\n0,1,1\n1,2,0\n' > short.csv
printf 'time_s,amplitude_n\n0,1\n1,much\n' > words.csv
printf 'time_s,force_n\n0,0\n1e-3,1\n2e-3,0\n' > single.csv
echo no sound > no.wav
cp "$ROOT/irs/ceramic_tile_tap.wav" .
try rasp analyse
try rasp analyse nothing.csv
try rasp analyse nothing.wav
try rasp analyse no.wav
try rasp analyse ceramic_tile_tap.wav
try rasp analyse ceramic_tile_tap.wav --scale 1 --channel 2
for file in other uneven gap still one lone backwards short words; do try rasp analyse $file.csv; done
try rasp analyse force.csv --column push
try rasp analyse force.csv --rate 44100
try rasp analyse force.csv --channel 2
try rasp analyse impacts.csv --scale 2
try rasp analyse impacts.csv --signed
try rasp analyse force.csv --silence 0.5
try rasp analyse force.csv --theta 3
try rasp analyse force.csv --theta 0.2 --single force.csv
try rasp analyse force.csv --single single.csv
try rasp analyse force.csv --distribution normal
try rasp analyse force.csv --format pdf
try rasp analyse force.csv impacts.csv
printf '\223NUMPY\1\0v\0%-117s\n' '{"descr": "<f8", "fortran_order": False, "shape": (2,), }' > two.npy
head -c 16 /dev/zero >> two.npy
try rasp analyse two.npy
try rasp analyse two.npy --rate 48000
try rasp analyse force.csv --scale 1e-300
try rasp analyse force.csv --scale 1e300
awk -F, 'NR > 1 { $2 = -$2 } { print $1 "," $2 }' force.csv > below.csv
awk -F, 'NR == 40 { $2 = "1e200" } { print $1 "," $2 "," $3 }' impacts.csv > beyond.csv
awk -F, 'NR == 40 { $3 = "1e200" } { print $1 "," $2 "," $3 }' impacts.csv > endless.csv
for file in below beyond endless; do try rasp analyse $file.csv; done
rm below.csv beyond.csv endless.csv
ls

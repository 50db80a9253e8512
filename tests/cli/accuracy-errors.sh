# What rasp accuracy refuses, with what words and exit code; nothing half-written, nothing left in the temporary folder.
try() { "$@" || echo "exit code $?" >&2; }
mkdir tmp
export TMPDIR=$PWD/tmp
cat > scene.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], duration: 0.1 s}
output: {diagnostics: {rate: 1 kHz}}
YAML
cat > hard.yaml <<'YAML'
rasp: 1
surface: {fractal: {exponent: -0.5, maximum: 0.1 um, pitch: 0.1 mm}}
ball: {radius: 1 cm, material: steel, patch: 0}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
contact: {model: roll_coupled, roll: {kappa: 5e13 N/(m^1.5 kg), mu: 1 s/m, ground: rigid}}
output: {quantity: force}
YAML
cat > recorded.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: recorded, file: motion.csv, cutoff: 0 Hz}
output: {quantity: force}
YAML
printf 'time_s,x_m,y_m\n0,0,0\n0.05,0.01,0\n0.1,0.02,0\n' > motion.csv
try rasp accuracy
try rasp accuracy none.yaml
try rasp accuracy scene.yaml --values oversampling=2,65
try rasp accuracy scene.yaml --values oversampling=2.5
try rasp accuracy scene.yaml --values gain_ramp=0
try rasp accuracy scene.yaml --values oversampling=two
try rasp accuracy scene.yaml --values oversampling=2,,4
try rasp accuracy scene.yaml --values oversampling
try rasp accuracy scene.yaml --values oversamplin=2
try rasp accuracy scene.yaml --values speed=2
try rasp accuracy scene.yaml --values contact_steps=4
try rasp accuracy scene.yaml --errors=-40,ten
try rasp accuracy scene.yaml --errors=3
try rasp accuracy scene.yaml --excerpt=0
try rasp accuracy scene.yaml --runs 0
try rasp accuracy scene.yaml --csv table.txt
try rasp accuracy scene.yaml --plot picture.pdf
try rasp accuracy scene.yaml --csv nowhere/table.csv
try rasp accuracy recorded.yaml --csv motion.csv
try rasp accuracy scene.yaml --set motion.duration=0
try rasp accuracy scene.yaml --set 'surface.roughness.rms=5 kg'
TMPDIR=$PWD/gone try rasp accuracy scene.yaml
cmp motion.csv - << 'CSV'
time_s,x_m,y_m
0,0,0
0.05,0.01,0
0.1,0.02,0
CSV
# a setting that the scene refuses is told with the render's own words, and the others are shown
rasp accuracy hard.yaml --runs 1 --errors=-20 --values contact_steps=100000 --csv hard.csv > table
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $1 == "contact_steps" && $2 == 100000 { print $at["exit_code"], ($at["snr_db"] $at["cpu_s"] == "" ? "no figures" : $0); next }
    $1 == "asked" { next }
    $at["exit_code"] != 0 { print "refused, too: " $0 }' hard.csv
grep '^exit 65 with contact_steps' table | grep -Eo "^exit 65 with contact_steps 100000(, else reference)?: hard.yaml: --set accuracy.contact_steps: contact 'contact': an impact|lower accuracy.contact_steps"
# when the scene itself fails, the program ends as the render does
sed "s/kappa: 5e13/kappa: 9e17/; s/quantity: force/&, sample_rate: 8 kHz/" hard.yaml > worse.yaml
try rasp accuracy worse.yaml --csv worse.csv 2>&1 | grep -Eo '^rasp accuracy: error: the render with [a-z ]*reference ended with exit code [0-9]+|exit code [0-9]+$'
# a signal: 75, and nothing stays
rasp accuracy scene.yaml --set 'motion.duration=20 s' --set 'motion.to=[10 m, 0]' --csv late.csv > late 2> late.err &
pid=$!
for _ in $(seq 200); do
    [ -z "$(ls tmp)" ] || break
    sleep 0.02
done
sleep 0.2
kill -TERM $pid
wait $pid || echo "exit code $?"
cat late late.err
ls tmp
ls

# Nothing that a command writes takes the place of what it reads, nor of what the sound that it draws was made from. And what would never come to an end is refused.
cp "$ROOT/surfaces/basswood.gsf" oak.gsf
tell() { "$@" 2>&1 || echo "exit $?"; }
echo "-- a picture"
rasp surface convert oak.gsf oak.png -q --height-range "40 um" 2> /dev/null || rasp surface convert oak.gsf oak.png -q
printf '%s\n' 'rasp: 1' 'surface: {height_map: oak.png, pitch: 10 um, height_range: 40 um, off_map: wrap}' 'scraper: {mass: 10 g}' 'motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}' \
    'output: {sample_rate: 8 kHz, diagnostics: {rate: 1 kHz}}' > oak.yaml
rasp render oak.yaml -q
sha256sum oak.png > sums
command -v gnuplot > /dev/null || { echo "no gnuplot"; exit 77; }
tell rasp plot oak.csv
sha256sum -c --quiet sums
rasp plot oak.csv -o other.png > /dev/null
rasp plot oak.csv -o other.png > /dev/null && echo "drawn, twice"
echo "-- heights"
ln oak.gsf link.gsf
sha256sum oak.gsf > sums
tell rasp surface convert oak.gsf oak.gsf --crop 0,0,0.5mm,0.5mm
tell rasp surface convert oak.gsf link.gsf
echo 'roughness: {like: oak.gsf}' > like.yaml
tell rasp surface synth like.yaml oak.gsf --size 1mm --pitch 5um
sha256sum -c --quiet sums
echo "-- what is named by a scene must be a file"
mkfifo pipe.yaml
printf '%s\n' 'rasp: 1' 'include: [pipe.yaml]' > including.yaml
tell timeout 10 rasp check including.yaml
printf '%s\n' 'rasp-design: 1' 'base: pipe.yaml' 'factors: {motion.rate: [1 Hz]}' > set.yaml
tell timeout 10 rasp batch set.yaml --dry-run
tell timeout 10 rasp check /dev/zero
mkdir taps
mkfifo taps/pipe.wav
printf '%s\n' 'rasp: 1' 'surface: {roughness: {rms: 4 um}, response: taps}' 'scraper: {mass: 10 g}' 'motion: {path: line, to: [2 cm, 0], duration: 0.1 s}' > tapped.yaml
printf '%s\n' file_name,x_m,y_m pipe.wav,0,0 > taps/index.csv
printf '%s\n' 'rasp-design: 1' 'base: tapped.yaml' 'factors: {motion.duration: [0.1 s]}' > tapset.yaml
for call in 'check tapped.yaml' 'render tapped.yaml' 'plan tapped.yaml' 'batch tapset.yaml --dry-run' 'modes extract taps -o taps.csv'; do
    # shellcheck disable=SC2086
    tell timeout 10 rasp $call
done
rm taps/index.csv
for index in 'mkfifo taps/index.csv' 'ln -s /dev/zero taps/index.csv' 'mkdir taps/index.csv'; do
    $index
    tell timeout 10 rasp check tapped.yaml
    tell timeout 10 rasp modes extract taps -o taps.csv
    rm -r taps/index.csv
done
echo "-- words that are folders, too"
mkdir design factors motion
rasp explain design | head -n 1
rasp explain factors | head -n 1
rasp explain motion | head -n 1
echo "-- the command line's errors as JSON"
for call in 'plot --panels foo x.wav' 'new nope' check 'check --nope x'; do
    # shellcheck disable=SC2086
    tell rasp $call --diagnostics=json
done

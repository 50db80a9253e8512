# surface.band: the strongest modes are chosen from it, whatever the sample rate; what is chosen and cannot ring at the rate is counted in a warning, which the summary holds, too.
. "$ROOT/tests/lib/test.sh"

scene() {
    cat << YAML
rasp: 1
surface: {material: glass, object: {shape: shell, diameter: 20 cm, thickness: 4 mm}, modes: 30$1}
scraper: {mass: 4 g, radius: 5 mm, material: steel}
motion: {path: still, at: [0, 0], duration: 0.05 s}
contact: {model: strike, strike: {speed: 1 m/s}}
output: {tail: 0.1 s, sample_rate: $2}
YAML
}

scene "" 22050 > low.yaml
scene "" 48000 > high.yaml
scene ", band: [20 Hz, 9.9 kHz]" 22050 > narrow.yaml
scene ", band: [100 kHz, 200 kHz]" 48000 > empty.yaml
scene ", band: [2 kHz, 1 kHz]" 48000 > wrong.yaml
scene ", band: [20 Hz, 21 Hz]" 48000 > between.yaml

rasp render low.yaml -q -o low.wav 2> low.txt
grep -o '[0-9]* of its [0-9]* strongest modes lie.*' low.txt
grep -c 'strongest modes lie' low.json
rasp render high.yaml -q -o high.wav 2> high.txt
grep 'strongest modes' high.txt high.json && fail 'a warning where all modes ring'
rasp render narrow.yaml -q -o narrow.wav 2> narrow.txt
grep 'strongest modes' narrow.txt narrow.json && fail 'a warning where the band ends below 0.45 of the rate'
expect_exit 65 rasp render empty.yaml -q -o empty.wav
cat err
expect_exit 65 rasp check wrong.yaml
cat err
expect_exit 65 rasp check between.yaml
cat err
[ ! -e empty.wav ] || fail 'empty.wav is there'
finish

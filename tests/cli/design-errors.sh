# What is wrong with a design is told all at once, with its line; what is wrong with scenes, where the design says it, and once for all stimuli.
rasp new -o scrape.yaml
tell() {
    local code=0
    echo "--- $*" >&2
    rasp "$@" || code=$?
    echo "$code"
}
cat > form.yaml <<'X'
rasp-design: 1
titel: x
base: scrape.yaml
seed: -1
replicates: 0
set: {motion.raet: 3 Hz, output.sample_rate: 48 kg, seed: 4, output.level.peak: -3 dB, include: [x.yaml]}
factors:
  motion.rate: [1 Hz, 2 m, 1 Hz]
  rate: [1 Hz, 2 Hz]
  material:
    - {label: wood, set: {surface.response: []}}
    - {label: wood, set: {motion.rate: 3 Hz}, sett: 3}
    - {set: {motion: {durations: 1 s}}}
  motion.law: []
independent: [materail, rate, rate]
order: random
level: {common: {peak: 3 dB}}
length: 2 m
name: "{material}_{rate}_{motion.raet}"
X
tell check form.yaml
cat > cells.yaml <<'X'
rasp-design: 1
base: scrape.yaml
factors:
  motion.rate: [1 Hz, 2 Hz]
  material: [{label: wood}, {label: dark wood}]
exclude:
  - {material: wood, motion.rate: 3 Hz}
  - {materail: wood}
  - {}
recordings: [{fiel: x}, {file: a.wav, material: wod}]
X
tell check cells.yaml
sed '/^exclude/,$d' cells.yaml > clash.yaml
cp clash.yaml none.yaml
cp clash.yaml listed.yaml
echo 'name: "{material}"' >> clash.yaml
tell check clash.yaml
echo 'exclude: [{material: [wood, dark wood]}]' >> none.yaml
tell check none.yaml
printf 'cells: [{material: wood, motion.rate: 1 Hz}, {material: wood, motion.rate: 1 Hz}]\n' >> listed.yaml
tell check listed.yaml
sed -i 's/^cells.*/cells: [{material: wood, motion.rate: 1 Hz}, {material: dark wood}]/' listed.yaml
tell check listed.yaml
sed -i 's/, {material: dark wood}]$/]/' listed.yaml
echo 'exclude: [{material: dark wood}]' >> listed.yaml
tell check listed.yaml
cat > scenes.yaml <<'X'
rasp-design: 1
base: scrape.yaml
factors:
  motion.rate: [1 Hz, 90 Hz]
  what: [{label: good}, {label: bad, set: {motion.path: line}}, {label: gone, base: gone.yaml}]
  again: [{label: a}, {label: b, set: {surface.response: none.csv}}]
recordings: [{file: none.wav}]
X
tell check scenes.yaml
tell check --seed 3 scenes.yaml
tell render scenes.yaml
sed 's/^rasp-design: 1/rasp-design: 2/; s/^base.*/bass: x/' scenes.yaml > later.yaml
tell check later.yaml
printf '%s\n' 'rasp-design: 1' 'base: scrape.yaml' 'factors:' '  output.level.peak: [-3 dB, -6 dB, -9 dB]' '  motion.rate: [1 Hz, 2 Hz, 3 Hz]' > peaks.yaml
tell check peaks.yaml
printf '%s\n' 'rasp-design: 1' 'base: scrape.yaml' 'factors:' '  motion.rate: [2 Hz, 1 Hz, 2.0 Hz, 1000 mHz]' '  scraper.mass: [{label: "20 g", value: 20 g}, {label: 0.02 kg, value: 20 g}, {label: light, value: 20 g}]' '  tip: [{label: 1 mm}, {label: 0.1 cm}]' > equal.yaml
tell check equal.yaml
printf '%s\n' 'rasp-design: 1' 'base: scrape.yaml' 'factors: {motion.rate: [1 Hz, 2 Hz]}' 'name: "SHA256SUMS/{motion.rate}"' > sums.yaml
tell check sums.yaml
for key in motion.rat motion.tempo; do
    printf '%s\n' 'rasp-design: 1' 'base: scrape.yaml' "factors: {$key: [1 Hz, 2 Hz]}" > near.yaml
    tell check near.yaml
done
# Promises that cannot be kept: each once, with its place.
printf '%s\n' 'rasp-design: 1' 'base: scrape.yaml' 'order: {seed: 3}' 'set: {motion.duration: 50 ms, surface.modes: 2, surface.roughness.shortest: 0.5 mm}' 'factors:' '  accuracy.error: [-40 dB, -200 dB, -210 dB]' '  motion.rate: [1 Hz, 2 Hz]' 'exclude: [{accuracy.error: -40 dB, motion.rate: 1 Hz}]' > promises.yaml
tell check promises.yaml
# a scene in place of a design, as a design in place of a scene
tell batch scrape.yaml -o out
tell render form.yaml

# What cannot be rendered is found out of each stimulus before anything is: of replicates, too, where more than their noise differs; and a loudness that no such length has.
. "$ROOT/tests/cli/batch-make.inc"
counts() {
    local code=0
    rasp check set.yaml > told.txt 2>&1 || code=$?
    echo "check: exit $code, $(grep -o '[0-9]* of [0-9]* stimuli cannot be rendered' told.txt || echo ok)"
    code=0
    rasp batch set.yaml -o out -q > told.txt 2>&1 || code=$?
    echo "batch: exit $code, $(grep -o '[0-9]* of [0-9]* stimuli .*' told.txt || echo ok)"
    rm -rf out
}
echo "-- a scribble goes where its seed says: off the map for some"
cp "$ROOT/surfaces/basswood.gsf" .
sed -e 's/^surface: .*/surface: {height_map: basswood.gsf, along: x, off_map: error, response: modes.csv}/' \
    -e 's/path: line, to: .*/path: scribble, center: [5 cm, 0], size: [16 cm, 2 cm], rate: 3 Hz, duration: 0.5 s}/' tiny.yaml > scribble.yaml
for seed in 1 2; do
    printf '%s\n' 'rasp-design: 1' 'base: scribble.yaml' "seed: $seed" 'replicates: 8' > set.yaml
    counts
    { rasp batch set.yaml --dry-run 2>&1 || true; } | grep -o '_r[0-9]' | tr '\n' ' '
    echo
done
echo "-- an error is measured with the noise that is there"
printf '%s\n' 'rasp: 1' 'surface: {roughness: {exponent: -2.4, rms: 5 um}, response: modes.csv}' 'scraper: {mass: 20 g}' 'grip: {angle: 30 deg, friction: 0.3}' \
    'motion: {path: back_and_forth, from: [12 cm, 0 cm], to: [14 cm, 0 cm], rate: 8 Hz, duration: 0.1 s}' 'output: {tail: 0.05 s}' > noisy.yaml
for seed in 1 2; do
    printf '%s\n' 'rasp-design: 1' 'base: noisy.yaml' "seed: $seed" 'set: {accuracy.error: -122 dB}' 'replicates: 4' > set.yaml
    counts
done
echo "-- a loudness needs 0.4 s"
for level in '{each: {lufs: -40}}' '{common: {lufs: -40}}' '{each: {rms: -40 dB}}'; do
    for length in '0.39 s' '0.4 s'; do
        printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {motion.rate: [1 Hz, 2 Hz]}' "length: $length" "level: $level" > set.yaml
        sed -i 's/path: line, to/path: back_and_forth, to/' tiny.yaml
        echo "$level $length"
        counts
    done
done
echo "-- of a common one it is enough that one has them; each by itself"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {motion.duration: [0.3 s, 0.5 s]}' 'set: {motion.rate: 2 Hz}' 'length: own' 'level: {common: {lufs: -40}}' > set.yaml
counts
sed -i 's/common/each/' set.yaml
counts
rasp check set.yaml 2>&1 || true
sed -i 's/^level.*/level: scene/; s/^set: {/set: {output.level.lufs: -40, /' set.yaml
counts
rasp check set.yaml 2>&1 || true
sed -i 's/^length: own/length: longest/' set.yaml
counts
for command in 'check' 'render -o x.wav'; do
    # shellcheck disable=SC2086
    rasp $command tiny.yaml --set output.level.lufs=-40 --set motion.rate=2 2>&1 || echo "exit $?"
done
find . -name 'x.*'

# What the sounds of a set have in common: a rate, a number of channels, under a common level a quantity; and names that other systems can hold.
. "$ROOT/tests/cli/batch-make.inc"
tell() { "$@" 2>&1 || echo "exit $?"; }
design() { printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' "$@" > set.yaml; }
echo "-- rates, channels: refused, replicates and all, before anything is rendered"
design 'factors: {output.sample_rate: [44.1 kHz, 48 kHz]}' 'replicates: 2'
tell rasp batch set.yaml -o out
design 'factors: {output.channels: [1, 2]}' 'level: scene'
tell rasp batch set.yaml -o out
tell rasp check set.yaml
ls out 2> /dev/null || true
echo "-- quantities: not under one gain; each by itself they may differ, and the table says in what each is"
sed 's/^output.*/output: {tail: 0 s, quantity: force}/' tiny.yaml > force.yaml
design 'factors: {in: [{label: velocity}, {label: force, base: force.yaml}, {label: far, set: {output.quantity: acceleration}}]}'
tell rasp batch set.yaml -o out
tell rasp batch set.yaml -o out --dry-run -q
echo 'level: {each: {peak: -6 dB}}' >> set.yaml
tell rasp batch set.yaml -o out -q
columns out/manifest.csv stimulus_id gain_per peak_dbfs error
echo "-- a table makes no sound, and is of no form"
design 'factors: {in: [{label: sound}, {label: table, set: {surface.response: null, output.sample_rate: 44.1 kHz, output.diagnostics.rate: 1 kHz}}]}'
tell rasp batch set.yaml -o tables -q
columns tables/manifest.csv file_name sample_rate_hz gain_per
echo "-- names"
for labels in 'x, X' 'con, b' 'Aux.1, b' 'lpt9, b' 'b., c' 'a, A.b' 'Manifest, b' 'manifest.1-of-2, b' 'b.WAV, c' 'con1, conn' 'com0, lpt'; do
    design "factors: {kind: [{label: ${labels%, *}}, {label: ${labels#*, }}]}"
    tell rasp check set.yaml | sed -n 1p
done
design 'factors: {kind: [{label: a, text: a thing}, {label: b}], rate: [1 Hz, 2 Hz]}' 'name: "{rate}/nul/{kind}"'
sed -i 's/rate: .1 Hz, 2 Hz./motion.duration: [0.2 s, 0.3 s]/; s/{rate}/{motion.duration}/' set.yaml
tell rasp check set.yaml
sed -i 's/nul/null/' set.yaml
tell rasp check set.yaml
rasp batch set.yaml -o named -q
python3 -c 'import json; print(json.load(open("named/manifest.json"))["kind"]["Levels"])'

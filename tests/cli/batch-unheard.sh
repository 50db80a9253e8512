# A factor that does nothing in the scenes: its stimuli have the same samples, which is told at the end, once, with its name.
. "$ROOT/tests/cli/batch-make.inc"
sed -i 's/path: line, to/path: back_and_forth, rate: 2 Hz, to/' tiny.yaml
design() { printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors:' "$@" > set.yaml; }
code() { "$@" 2>&1 | sed 's/, in [0-9:]*.*//'; }
echo "-- one that is not heard, beside one that is"
design '  load.constant: [0.3 N, 1 N, 3 N]' '  motion.rate: [1 Hz, 3 Hz]' 'replicates: 2'
code rasp batch set.yaml -o one
columns one/manifest.csv audio_sha256 | sort | uniq | wc -l
code rasp batch set.yaml -o one -q
rasp batch set.yaml -o one -q --diagnostics=json 2>&1 | python3 -c 'import json, sys; [print(d["severity"], d["file"], d["code"]) for d in map(json.loads, sys.stdin)]'
echo "-- of shards, when they are joined"
for i in 1 2; do code rasp batch set.yaml -o parts -q --shard $i/2; done
code rasp batch set.yaml -o parts -q
echo "-- two; a level of one that is"
design '  load.constant: [0.3 N, 1 N]' '  title: [x, y]'
code rasp batch set.yaml -o two
design '  kind: [{label: a}, {label: b}, {label: c, set: {scraper.mass: 30 g}}]'
code rasp batch set.yaml -o three
echo "-- all are heard; recordings do not count"
design '  scraper.mass: [10 g, 30 g]' '  motion.rate: [1 Hz, 3 Hz]' 'replicates: 2'
code rasp batch set.yaml -o four
design '  kind: [{label: made}, {label: real}]' 'cells: [{kind: made}]' 'recordings: [{file: four/10g_1Hz_r1.wav, kind: real, name: r}, {file: four/10g_1Hz_r1.wav, kind: made, name: s}]'
code rasp batch set.yaml -o five
echo "-- replicates of scenes in which nothing is random; with a factor that is not heard"
printf '%s\n' 'rasp: 1' 'surface: {response: modes.csv, material: glass}' 'scraper: {mass: 4 g, radius: 5 mm, material: steel}' 'motion: {path: still, duration: 0.1 s}' 'contact: {model: strike, strike: {speed: 1 m/s}}' \
    'output: {tail: 0.1 s}' > tiny.yaml
design '  contact.strike.speed: [1 m/s, 2 m/s]' 'replicates: 3'
code rasp batch set.yaml -o six
design '  title: [x, y]' 'replicates: 2'
code rasp batch set.yaml -o seven

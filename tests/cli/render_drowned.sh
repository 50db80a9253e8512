# Object and scraper ring alike, and their sounds are as loud as their gains: 20 dB under is 0.1 of the other. Told of either, and of a set once for all that have it.
. "$ROOT/tests/cli/batch-make.inc"
for gain in 0.11 0.09 1 1e8; do sed "s/,1,0$/,$gain,0/" modes.csv > $gain.csv; done
for side in '0.11 1' '0.09 1' '1 0.11' '1 0.09'; do
    echo "-- surface and scraper: $side"
    rasp render tiny.yaml -q -o out.wav --set scraper.response=modes.csv --set "scraper.weight=${side#* }" --set "surface.response=${side% *}.csv"
done
echo "-- damped, or heard alone: nothing to say"
rasp render tiny.yaml -q -o out.wav --set scraper.response=modes.csv --set scraper.weight=0
rasp render tiny.yaml -q -o out.wav --set scraper.response=modes.csv --set surface.response=0.09.csv --set ablation.sound=surface
echo "-- a weight that cannot be set does not help"
rasp render tiny.yaml -q -o out.wav --set scraper.response=modes.csv --set scraper.weight=0.0001 --set surface.response=1e8.csv
echo "-- a set"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'set: {scraper.response: modes.csv}' 'length: own' 'factors:' '  scraper.weight: [1, 0.05]' '  motion.duration: [0.2 s, 0.3 s]' > set.yaml
rasp batch set.yaml -o set -q

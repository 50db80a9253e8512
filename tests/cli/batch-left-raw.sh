# Another level for sounds whose raw ones an earlier run left: those count only while they are what was noted of them. Of two states of a design that were interrupted, the second one's may
# lie there under the first one's names.
. "$ROOT/tests/cli/batch-make.inc"
# design MASS LEVELS PEAK. The kind that cannot be rendered keeps a set waiting for its level: the raw sounds of the other stay, with their records.
design() {
    printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' "set: {scraper.mass: $1}" 'factors:' "  kind: [$2]" "level: {common: {peak: $3}}" > set.yaml
}
good='{label: good}, {label: fair, set: {motion.duration: 0.2 s}}' bad='{label: bad, set: {accuracy.error: -239 dB}}'
for mass in 20 30; do
    design "$mass g" "$good, $bad" '-3 dB'
    rasp batch set.yaml -o "of$mass" -q 2> told.txt || echo "of $mass g: exit $?"
    find "of$mass/.rasp/raw" -name '*.wav' | sort
done
# interrupted RAW: a set of 20 g, whole; then what runs that were interrupted left.
interrupted() {
    design '20 g' "$good" '-3 dB'
    rasp batch set.yaml -o set -q --replace
    cat of20/.rasp/journal >> set/.rasp/journal
    cp -r "$1" set/.rasp/raw
    design '20 g' "$good" '-9 dB'
    rasp batch set.yaml -o set | sed 's/, in .*//'
    rm -rf fresh
    rasp batch set.yaml -o fresh -q
    same fresh set && echo "the same as fresh"
    grep -h -o 'mass: [0-9.]*' set/*.scene.yaml
    rm -r set
}
echo "-- its own"
interrupted of20/.rasp/raw
echo "-- of another state"
interrupted of30/.rasp/raw
echo "-- of a merge"
design '20 g' "$good" '-3 dB'
rasp batch set.yaml -o set -q
cat of20/.rasp/journal >> set/.rasp/journal
cp -r of30/.rasp/raw set/.rasp/raw
design '20 g' "$good" '-9 dB'
shards() { for i in 1 2; do rasp batch set.yaml -o set -q --shard $i/2; done; }
shards
cp -r of30/.rasp/raw set/.rasp/
rasp merge set -q 2> told.txt || echo "exit $?, $(grep -c 'run its shard again' told.txt) to be rendered again"
shards
rasp merge set -q
rm -rf fresh
rasp batch set.yaml -o fresh -q
same fresh set && echo "the same as fresh"

# The level's rule edited: the folder is then what a fresh one is, whichever rule it had before, with stimuli added at the same time or not, in shards or not.
# Long: see tests/run.sh.
. "$ROOT/tests/cli/batch-make.inc"
sed -i 's/tail: 0 s/tail: 0.2 s/' tiny.yaml
# design MASSES LEVEL: one of these rules.
design() {
    printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'length: 0.8 s' 'factors:' "  scraper.mass: [$1]" '  surface.response: [modes.csv, low.csv]' "level: $2" > set.yaml
}
rules=('{common: {peak: -3 dB}}' '{common: {rms: -30 dB}}' '{common: {lufs: -45}}' '{each: {rms: -30 dB}}' '{each: {lufs: -40}}' '{common: {full_scale: 10 m/s}}')
few='40 g, 20 g' more='40 g, 20 g, 5 g'
for masses in few more; do
    for i in "${!rules[@]}"; do
        design "${!masses}" "${rules[i]}"
        rasp batch set.yaml -o "$masses$i" -q || echo "fresh $i: exit $?"
    done
done
# becomes FOLDER MASSES RULE WHAT: the folder is edited to that and rendered; is it what a fresh one is?
becomes() {
    design "${!2}" "${rules[$3]}"
    rasp batch set.yaml -o "$1" -q || echo "$4: exit $?"
    cmp "$2$3/SHA256SUMS" "$1/SHA256SUMS" && cmp "$2$3/manifest.csv" "$1/manifest.csv" || echo "$4: other bytes"
}
echo "-- from each rule to each other, and back"
for i in "${!rules[@]}"; do
    becomes walk few "$i" "to $i"
    for ((k = i + 1; k < ${#rules[@]}; k++)); do
        becomes walk few "$k" "from $i to $k"
        becomes walk few "$i" "from $k to $i"
    done
done
echo "-- with a stimulus more"
for i in "${!rules[@]}"; do
    for k in "${!rules[@]}"; do
        [ "$i" = "$k" ] && continue
        cp -r "few$i" edited
        becomes edited more "$k" "from $i to $k"
        rm -r edited
    done
done
# Where another gain was given to sounds that are no more there raw they have to be rendered again: without, they are missing.
echo "-- in shards"
shards() { for part in 1 2; do rasp batch set.yaml -o edited -q --shard $part/2 || echo "$1: exit $?"; done; }
for k in "${!rules[@]}"; do
    for i in 0 1 2 5; do
        [ "$i" = "$k" ] && continue
        cp -r "few$i" edited
        design "$few" "${rules[k]}"
        shards "from $i to $k"
        rasp batch set.yaml -o edited -q --no-render 2> told.txt || { echo "from $i to $k: exit $?, $(grep -c 'has to be rendered again' told.txt) to be rendered again" && rasp batch set.yaml -o edited -q; }
        cmp "few$k/SHA256SUMS" edited/SHA256SUMS || echo "from $i to $k: other bytes"
        rm -r edited
    done
done

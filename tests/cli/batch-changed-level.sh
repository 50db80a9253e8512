# Another level of a set renders again what has its gain already. An input that is edited meanwhile is told then, too; no stimulus gets a gain that was found with another state of it; and the
# next run leaves what a fresh folder has. What was rendered again counts as rendered.
. "$ROOT/tests/cli/batch-make.inc"
printf 'scraper: {mass: 10 g}\n' > rod.yaml
sed -i 's/^scraper: .*/include: [rod.yaml]/; s/duration: 0.3 s/duration: 2 s/' tiny.yaml
sed 's/^factors/replicates: 4\nfactors/' six.yaml > many.yaml

# batch_while COMMAND: is done when the first stimulus has the new gain.
batch_while() {
    local code=0 before
    before=$(grep -hs '"full_scale": [0-9]' set/*.json | sort | uniq -c)
    rasp batch many.yaml -o set -j 1 > log 2>&1 &
    for _ in $(seq 500); do if [ "$(grep -hs '"full_scale": [0-9]' set/*.json | sort | uniq -c)" != "$before" ]; then break; fi; sleep 0.01; done
    kill -STOP $!
    eval "$1"
    kill -CONT $!
    wait $! || code=$?
    echo "exit $code, $(grep -q ': what it is made of has changed since its level was measured' log && echo "some failed")"
    grep 'has changed while' log || echo "no file was named"
    sed -n 's/^set: \([0-9]*\) stimuli rendered, \([0-9]*\) there already, \([0-9]*\) failed.*/\1 \2 \3/p' log | awk '{ print $1 + $2 + $3, "in all;", ($3 > 0 ? "some failed" : "none failed") }'
}

as_fresh() {
    rasp batch many.yaml -o set -q
    rm -r fresh
    rasp batch many.yaml -o fresh -q && same fresh set && echo "again: the same as fresh"
}

rasp batch many.yaml -o set | sed 's/, in .*//'
cp -r set fresh
k=0
for edit in '10 g/8 g' '8 g/20 g'; do
    echo "-- $edit"
    sed -i '/^level/d' many.yaml
    k=$((k + 6))
    echo "level: {common: {peak: -$k dB}}" >> many.yaml
    batch_while "sed -i 's/$edit/' rod.yaml"
    as_fresh
done
echo "-- nothing is edited: all are rendered again, for another gain"
sed -i 's/^\(level.*\)-[0-9]* dB/\1-7 dB/' many.yaml
rasp batch many.yaml -o set | sed 's/, in .*//'
rasp batch many.yaml -o set | sed 's/, in .*//'
echo "-- more stimuli, and an edit"
sed -i 's/^replicates: 4/replicates: 5/; s/^\(level.*\)-[0-9]* dB/\1-9 dB/' many.yaml
batch_while "sed -i 's/20 g/10 g/' rod.yaml"
as_fresh

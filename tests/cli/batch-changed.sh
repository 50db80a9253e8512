# What a set is made of that changes while it is rendered is not passed over, be it a table, the base scene, a part that it includes or a recording: the run says so, and the next one renders
# what may be of the old file. The same bytes as of a fresh folder. Shards of two states, too.
# Long: see tests/run.sh.
. "$ROOT/tests/cli/batch-make.inc"
printf 'scraper: {mass: 10 g}\n' > rod.yaml
sed -i 's/^scraper: .*/include: [rod.yaml]/; s/duration: 0.3 s/duration: 2 s/' tiny.yaml
sed 's/^factors/replicates: 4\nrecordings: [{file: real.wav, name: real}]\nfactors/' six.yaml > many.yaml
rasp render tiny.yaml -o real.wav -q

# changes FOLDER COMMAND [OPTION...]: the command, while the set is rendered there.
changes() {
    local folder=$1 command=$2 code=0
    shift 2
    rasp batch many.yaml -o "$folder" -q -j 1 "$@" 2> log &
    first "$folder"
    kill -STOP $!
    eval "$command"
    kill -CONT $!
    wait $! || code=$?
    echo "exit $code: $(grep -v 'has changed while the sound was made of it' log)"
}

k=0
for command in "sed -i 's/,1000,60,1,0/,1100,60,1,0/' modes.csv" "sed -i 's/5 um/6 um/' tiny.yaml" "sed -i 's/10 g/20 g/' rod.yaml" "rasp render tiny.yaml -o real.wav --set seed=2 -q" "sed -i 's/^seed: 3/seed: 4/' many.yaml"; do
    k=$((k + 1))
    changes set$k "$command"
    rasp batch many.yaml -o set$k -q && rasp batch many.yaml -o fresh -q && same fresh set$k && echo "again: the same as fresh"
done

changes parts "sed -i 's/20 g/30 g/' rod.yaml" --shard 1/2
sed -i 's/30 g/20 g/' rod.yaml
rasp batch many.yaml -o parts -q --shard 2/2
rasp batch many.yaml -o parts -q && same fresh parts && echo "joined: the same as fresh"

# Recordings count as scenes do: what was copied from the one before is missing.
rasp render tiny.yaml -o real.wav --set seed=3 -q
rasp batch many.yaml -o parts -q --no-render 2>&1 || echo "exit $?"

# Changed for a moment, and put back: what was made of it meanwhile does not count either.
cp modes.csv good.csv
sed 's/,60,1,0/,50,1,0/' modes.csv > bad.csv
rm -r fresh
sed -i '/^accuracy/d' tiny.yaml
sed -i '/^recordings/d; s/^replicates: 4/replicates: 15\nset: {accuracy.error: -90 dB}\nlevel: {common: {full_scale: 1 m\/s}}/' many.yaml
rasp batch many.yaml -o fresh -q
rasp batch many.yaml -o back -q -j 1 2> log &
while kill -0 $! 2> /dev/null; do
    cp bad.csv other.csv && mv other.csv modes.csv
    sleep 0.02
    cp good.csv other.csv && mv other.csv modes.csv
    sleep 0.02
done
wait $! || echo "exit $?, $(grep -c 'modes.csv has changed while stimuli were made of it' log)"
rasp batch many.yaml -o back -q && same fresh back && echo "put back: the same as fresh"

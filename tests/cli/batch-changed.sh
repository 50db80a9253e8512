# What a set is made of that changes while it is rendered is not passed over, be it a table, the base scene, a part that it includes or a recording: the run says so, and the next one renders
# what may be of the old file. The same bytes as of a fresh folder. A shard of two states is none: merge misses it.
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
    for _ in $(seq 500); do if [ -s "$(ls "$folder"/.rasp/journal* 2> /dev/null)" ]; then break; fi; sleep 0.01; done
    kill -STOP $!
    eval "$command"
    kill -CONT $!
    wait $! || code=$?
    echo "exit $code: $(cat log)"
}

k=0
for command in "sed -i 's/,1000,60,1,0/,1100,60,1,0/' modes.csv" "sed -i 's/5 um/6 um/' tiny.yaml" "sed -i 's/10 g/20 g/' rod.yaml" "rasp render tiny.yaml -o real.wav --set seed=2 -q"; do
    k=$((k + 1))
    changes set$k "$command"
    rasp batch many.yaml -o set$k -q && rasp batch many.yaml -o fresh -q && same fresh set$k && echo "again: the same as fresh"
done

changes parts "sed -i 's/20 g/30 g/' rod.yaml" --shard 1/2
sed -i 's/30 g/20 g/' rod.yaml
rasp batch many.yaml -o parts -q --shard 2/2
rasp merge parts 2>&1 || echo "exit $?"
rasp batch many.yaml -o parts -q --shard 1/2
rasp merge parts -q && same fresh parts && echo "merged: the same as fresh"

# Recordings count as scenes do: shards with different ones are not of one set.
rasp render tiny.yaml -o real.wav --set seed=3 -q
rasp batch many.yaml -o parts -q --shard 2/2
rasp merge parts 2>&1 || echo "exit $?"

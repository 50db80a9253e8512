# A folder holds the set of one design: another one is refused, the same one, edited, goes on and names what is left over; nothing is removed unasked.
. "$ROOT/tests/cli/batch-make.inc"
code() { "$@" 2> err.txt > out.txt || echo "exit $?"; sed "s/, in [0-9:]*.*//" out.txt; cat err.txt; }
rasp batch six.yaml -o one -q
cp -r one before
echo "-- another design"
sed 's/seed: 3/seed: 4/' six.yaml > other.yaml
code rasp batch other.yaml -o one
code rasp batch other.yaml -o one --dry-run
code rasp batch other.yaml -o one --shard 1/2
code rasp batch six.yaml -o one --shard 1/2 --prune
diff -r before one && echo "nothing was written"
echo "-- the same one, under another name"
cp six.yaml again.yaml
code rasp batch again.yaml -o one
code rasp batch six.yaml -o one
echo "-- those that come through a pipe are not one because they are called alike; shards of one go together"
here=$PWD
piped() { sed "s|base: |&$here/|; s|low.csv|$here/&|" "$1"; }
piped six.yaml > six.abs
piped other.yaml > other.abs
code rasp batch /dev/stdin -o pipe -q < six.abs
cat other.abs | code rasp batch /dev/stdin -o pipe
code rasp batch <(cat other.abs) -o pipe -q
cat six.abs | code rasp batch /dev/stdin -o pipe
for i in 1 2; do rasp batch <(sleep 0.0$i; cat six.abs) -o piped -q --shard $i/2; done
mkdir -p deep/er
cp -r piped deep/er/piped
cp -r piped both
code rasp batch <(cat six.abs) -o piped
cp -r pipe deep/er/pipe
code rasp batch <(cat six.abs) -o deep/er/pipe
rasp check deep/er/pipe/*.scene.yaml > told.txt
(cd deep && code rasp batch <(cat ../six.abs) -o er/piped -q --shard 2/2 --force)
cp -r deep/er/piped/. both
code rasp batch <(cat six.abs) -o both
rasp batch <(cat six.abs) -o neither -q
sed -i 's/both$/neither/' both/.rasp/owner && diff -r -x timings.csv -x '*.json' both neither && rasp check both/*.scene.yaml > told.txt && echo "the same but for where they lie"
echo "-- a file is no pipe, wherever it lies"
disk=$(mktemp -d /dev/shm/rasp-test.XXXXXX 2> /dev/null) || disk=$(mktemp -d)
trap 'rm -rf "$disk"' EXIT
cp six.abs "$disk/six.yaml"
rasp batch "$disk/six.yaml" -o shm -q
sed -i 's/seed: 3/seed: 4/' "$disk/six.yaml"
code rasp batch "$disk/six.yaml" -o shm
echo "-- two at once: shards of the same state of the design get along, nobody else"
code flock -s one/.rasp/owner rasp batch six.yaml -o one
code flock -s one/.rasp/owner rasp batch six.yaml -o one -q --shard 1/2
code flock -x one/.rasp/owner rasp batch six.yaml -o one -q --shard 1/2
code flock -x one/.rasp/owner rasp batch six.yaml -o one --missing 2
cp six.yaml whole.yaml
sed -i 's/, 300 ms//' six.yaml
code flock -s one/.rasp/owner rasp batch six.yaml -o one -q --shard 1/2
code flock -s one/.rasp/owner rasp batch other.yaml -o one --replace
echo "-- a level less"
code rasp batch six.yaml -o one
code rasp batch six.yaml -o one -q
code rasp batch six.yaml -o one -q --diagnostics=json
rasp batch six.yaml -o one --json 2> /dev/null | python3 -c 'import json, sys; d = json.load(sys.stdin); print(d["left_over"], d["pruned"])'
echo "-- removed, but for what was changed since, and what the set is made from"
echo mine >> one/low_300ms.scene.yaml
echo mine > one/mine.txt
mkdir one/set
cp -r before/. one/set
code rasp batch six.yaml -o one --prune
ls -d one/*300ms* one/mine* one/set/*300ms.wav
rm -r one/set
(cd one && sha256sum --quiet -c SHA256SUMS) && echo "sums hold"
mv whole.yaml six.yaml
rasp batch six.yaml -o made -q
{ sed "s/300 ms/290 ms/" six.yaml; echo "recordings: [{file: made/low_300ms.wav, material: low, motion.duration: 290 ms, name: kept}]"; } > made.yaml
code rasp batch made.yaml -o made --replace --prune
ls made/*_300ms*
echo "-- shards: told when they are joined"
sed 's/, 300 ms//' six.yaml > fewer.yaml
rasp batch six.yaml -o parts -q
cp fewer.yaml six.yaml
for i in 1 2; do rasp batch six.yaml -o parts -q --shard $i/2; done
code rasp batch six.yaml -o parts -q
echo "-- taken over; and a manifest of which nothing says whose it is"
code rasp batch other.yaml -o parts --replace
code rasp batch six.yaml -o parts
mkdir bare
echo x > bare/manifest.csv
code rasp batch other.yaml -o bare
cat bare/manifest.csv
for file in manifest.json SHA256SUMS timings.csv; do
    mkdir own
    echo mine > own/$file
    code rasp batch six.yaml -o own -q | cut -d: -f 3-5
    ls -A own
    rm -r own
done
mkdir own
for name in $(rasp batch six.yaml -n | awk 'NR == 2 { print $2 }'); do
    for ending in wav scene.yaml json; do
        echo mine > own/$name.$ending
        code rasp batch six.yaml -o own -n -q | cut -d: -f 3-5
        code rasp batch six.yaml -o own -q --shard 1/2 | cut -d: -f 3-5
        ls -A own
        rm own/$name.$ending
    done
    rasp batch six.yaml -o own -q
    echo "-- without its owner it is nobody's"
    rm own/.rasp/owner
    code rasp batch six.yaml -o own -q | cut -d: -f 3-5
    code rasp batch six.yaml -o own --replace | sed 's/, in .*//'
done
code rasp batch other.yaml -o bare --replace

# Shards and what became of the folder and the design since; files of what a stimulus was before.
. "$ROOT/tests/cli/batch-make.inc"
shards() { for part in "$@"; do rasp batch six.yaml -o parts -q --shard "$part"; done; }
join() { rasp batch six.yaml -o parts "$@" 2>&1 | sed 's/, in [0-9:]*.*//; s/in it, .*, process [0-9]*/in it, HOST, process N/' || true; }
names() { (cd "$1" && find . -type f ! -path './.rasp/*' | sort | tr '\n' ' ') && echo; }
sed -i '/^seed/a level: {common: {peak: -6 dB}}' six.yaml
cp six.yaml six.txt
rasp batch six.yaml -o fresh -q
echo "-- an input is edited before the shards are joined, and put back"
shards 1/2 2/2
cp modes.csv good.csv
sed -i 's/,1000,60,1,0/,1100,60,1,0/' modes.csv
join --no-render
cp good.csv modes.csv
join --no-render
same fresh parts && echo "the same as fresh"
rm -r parts
echo "-- another state is at work in the folder, or has taken it"
shards 1/2 2/2
sed -i 's/seed: 3/seed: 4/' six.yaml
rm -f parts/*.json
rasp batch six.yaml -o parts -q -j 1 2> /dev/null &
disown
first parts
kill -STOP $!
join
cp six.txt six.yaml
join --shard 1/2
kill -KILL $!
while kill -0 $! 2> /dev/null; do sleep 0.01; done
shards 1/2 2/2
join --no-render
same fresh parts && echo "the same as fresh"
rm -r parts
echo "-- shards that were made in folders from which the design is seen otherwise"
shards 1/2
mkdir -p deep/er
rasp batch six.yaml -o deep/er/parts -q --shard 2/2
cp -r deep/er/parts/. parts/
join --no-render
same fresh parts && echo "the same as fresh"
rm -r parts
echo "-- the design is moved, and the set divided otherwise"
shards 1/6 2/6 3/6 4/6 5/6 6/6
mkdir moved
cp six.yaml tiny.yaml modes.csv low.csv moved
for i in 1 2; do rasp batch moved/six.yaml -o parts -q --shard $i/2; done
rasp batch moved/six.yaml -o parts --no-render | sed 's/, in .*//'
rasp batch moved/six.yaml -o elsewhere -q
same elsewhere parts && echo "the same as fresh"
echo "-- a stem and a table that are not asked for any more, and a stimulus that becomes a recording"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'set: {output.stems: [force], output.diagnostics.rate: 1 kHz}' 'factors: {kind: [{label: a}, {label: b}, {label: c, set: {motion.duration: 0.2 s}}]}' > kinds.yaml
rasp batch kinds.yaml -o kinds -q
names kinds
sed -i 's/^set.*/set: {output.stems: [force]}/' kinds.yaml
rasp batch kinds.yaml -o kinds -q 2>&1
sed -i '/^set/d' kinds.yaml
cp kinds/a.wav a.wav
printf '%s\n' 'cells: [{kind: b}, {kind: c}]' 'recordings: [{file: a.wav, kind: a, name: a}]' >> kinds.yaml
rasp batch kinds.yaml -o kinds -q 2>&1
echo >> kinds/b.csv
rasp batch kinds.yaml -o kinds -q --prune 2>&1
names kinds
rasp batch kinds.yaml -o new -q
diff -r -q -x .rasp -x timings.csv new kinds || true
echo "-- what a failed run leaves is not forgotten"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'set: {output.stems: [force]}' 'factors: {kind: [{label: a}, {label: b, set: {motion.duration: 0.2 s}}]}' > stems.yaml
rasp batch stems.yaml -o stems -q
sed -i 's/output.stems: .force./accuracy.error: -239 dB/' stems.yaml
rasp batch stems.yaml -o stems -q 2> /dev/null || echo "exit $?"
sed -i '/^set/d' stems.yaml
rasp batch stems.yaml -o stems --prune | sed 's/, in .*//'
names stems
echo "-- what fails in its shard fails in the whole"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {kind: [{label: a}, {label: b, set: {accuracy.error: -239 dB}}]}' 'level: {common: {full_scale: 1 m/s}}' > failing.yaml
for part in 1/2 2/2; do rasp batch failing.yaml -o failing -q --shard $part 2> /dev/null || echo "exit $?"; done
rasp batch failing.yaml -o failing -q --no-render 2> /dev/null || echo "exit $?"
rasp batch failing.yaml -o failing -q 2> /dev/null || echo "exit $?"

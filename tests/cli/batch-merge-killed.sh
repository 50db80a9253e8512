# A merge that is cut off at any moment goes on when it is run again; one of a set that was merged already says so, and looks at its files.
. "$ROOT/tests/cli/batch-make.inc"
merge() { rasp merge "$@" 2>&1 || echo "exit $?"; }
names() { (cd "$1" && find . -name '.rasp-*' -o -name raw); }
sed -i 's/^factors/level: {common: {peak: -6 dB}}\nreplicates: 3\nfactors/' six.yaml
rasp batch six.yaml -o ref -q
for part in 1/2 2/2; do rasp batch six.yaml -o shards -q --shard $part; done
cp -r shards whole && merge whole -q
echo "-- cut off between two stimuli: some have their level, and their raw sounds are gone"
cp -r shards half
cat whole/.rasp/journal >> half/.rasp/journal
for sound in whole/low*.wav; do
    name=$(basename "$sound" .wav)
    cp whole/"$name".* half
    rm half/.rasp/raw/"$name".*
done
merge half -q
same ref half && names half && echo "half: the same"
echo "-- cut off when all was done but taking the shards' manifests away"
cp -r whole late
cp shards/manifest.* late
cp shards/.rasp/set.json late/.rasp
merge late -q
same ref late && echo "late: the same"
cp shards/manifest.2-of-2.csv late
merge late
same ref late && echo "later: the same"
echo "-- manifests of another state are not of a set that is done"
cp shards/manifest.2-of-2.csv late
sed -i '1s/.*/# design: 0000/' late/manifest.2-of-2.csv
merge late
echo "-- killed and interrupted wherever it is"
cp -r shards killed
for t in 0.01 0.02 0.03 0.04 0.05 0.06 0.08 0.1; do
    for signal in KILL INT; do
        timeout -s $signal $t rasp merge -j 1 killed > log 2>&1 || true
    done
done 2> /dev/null
merge killed -q
same ref killed && names killed && echo "killed: the same"
echo "-- with tables and stems, which no gain changes"
mkdir long
cp ./*.csv long
sed 's/^output.*/output: {tail: 0 s, stems: [force], diagnostics: {rate: 2 kHz}}/; s/5 um/5 um, shortest: 1 mm/' tiny.yaml > long/tiny.yaml
sed 's/peak: -6 dB/rms: -50 dB/; s/replicates: 3/replicates: 1/; s/200 ms, 250 ms, 300 ms/4 s, 5 s, 6 s/' six.yaml > long/six.yaml
(cd long && rasp batch six.yaml -o ref -q && for part in 1/2 2/2; do rasp batch six.yaml -o shards -q --shard $part; done)
for t in 0.03 0.06 0.09 0.12 0.18; do
    cp -r long/shards long/killed
    timeout -s KILL $t rasp merge long/killed > log 2>&1 || true
    merge long/killed -q
    same long/ref long/killed && echo "long: the same"
    rm -r long/killed
done 2> /dev/null
echo "-- where what it is made of is not at hand: scenes name it as they would, and it is there again later"
mkdir irs
mv low.csv irs
sed -i 's/low.csv/irs\/low.csv/' six.yaml
rasp batch six.yaml -o near -q
for part in 1/2 2/2; do rasp batch six.yaml -o far -q --shard $part; done
mkdir -p elsewhere
cp -r far elsewhere
mv irs away
rasp merge far -q
(cd elsewhere && rasp merge far -q)
mv away irs
same near far && same near elsewhere/far && echo "far: the same"
rasp render far/low_200ms_r1.scene.yaml -q -o again.wav && cmp again.wav far/low_200ms_r1.wav
echo "-- two at once: the second is refused"
cp -r shards both
python3 -c '
import fcntl, subprocess
held = open("both/.rasp/merging", "w")
fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
print("exit", subprocess.run(["rasp", "merge", "both"], stderr=subprocess.STDOUT).returncode)'
merge both -q
same ref both && echo "both: the same"
echo "-- while another is at work the shards' manifests stay: it may write some"
cp -r shards both2
cp -r whole again
cp shards/manifest.* again
python3 -c '
import fcntl, os, subprocess
for folder in "both2", "again":
    held = os.open(folder + "/.rasp", os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_SH)
    print("exit", subprocess.run(["rasp", "merge", folder, "-q"], stderr=subprocess.STDOUT).returncode)'
ls both2/manifest* again/manifest*
merge both2 -q
merge again -q
same ref both2 && same ref again && echo "both: the same"
rm -r again
echo "-- one that cannot have its level: the others have it, and the same is told of it again"
mkdir loud
cp ./*.yaml ./*.csv loud
cp -r irs loud
cd loud || exit
sed -i 's/peak: -6 dB/rms: -12 dB/; s/replicates: 3/replicates: 1/' six.yaml
for part in 1/2 2/2; do rasp batch six.yaml -o parts -q --shard $part; done
merge parts -q | sed 's/frame .*/.../'
merge parts -q | sed 's/frame .*/.../'
columns parts/manifest.csv stimulus_id status
rasp batch six.yaml -o parts 2> told.txt | sed 's/, in .*//' || true
sed 's/frame .*/.../' told.txt
cd .. || exit
echo "-- once more"
merge whole
merge whole -q
merge whole --json
same ref whole && echo "whole: the same"
rm whole/low_200ms_r1.wav
echo >> whole/low_250ms_r2.scene.yaml
merge whole
merge whole --json 2> /dev/null
rm -r whole
cp -r ref whole
head -n 2 ref/manifest.csv > whole/manifest.csv
merge whole
cp ref/manifest.csv whole
rm whole/manifest.json
merge whole
rm whole/SHA256SUMS
merge whole
rm -r whole
cp -r ref whole
rm -r whole/.rasp
merge whole | tail -n 2
mkdir none
merge none

# What is read of a folder of responses is its index.csv and what that names, wherever within it; all of that is an input: it is pinned, is not written over, not removed, and seen when it changes.
. "$ROOT/tests/cli/batch-make.inc"
mkdir -p irs/sub
rasp render tiny.yaml -q -o irs/p1.wav --set motion.duration='0.1 s'
rasp render tiny.yaml -q -o irs/sub/p2.dat.wav --set motion.duration='0.1 s' --set seed=2
mv irs/sub/p2.dat.wav irs/sub/p2.dat
rm irs/*.json irs/*.yaml irs/sub/*.json irs/sub/*.yaml
printf '%s\n' file_name,x_m,y_m p1.wav,0,0 sub/p2.dat,0.03,0 > irs/index.csv
cp irs/p1.wav irs/unnamed.wav
sed -i 's/response: modes.csv/response: irs/' tiny.yaml
tell() { "$@" 2>&1 || echo "exit $?"; }
echo "-- pinned"
rasp render tiny.yaml -q -o one.wav
grep 'file:' one.scene.yaml
echo "-- seen when it changes"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {scraper.mass: [10 g, 20 g]}' > set.yaml
rasp batch set.yaml -o set | sed 's/, in .*//'
cp irs/p1.wav irs/sub/p2.dat
rasp batch set.yaml -o set | sed 's/, in .*//'
echo "-- not written over"
find irs -type f | sort | xargs sha256sum > sums
cp tiny.yaml p1.yaml
tell rasp render p1.yaml -o irs/
sed 's/^factors.*/factors: {kind: [{label: p1}, {label: q}]}/' set.yaml > over.yaml
tell rasp batch over.yaml -o irs -q
sha256sum -c --quiet sums
echo "-- beside outputs"
sed 's/response: irs/response: ./; s/file: irs/file: ./' tiny.yaml > irs/here.yaml
rasp render irs/here.yaml -q -o irs/
rasp render irs/here.yaml -q -o irs/
rasp render irs/here.scene.yaml -q -o again.wav
cmp irs/here.wav again.wav
sed 's/tiny.yaml/irs\/here.yaml/' set.yaml > beside.yaml
for _ in 1 2; do rasp batch beside.yaml -o irs | sed 's/, in .*//'; done
rm irs/10g.wav
rasp batch beside.yaml -o irs | sed 's/, in .*//'
echo "-- not removed"
printf '%s\n' 'rasp-design: 1' 'base: one.yaml' 'factors: {motion.duration: [0.1 s, 0.2 s]}' 'name: "irs/{motion.duration}"' > made.yaml
sed 's/response: irs/response: modes.csv/' tiny.yaml > one.yaml
rasp batch made.yaml -o made -q
printf '%s\n' file_name,x_m,y_m 0.1s.wav,0,0 0.2s.wav,0.03,0 > made/irs/index.csv
sed -i 's/^name.*/name: "x\/{motion.duration}"\nset: {surface.response: made\/irs}/' made.yaml
rasp batch made.yaml -o made --prune | sed 's/, in .*//'
find made/irs -type f | sort

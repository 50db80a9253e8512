# What is kept, what is missing, what is off and by how much, what is stray; files, hashes, both.
. "$ROOT/tests/cli/golden-make.inc"
cat > list.txt << 'END'
# name      options

stroke.yaml                                          # exact
forces.yaml --rel 1e-6 --abs 1e-9
  "stroke.yaml" --name slow --set 'motion.speed=10 cm/s' --lsb 1
END
echo "-- nothing is kept yet"
try rasp golden check list.txt
echo "-- kept"
try rasp golden update list.txt --hashes golden.sha256 --kept golden
find golden -type f | sort
(cd golden && sha256sum --quiet -c ../golden.sha256)
try rasp golden check list.txt --effective -j 1
try rasp golden check list.txt --kept golden/ --hashes golden.sha256 -q
try rasp golden update list.txt
echo "-- other bytes, some of them within the tolerances"
flip golden/stroke/sound.wav 301
flip golden/slow/sound.wav 300
sed -i '9s/,/,1/8' golden/forces/sound.csv
try rasp golden check list.txt
try rasp golden check stroke.yaml --lsb 300
try rasp golden check stroke.yaml --snr 200
try rasp golden check list.txt --kept golden --hashes golden.sha256 -q -o new
ls new new/*
echo "-- the samples are the same, the bytes are not"
rasp golden update -q list.txt
printf 'junk\004\000\000\000more' >> golden/stroke/sound.wav
try rasp golden check stroke.yaml
echo "-- too much and too little"
rasp golden update -q list.txt
mkdir golden/old
echo a > golden/old/sound.csv
echo a > golden/stray.wav
echo a > golden/README.md
try rasp golden check list.txt
try rasp golden check stroke.yaml
echo a > golden/stroke/more.csv
rm golden/stroke/sound.csv
try rasp golden check stroke.yaml forces.yaml
try rasp golden update list.txt
rm -r golden/old golden/stray.wav
try rasp golden check list.txt
echo "-- hashes alone"
try rasp golden update stroke.yaml forces.yaml --hashes only.sha256
try rasp golden check stroke.yaml --hashes only.sha256
try rasp golden check stroke.yaml --hashes only.sha256 --abs 1
sed -i 's/^./0/' only.sha256
sed -i 's/speed: 20/speed: 21/' stroke.yaml
try rasp golden check stroke.yaml --hashes only.sha256 -q
try rasp golden update stroke.yaml --hashes only.sha256
echo forces.yaml > short.txt
try rasp golden check short.txt --hashes only.sha256
try rasp golden update short.txt --hashes only.sha256
try cat only.sha256
echo "-- a scene that cannot be read, or rendered; the others are checked"
echo 'rasp: 2' > bad.yaml
sed 's/modes.csv/gone.csv/' stroke.yaml > gone.yaml
printf 'bad.yaml\ngone.yaml\nforces.yaml\n' > bad.txt
try rasp golden check bad.txt --tap
try rasp golden update gone.yaml --kept none
ls -d none 2> /dev/null || echo "nothing was written"
echo "-- tables as NPY"
sed 's/rate: 1 kHz/rate: 1 kHz, format: npy/' forces.yaml > arrays.yaml
export TMPDIR=$PWD/scratch
mkdir scratch
try rasp golden update arrays.yaml --kept arrays
try rasp golden check arrays.yaml --kept arrays --effective
flip arrays/arrays/sound.npy 1003
try rasp golden check arrays.yaml --kept arrays
touch arrays/stray.npy
echo arrays.yaml > arrays.txt
try rasp golden check arrays.txt --kept arrays -q
ls -A scratch

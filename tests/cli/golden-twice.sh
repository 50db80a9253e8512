# What has not the same bytes twice is not kept: here a file that the scene reads changes between its two renders. The list's second scene is long, so that there is time.
. "$ROOT/tests/cli/golden-make.inc"
sed 's/tail: 20 ms/tail: 1 s/; s/1 cm, 0 cm/60 cm, 0 cm/; s/8 kHz/48 kHz/' stroke.yaml > long.yaml
sed 's/modes.csv/other.csv/' stroke.yaml > first.yaml
cp modes.csv other.csv
printf 'first.yaml\nlong.yaml\n' > list.txt
mkdir temporary
TMPDIR=$PWD/temporary rasp golden update list.txt -j 1 > out 2> err &
for _ in $(seq 3000); do
    if [ -e "$(echo temporary/rasp-golden-*/first/first/sound.wav)" ]; then
        sed 's/,1000,/,2000,/' modes.csv > new.csv
        mv new.csv other.csv
        break
    fi
    sleep 0.01
done
wait $! || echo "exit code $?"
sed 's|rasp-golden-[0-9A-Za-z]*|rasp-golden-...|; 4q' out
cat err
ls -d golden 2> /dev/null || echo "nothing was written"
ls temporary
echo "-- the same scene, left alone"
rasp golden update list.txt
rasp golden check list.txt

echo "-- stopped"
TMPDIR=$PWD/temporary rasp golden check list.txt --tap -j 1 > out 2> err &
pid=$!
for _ in $(seq 3000); do
    [ ! -e "$(echo temporary/rasp-golden-*/long)" ] || break
    sleep 0.01
done
kill -INT $pid
wait $pid || echo "exit code $?"
cat out err
ls temporary

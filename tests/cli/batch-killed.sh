# Killed at any moment, interrupted, twice at once in one folder: run again, it goes on, and the bytes are those of a batch that nothing happened to.
. "$ROOT/tests/cli/batch-make.inc"
sed 's/^factors/replicates: 3\nfactors/' six.yaml > many.yaml
rasp batch many.yaml -o ref -q
for t in 0.05 0.1 0.2 0.3 0.4 0.15 0.25; do
    timeout -s KILL $t rasp batch many.yaml -o killed -q -j 2 > log 2>&1 || true
done 2> /dev/null
rasp batch many.yaml -o killed -q -j 2 && same ref killed && echo "killed: the same"
find killed -name '.rasp-*' -o -name raw
echo "-- a record that was cut off, one that was edited, one of zeros; a hidden name of a program that is gone"
cp -r ref torn
sh -c 'echo $$' > pid
echo piece > "torn/.rasp-$(cat pid)-0.part"
head -c 100 ref/low_200ms_r1.json > torn/low_200ms_r1.json
sed -i 's/"frames": 14401/"frames": 14402/' torn/low_200ms_r2.json
head -c "$(stat -c %s ref/low_200ms_r3.json)" /dev/zero > torn/low_200ms_r3.json
rasp batch many.yaml -o torn | sed 's/, in .*//' && same ref torn && echo "torn: the same"
echo "-- interrupted"
for signal in INT TERM; do
    rasp batch many.yaml -o $signal -q -j 1 2> log &
    first $signal
    kill -$signal $!
    code=0
    wait $! || code=$?
    echo "exit $code $(sed 's/after [0-9]*/after N/' log)"
    find $signal -maxdepth 1 -name '*manifest*' -o -name SHA256SUMS
    rasp batch many.yaml -o $signal -q && same ref $signal
done
echo "-- two at once"
rasp batch many.yaml -o both -q -j 1 &
first both
rasp batch many.yaml -o both -q -j 1 2>&1 | sed 's/in it, .*, process [0-9]*/in it, HOST, process N/' || true
wait $! && same ref both && echo "both: the same"

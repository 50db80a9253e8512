# Killed at any moment, interrupted, twice at once in one folder: run again, it goes on, and the bytes are those of a batch that nothing happened to.
. "$ROOT/tests/cli/batch-make.inc"
sed 's/^factors/replicates: 3\nfactors/' six.yaml > many.yaml
rasp batch many.yaml -o ref -q
for t in 0.05 0.1 0.2 0.3 0.4 0.15 0.25; do
    timeout -s KILL $t rasp batch many.yaml -o killed -q -j 2 > log 2>&1 || true
done 2> /dev/null
rasp batch many.yaml -o killed -q -j 2 && same ref killed && echo "killed: the same"
find killed -name '.rasp-*' -o -name raw
echo "-- a piece of a line in the journal, and a hidden name of a program that is gone"
mkdir -p torn/.rasp
sh -c 'echo $$' > pid
head -c 100 ref/.rasp/journal > torn/.rasp/journal
echo piece > "torn/.rasp-$(cat pid)-0.part"
rasp batch many.yaml -o torn -q && same ref torn && echo "torn: the same"
echo "-- interrupted"
for signal in INT TERM; do
    rasp batch many.yaml -o $signal -q -j 1 2> log &
    for k in $(seq 500); do if [ -s $signal/.rasp/journal ]; then break; fi; sleep 0.01; done
    kill -$signal $!
    code=0
    wait $! || code=$?
    echo "exit $code $(sed 's/after [0-9]*/after N/' log)"
    ls $signal
    rasp batch many.yaml -o $signal -q && same ref $signal
done
echo "-- two at once"
rasp batch many.yaml -o both -q -j 1 & rasp batch many.yaml -o both -q -j 1
wait $! && same ref both && echo "both: the same"

# An input that changes while a set is rendered is not passed over: the run says so, and the next one renders what may be of the old file. The same bytes as of a fresh folder.
. "$ROOT/tests/cli/batch-make.inc"
sed 's/^factors/replicates: 20\nfactors/; s/duration: 0.3 s/duration: 2 s/' six.yaml > many.yaml
rasp batch many.yaml -o set -q -j 1 2> log &
for k in $(seq 500); do if [ -s set/.rasp/journal ]; then break; fi; sleep 0.01; done
kill -STOP $!
sed -i 's/,1000,60,1,0/,1100,60,1,0/' modes.csv
kill -CONT $!
code=0
wait $! || code=$?
echo "exit $code: $(cat log)"
rasp batch many.yaml -o set -q && rasp batch many.yaml -o fresh -q && same fresh set && echo "again: the same as fresh"

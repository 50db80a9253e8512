# Several scenes at once: the same files, reported in order; --keep-going renders the others where some fail, and says how many did.
try() { local code=0; "$@" || code=$?; echo "$code"; }
for kind in scrape stroke strike grip; do rasp new $kind -o $kind.yaml; done
rasp render -q scrape.yaml stroke.yaml strike.yaml grip.yaml -o one/
rasp render -j 3 scrape.yaml stroke.yaml strike.yaml grip.yaml -o three/ | sed 's/, .*//'
for f in one/*; do case $f in *.json) ;; *) cmp "$f" "three/${f#one/}" ;; esac; done
echo "-- JSON, in order"
rasp render -j 3 --json scrape.yaml stroke.yaml grip.yaml -o three/ | python3 -c 'import json, sys; print([s["scene"].split("/")[-1] for s in json.load(sys.stdin)])'
echo "-- some fail: while they are read, and while they are rendered"
sed 's/20 g/20 xx/' scrape.yaml > unread.yaml
sed 's/^output:/output:\n  level: {full_scale: 1e-9 m\/s}/' scrape.yaml > loud.yaml
for jobs in 1 3; do
    rm -rf some && try rasp render -j $jobs -k -q unread.yaml stroke.yaml loud.yaml strike.yaml -o some/ 2> err
    sed 's/frame .*/.../' err
    echo some/*.wav
done
rm -rf some && try rasp render -j 3 -q stroke.yaml unread.yaml -o some/
[ ! -e some ] && echo nothing
rm -rf some && try rasp render -q stroke.yaml loud.yaml strike.yaml -o some/ 2> err
echo some/*.wav
try rasp render -k -j 2 unread.yaml loud.yaml --json -o some/ 2> err | python3 -c 'import json, sys; print(sys.stdin.read())'

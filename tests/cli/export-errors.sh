# What cannot be exported is refused with what to do, and leaves nothing behind; what is there is replaced only where an export left it.
# shellcheck disable=SC1091
. "$ROOT/tests/cli/export-make.inc"
tell() {
    local code=0
    echo "--- $*" >&2
    rasp export "$@" || code=$?
    [ $code = 0 ] || echo "exit code $code" >&2
}
ls -A | sort > before
tell choose.yaml set_choose -o out
tell choose.yaml set_choose --for jspsich -o out
tell choose.yaml set_choose --for page
tell choose.yaml set_choose --for page -o out --participants 0
tell choose.yaml set_choose --for page -o out --seed -1
tell choose.yaml set_choose --for page -o out --name 'a b'
for splits in train '{train: 0}' '{Train: 1}' '{train: x}' '{}' '{test: 1}'; do
    (cat choose.yaml && echo "splits: $splits") > split.yaml
    tell split.yaml set_choose --for audiofolder -o out
done
tell choose.yaml set_choose --for page -o gone/out
tell choose.yaml set_choose --for page -o choose.yaml
tell gone.yaml set_choose --for page -o out
tell choose.yaml gone --for page -o out
tell choose.yaml set_rate --for page -o out
sed 's/10 cm\/s, set/9 cm\/s, set/; s/label: slow/label: slower/' rate.yaml > slower.yaml
tell slower.yaml set_rate --for page -o out
sed '/^trials/d' choose.yaml > bare.yaml
tell bare.yaml set_choose --for page -o out
sed 's/Which material, please?/[1, 2]/; s/question: "\(.*\)"/question: "\1"/' choose.yaml > brackets.yaml
tell brackets.yaml set_choose --for psychopy -o out
tell compare.yaml set_compare --for webmushra -o out
sed 's/within: step/withn: step/' compare.yaml > typo.yaml
tell typo.yaml set_compare --for page -o out
render() { rasp batch -q "$1.yaml" -o "set_$1" 2> /dev/null; }
(cat rate.yaml && echo 'length: own') | sed 's/\(label: light, set: {\)/\1output.tail: 50 ms, /' > lengths.yaml
(cat choose.yaml && echo 'name: "{order}"') > numbers.yaml
(cat compare.yaml && echo 'set: {output.encoding: float64}') > doubles.yaml
for design in lengths numbers doubles; do render $design; done
tell lengths.yaml set_lengths --for webmushra -o out
tell numbers.yaml set_numbers --for psychopy -o out
tell doubles.yaml set_doubles --for page -o out
sed '/^factors/,/^trials/{s/label: wood/label: "TRUE"/; s/material: wood/material: "TRUE"/}' choose.yaml > truth.yaml
render truth
tell truth.yaml set_truth --for bids -o out
sed -i 's/,ok,/,failed,/' set_truth/manifest.csv
tell truth.yaml set_truth --for bids -o out
printf x >> set_compare/weight_s2.wav
tell compare.yaml set_compare --for page -o out
mkdir out && tell compare.yaml set_compare --for page -o out && rmdir out # an empty folder stays
echo "--- nothing is left of any" >&2
ls -A | sort | comm -13 before - | grep -v '\.yaml$\|^set_\|^before$' || true
echo "--- what is there" >&2
mkdir out
tell choose.yaml set_choose --for page -o out
tell rate.yaml set_rate --for page -o out
cp -r out kept
echo mine > out/answers_p1.csv
tell choose.yaml set_choose --for page -o out
rm out/answers_p1.csv
echo mine >> out/study.js
tell choose.yaml set_choose --for page -o out
mv kept/index.html away && ln -s ../away kept/index.html
tell choose.yaml set_choose --for page -o kept
ls out
# a column that the manifest's side-car does not describe
sed -i '/"Description": "seed of/d; s/"Noise seed",/"Noise seed"/' set_rate/manifest.json
rasp export rate.yaml set_rate --for page -o bare && grep -A 3 '"seed"' bare/sounds/stimuli.json

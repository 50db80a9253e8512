# What goes wrong with a set: all of it is told before the first render, once; a stimulus that fails stops no other; exit codes; merging what does not belong together.
. "$ROOT/tests/cli/batch-make.inc"
code() { "$@" 2> err.txt > out.txt || echo "exit $?"; sed "s/, in [0-9:]*.*//" out.txt; cat err.txt; }
echo "-- usage"
code rasp batch six.yaml
code rasp batch six.yaml -o out --shard 4/3
code rasp batch six.yaml -o out --jobs 0
echo "-- nothing is written when something cannot be rendered"
sed 's/low.csv/missing.csv/' six.yaml > missing.yaml
code rasp batch missing.yaml -o out
[ ! -e out ] && echo "no folder"
sed 's/300 ms/300 mm/' six.yaml > wrong.yaml
code rasp batch wrong.yaml -o out
echo "-- folders"
code rasp batch six.yaml -o nowhere/out
code rasp batch six.yaml -o tiny.yaml
echo "-- one that clips: the others are there"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'level: scene' 'set: {output.level.full_scale: 1}' 'factors:' \
    '  loud: [{label: no}, {label: yes, set: {output.level.full_scale: 1e-9}}]' > clips.yaml
code rasp batch clips.yaml -o clips | sed 's/frame.*/.../'
columns clips/manifest.csv stimulus_id status error_code
(cd clips && sha256sum --quiet -c SHA256SUMS && ls)
echo "-- one that failed, or waits for its level, and was there before: what is left of that is told, and can be removed"
sed 's/1e-9/1/' clips.yaml > state.yaml
rasp batch state.yaml -o state -q
cp state.yaml whole.yaml
cp clips.yaml state.yaml
code rasp batch state.yaml -o state | sed 's/frame [^ ]*.*/.../'
rasp batch state.yaml -o state --json 2> /dev/null | python3 -c 'import json, sys; print(json.load(sys.stdin)["left_over"])' || true
code rasp batch state.yaml -o state --prune -q | sed 's/frame [^ ]*.*/.../'
ls state
cp whole.yaml state.yaml
code rasp batch state.yaml -o state
cp clips.yaml state.yaml
for i in 1 2; do code rasp batch state.yaml -o state --shard $i/2 -q | sed 's/frame [^ ]*.*/.../'; done
code rasp batch state.yaml -o state --prune | sed 's/frame [^ ]*.*/.../'
ls state
echo "-- the design's level is told where it stands, not where the base has another"
sed 's/tail: 0 s/tail: 0 s, level: {peak: -3 dB}/' tiny.yaml > peak.yaml
printf '%s\n' 'rasp-design: 1' 'base: peak.yaml' 'level: {common: {full_scale: 1e-9}}' > laid.yaml
code rasp batch laid.yaml -o laid | sed 's/frame.*/.../'
echo "-- no input is overwritten, by a dry run either"
python3 -c '
import math, struct, wave
for name, f in (("rec", 8000), ("tap", 8000), ("still", 0)):
    with wave.open(name + ".wav", "wb") as w:
        w.setnchannels(1), w.setsampwidth(2), w.setframerate(48000)
        w.writeframes(b"".join(struct.pack("<h", int(f * math.exp(-0.002 * i) * math.sin(0.1 * i))) for i in range(14400)))'
mkdir put
cp tiny.yaml put/mine.scene.yaml
cp modes.csv put
ln rec.wav put/one.wav
ln -s ../tap.wav put/soft.wav
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {kind: [{label: made}, {label: real}]}' 'cells: [{kind: made}]' 'recordings: [{file: rec.wav, kind: real, name: rec}]' > put/SHA256SUMS
sed 's/base: /&..\//; s/file: /&..\//; s/name: rec/name: one/' put/SHA256SUMS > put/link.yaml
cp put/SHA256SUMS rec.yaml
sed 's/base: /&..\//; s/file: /&..\//' rec.yaml > put/SHA256SUMS
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'set: {surface.response: tap.wav}' 'name: tap' > tap.yaml
sed 's/name: tap/name: soft/' tap.yaml > soft.yaml
printf '%s\n' 'rasp-design: 1' 'base: put/mine.scene.yaml' 'name: mine' > mine.yaml
touch inputs.txt
ls -AR > before.txt
find . -type f ! -name '*.txt' -exec sha256sum {} + > inputs.txt
for how in "" --dry-run; do
    code rasp batch rec.yaml -o . $how
    code rasp batch tap.yaml -o "$PWD" $how | sed "s|$PWD|HERE|"
    code rasp batch mine.yaml -o put $how
    code rasp batch put/link.yaml -o put $how
    code rasp batch soft.yaml -o put $how
    code rasp batch put/SHA256SUMS -o put $how
done
sha256sum --quiet -c inputs.txt && ls -AR | diff before.txt - && echo "nothing was written"
rasp batch rec.yaml -o put/out -q
code rasp batch rec.yaml -o put/out
sed 's/rec.wav/put\/out\/rec.wav/' rec.yaml > own.yaml
code rasp batch own.yaml -o put/out
cp put/out/rec.wav put/out/.rasp/rec.wav
sed 's/rec.wav/put\/out\/.rasp\/rec.wav/' rec.yaml > hidden.yaml
code rasp batch hidden.yaml -o put/out
echo "-- recordings that are cut off, or silent"
head -c 20000 rec.wav > cut.wav
sed 's/rec.wav/cut.wav/' rec.yaml > cut.yaml
code rasp batch cut.yaml -o cut
code rasp check cut.yaml
sed 's/rec.wav/still.wav/' rec.yaml > still.yaml
code rasp batch still.yaml -o still | sed 's/; full_scale.*//'
echo 'level: {each: {rms: -30}}' >> still.yaml
code rasp batch still.yaml -o silent
columns silent/manifest.csv stimulus_id status
code rasp batch still.yaml -o silent -q --force --diagnostics=json
sed 's/level:.*/level: {each: {lufs: -30}}/; s/base: tiny.yaml/&\nset: {surface.response: zero.csv, output.tail: 0.2 s}/' still.yaml > none.yaml
sed 's/,60,1,0/,60,0,0/' modes.csv > zero.csv
code rasp batch none.yaml -o none
sed 's/still.wav/gone.wav/' still.yaml > gone.yaml
code rasp batch gone.yaml -o gone --diagnostics=json
code rasp check gone.yaml
echo "-- a common level waits for what fails"
printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'level: {common: {lufs: -23}}' > short.yaml
code rasp batch short.yaml -o short
echo "-- a disk that is full"
(ulimit -f 8; code rasp batch six.yaml -o full -j 1) | sed 's/full.*written/.../'
rasp batch six.yaml -o full -q && (cd full && sha256sum --quiet -c SHA256SUMS && echo "resumed")
echo "-- joining shards"
code rasp merge full
code rasp merge
for i in 1 4; do rasp batch six.yaml -o parts --shard $i/5 -q; done
code rasp batch six.yaml -o parts --missing 5
code rasp batch six.yaml -o parts --no-render
code rasp batch six.yaml -o parts --no-render --shard 1/5
code rasp batch six.yaml -o parts --missing 0
for i in 2 3 5; do rasp batch six.yaml -o parts --shard $i/5 -q; done
code rasp batch six.yaml -o parts --missing 5
cp -r parts lost
rm lost/.rasp/raw/low_250ms.wav
echo x >> lost/.rasp/raw/low_200ms.wav
code rasp batch six.yaml -o lost --no-render
cp -r parts mixed
cp six.yaml six.txt
sed -i 's/seed: 3/seed: 4/' six.yaml
rasp batch six.yaml -o mixed --shard 2/5 -q
cp six.txt six.yaml
code rasp batch six.yaml -o mixed --no-render | sed 's/: [a-z_0-9]*ms/: NAME/'
cp -r parts built
sed -i 's/"program": "rasp/"program": "raps/' built/*.json
code rasp batch six.yaml -o built --no-render -q
rm -r parts/.rasp/owner
code rasp batch six.yaml -o parts --no-render -q
code rasp batch six.yaml -o parts --no-render --replace
same full parts && echo "the same as in one piece"
echo "-- files are named as they are, and a manifest does not say in which folder it was made"
mkdir layout
sed 's|: modes.csv|: ../modes.csv|' tiny.yaml > layout/b.yaml
printf '%s\n' 'rasp-design: 1' 'base: b.yaml' 'set: {motion.path: back_and_forth}' 'factors: {motion.rate: [4 Hz, 8 Hz]}' 'level: {common: {full_scale: 1e-9 m/s}}' > layout/d.yaml
code rasp batch layout/d.yaml -o out -q | sed 's/frame .*/.../'
columns out/manifest.csv error | sed 's/frame .*/.../'
(cd layout && code rasp batch ../layout/d.yaml -o . -q | sed 's/frame .*/.../' | head -n 1)
sed -i 's/full_scale: .*/rms: -1 dB}}/' layout/d.yaml
for folder in q1 q22; do code rasp batch layout/d.yaml -o $folder -q | sed 's/frame .*/.../'; done
for i in 1 2; do rasp batch layout/d.yaml -o parts3 -q --shard $i/2; done
code rasp batch layout/d.yaml -o parts3 -q | sed 's/frame .*/.../'
cmp q1/manifest.csv q22/manifest.csv
cmp q1/manifest.csv parts3/manifest.csv

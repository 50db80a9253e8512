# What accuracy.error refuses, with what words, where and with which exit code.
try() { "$@" || echo "exit code $?" >&2; }
cat > scene.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], duration: 0.1 s}
output: {quantity: force}
accuracy:
  error: -200 dB
YAML
. "$ROOT/tests/cli/accuracy-make.inc"
echo 'accuracy: {error: -60 dB}' >> drop.yaml
try rasp render scene.yaml 2> words
sed 's/than -[0-9.]* dB is promised; the best that can be promised here is -[0-9]* dB/than X dB is promised; the best Y dB/' words >&2
try rasp check scene.yaml --set accuracy.error=-80 --set accuracy.oversampling=1 2> words
sed 's/leaves -[0-9.]* dB/leaves X dB/; s/for -[0-9]* dB/for Y dB/' words >&2
try rasp check drop.yaml 2> words
sed 's/ [0-9]* times in/ N times in/' words >&2
try rasp check scene.yaml --set accuracy.error=3
try rasp check scene.yaml --set accuracy=-60
# A length for the smoothing has a key of its own.
try rasp check scene.yaml --set 'contact.smoothing=0.1 mm'
ls
# What is named as the best is so whatever was asked, and can be had, where ramps of gains leave a small error of their own, too.
for asked in -145 -150 -200; do
    best=$(rasp check "$ROOT/scenes/bounce.yaml" --set accuracy.error=$asked 2>&1 | grep -o 'promised here is -[0-9]*' || true)
    best=${best##* }
    rasp check "$ROOT/scenes/bounce.yaml" --set accuracy.error="$best" > /dev/null 2>&1 && echo "$best can be had" || echo "$best is refused"
done | uniq -c | sed 's/-[0-9]*/X/'

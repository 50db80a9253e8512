# --diagnostics=json: one object a line on stderr, the same errors as in text; of the text of a scene, of what it names, of included files, of options; warnings.
rasp new -o good.yaml
sed 's/rms: 4 um/rms: 4 g/; s/rate: 2 Hz/raet: 2 Hz/' good.yaml > bad.yaml
tell() {
    local code=0
    echo "== $*"
    rasp "$@" 2> err || code=$?
    python3 -c '
import json, sys
for line in open("err"):
    o = json.loads(line)
    print(o.pop("severity"), o.pop("file"), o.pop("line"), o.pop("column"), o.pop("width"), o.pop("code"), "|", o.pop("message"), "|", o.pop("help"), o or "")'
    echo "exit code $code"
}
tell check --diagnostics=json bad.yaml good.yaml missing.yaml
tell plan --diagnostics=json bad.yaml
tell render --diagnostics=json bad.yaml
tell explain --diagnostics json bad.yaml
tell check --diagnostics=json --set motion.rate='3 m' good.yaml

# found when the files are opened: at the place that names them
cat > a.yaml <<'X'
rasp: 1
surface:
  response: no.csv
motion: {path: line, from: [0, 0], to: [10 cm, 0], duration: 0.1 s}
scraper: {mass: 10 g}
contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}
X
tell check --diagnostics=json a.yaml
tell render --diagnostics=json a.yaml
tell check --diagnostics=json --set surface.response=none.csv a.yaml
printf 'surface: {roughness: {rms: 4 g}}\n' > part.yaml
printf 'rasp: 1\ninclude: [part.yaml]\nscraper: {mass: 10 g}\nmotion: {path: line, to: [10 cm, 0], duration: 0.1 s}\n' > c.yaml
tell check --diagnostics=json c.yaml
tell render --diagnostics=json good.yaml -o no/such/folder/
tell render --quiet --diagnostics=json "$ROOT/scenes/basswood_scrape.yaml" --set 'output.sample_rate=16 kHz' --set 'motion.duration=0.1 s'

# the same as text, the default, and what is wrong with the command line itself
cd .
rasp check bad.yaml 2> as_text || true
rasp check --diagnostics=text bad.yaml 2> text || true
cmp text as_text
rasp check --diagnostics=xml good.yaml || echo $?

# check --json: the same objects on stdout
rasp check --json good.yaml bad.yaml 2> text > rows || echo $?
cmp text as_text
python3 -c 'import json; print([(o["file"], o["ok"], o["code"], [(e["line"], e["column"], e["message"]) for e in o["errors"]]) for o in json.load(open("rows"))])'

# every command, and every action of one, has it
for command in $(rasp help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
    rasp "$command" --help 2> no_command | grep diagnostics=text > /dev/null || echo "$command has no --diagnostics"
done
tell golden check --diagnostics=json good.yaml --kept no
tell compare --diagnostics=json no.wav no.wav
tell analyse --diagnostics=json no.csv
tell accuracy --diagnostics=json bad.yaml
tell new --diagnostics=json -o no/new.yaml
tell plot --diagnostics=json no.csv
tell surface info --diagnostics=json no.gsf
tell surface convert --diagnostics=json no.gsf x.gsf
printf 'roughness: {rms: 4 g}\n' > recipe.yaml
tell surface synth --diagnostics=json recipe.yaml x.gsf --size 1mmx1mm --pitch 5um
tell modes list --diagnostics=json no.csv
tell modes compute --diagnostics=json no.msh --material steel -o x.csv
tell modes extract --diagnostics=json no.wav -o x.csv
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
rasp render -q good.yaml -o good.wav --set surface.response=modes.csv --set 'output.diagnostics.rate=100 Hz' --set 'motion.duration=0.1 s'
sed -i 's/"sha256": "/&0/' good.json
tell plot --diagnostics=json good.wav

# of a stimulus: where the design says what it failed of; of a shard, too
printf '%s\n' 'rasp-design: 1' 'base: good.yaml' 'level: scene' 'set: {surface.response: modes.csv, motion.duration: 0.1 s}' 'factors:' '  loud: [{label: no}, {label: yes, set: {output.level.full_scale: 1e-9}}]' > design.yaml
tell batch --diagnostics=json design.yaml -o set -q
tell batch --diagnostics=json design.yaml -o parts --shard 1/1 -q
for i in 1 2; do rasp batch design.yaml -o shards --shard $i/2 -q 2> failed || true; done
tell merge --diagnostics=json shards -q
tell batch --diagnostics=json bad.yaml -o bad

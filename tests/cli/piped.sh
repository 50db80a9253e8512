# A scene, design or recipe may come through a pipe, to whatever command reads one; file names in it start at the working folder. A signal ends the waiting.
mkdir sub
cat > sub/a.yaml << 'YAML'
rasp: 1
surface: {roughness: {rms: 3 um}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 50 ms}
YAML
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
sed 's/modes.csv/..\/modes.csv/' sub/a.yaml > sub/file.yaml
printf '%s\n' 'rasp-design: 1' 'base: sub/file.yaml' 'factors: {motion.speed: [10 cm/s, 20 cm/s]}' > set.yaml
printf '%s\n' 'material: steel' 'object: {shape: bar, length: 10 cm, width: 2 cm, thickness: 3 mm}' > sub/bar.yaml
printf '%s\n' 'roughness: {exponent: -2.4, rms: 5 um}' > sub/recipe.yaml
tell() { timeout 60 "$@" 2>&1 || echo "exit $?"; }
for file in /dev/stdin /dev/fd/0 /proc/self/fd/0; do
    # shellcheck disable=SC2002
    cat sub/a.yaml | tell rasp check "$file"
done
tell rasp check <(cat sub/a.yaml) <(cat set.yaml) | sed 's|/dev/fd/[0-9]*|PIPE|'
tell rasp check /dev/stdin < sub/a.yaml
tell rasp check /dev/stdin < /dev/null
tell rasp render sub/file.yaml -q -o file.wav
for call in 'render -q -o piped.wav' 'render -q -o verified.wav --verify'; do
    # shellcheck disable=SC2002,SC2086
    cat sub/a.yaml | tell rasp $call /dev/stdin
done
cmp file.wav piped.wav
cmp file.wav verified.wav
cmp file.scene.yaml piped.scene.yaml
# shellcheck disable=SC2002
{
    cat sub/a.yaml | tell rasp plan /dev/stdin | sed -n 1p
    cat sub/a.yaml | tell rasp explain /dev/stdin | grep response:
    cat sub/a.yaml | tell rasp accuracy /dev/stdin --errors=-40 --runs 1 | sed -n 1p
    cat set.yaml | tell rasp batch /dev/stdin -o set -q
    cat sub/bar.yaml | tell rasp modes object /dev/stdin -o bar.csv
    cat sub/recipe.yaml | tell rasp surface synth /dev/stdin x.gsf --size 1mm --pitch 5um
    sed 's/3 um/3 kg/' sub/a.yaml | tell rasp render /dev/stdin
    sed 's/modes.csv/none.csv/' sub/a.yaml | tell rasp check /dev/stdin
    cat modes.csv | tell rasp check sub/a.yaml --set surface.response=/dev/stdin
}
echo "-- a FIFO: it waits for who writes, and for the rest of it; a signal ends it"
mkfifo fifo.yaml
(sleep 0.3; head -c 60 sub/a.yaml; sleep 0.3; tail -c +61 sub/a.yaml) > fifo.yaml &
tell rasp check fifo.yaml
wait
for call in render plan accuracy 'batch --dry-run'; do
    # shellcheck disable=SC2086
    rasp $call fifo.yaml > log 2>&1 &
    pid=$!
    sleep 0.3
    kill -TERM $pid
    for _ in 1 2 3 4 5 6 7 8 9 10; do kill -0 $pid 2> /dev/null && sleep 0.1; done
    kill -KILL $pid 2> /dev/null && echo "$call waits on"
    code=0
    wait $pid 2> /dev/null || code=$?
    [ $code = 75 ] || echo "$call ends with $code"
    grep error: log | head -n 1
done
echo "-- what a file names is none"
sed 's/sub.file.yaml/fifo.yaml/' set.yaml > through.yaml
tell rasp check through.yaml

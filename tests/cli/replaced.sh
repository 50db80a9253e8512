# One rule for all that writes: a file that does not bear rasp's mark, or a symbolic link, is replaced only with --force; one's own render is rendered again without.
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
cp "$ROOT/surfaces/basswood.gsf" "$ROOT/irs/pvc_rod.yaml" .
cat > a.yaml << 'YAML'
rasp: 1
surface: {roughness: {}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 50 ms, diagnostics: {rate: 100 Hz, columns: [time_s, x_m]}, stems: [force]}
YAML
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
echo 'roughness: {}' > recipe.yaml
printf '%s\n' 'rasp-design: 1' 'base: a.yaml' 'factors: {motion.speed: [20 cm/s]}' 'name: one' > set.yaml
awk 'BEGIN { print "time_s,amplitude_n,duration_s"; for (i = 0; i < 80; i++) printf "%.9g,%.9g,0.001\n", i * 0.01 + 0.002 * sin(i * i), 1 + 0.3 * sin(7.7 * i * i) }' > struck.csv

# refused FILE COMMAND...: over a file, a link to one and a link to nothing; nothing changes. Then with --force, twice without it where $OWN says so.
refused() {
    local file=$1 how
    shift
    for how in file link dangling; do
        rm -f "$file" "$file.target"
        case $how in
            file) echo mine > "$file" ;;
            link) echo mine > "$file.target"; ln -s "$(basename "$file").target" "$file" ;;
            dangling) ln -s "$(basename "$file").target" "$file" ;;
        esac
        code=0
        "$@" > log 2> err < /dev/null || code=$?
        echo "$how: exit $code: $(grep -m 1 error: err)"
        case $how in
            file) [ "$(cat "$file")" = mine ] || echo "$file was replaced" ;;
            link) { [ -L "$file" ] && [ "$(cat "$file.target")" = mine ]; } || echo "written through $file" ;;
            dangling) { [ -L "$file" ] && [ ! -e "$file.target" ]; } || echo "written through $file" ;;
        esac
    done
    rm -f "$file" "$file.target"
    echo mine > "$file"
    "$@" --force > log 2>&1 < /dev/null || { echo "with --force: exit $?"; cat log; }
    [ "$(head -c 5 "$file" | tr -d '\0')" != mine ] || echo "$file was not replaced"
    [ "${OWN:-}" != yes ] || "$@" > log 2>&1 < /dev/null || { echo "again: exit $?"; cat log; }
}

OWN=yes
mkdir out golden golden/a
for ending in wav csv json scene.yaml force.wav; do
    echo "-- render, $ending"
    refused out/a.$ending rasp render -q a.yaml -o out/a.wav
done
echo "-- a table that a later render does not write stays known; files may be renamed together; not what was changed"
rasp render -q a.yaml -o out/a.wav --set output.diagnostics=null 2> /dev/null
rasp render -q a.yaml -o out/a.wav || echo "exit $?"
for ending in wav csv json scene.yaml force.wav; do mv out/a.$ending out/b.$ending; done
rasp render -q a.yaml -o out/b.wav || echo "exit $?"
echo more >> out/b.csv
rasp render -q a.yaml -o out/b.wav || echo "exit $?"
rasp render -q a.yaml -o out/b.wav --force || echo "exit $?"
echo "-- plot, gallery, analyse --plot, golden"
refused out/b.png rasp plot out/b.wav
refused out/b.svg rasp plot out/b.wav -o out/b.svg
refused out/gallery.html rasp plot --gallery out
refused out/gallery/b.png rasp plot --gallery out
refused struck.correlations.svg rasp analyse struck.csv --plot struck --format svg
refused golden/a/sound.wav rasp golden update a.yaml --kept golden
refused golden/a/sound.csv rasp golden update a.yaml --kept golden
sed -i 's/speed: 20/speed: 25/' a.yaml
rasp golden update -q a.yaml --kept golden || echo "exit $?"
refused out/cost.svg rasp accuracy a.yaml --errors=-40 --runs 1 --plot out/cost.svg
echo "-- what is to be edited, or read elsewhere, bears no mark"
OWN=
refused out/cost.csv rasp accuracy a.yaml --errors=-40 --runs 1 --csv out/cost.csv
refused new.yaml rasp new -o new.yaml
refused map.npy rasp surface convert basswood.gsf map.npy
refused map.gsf rasp surface synth recipe.yaml map.gsf --size 1mm --pitch 5um
refused table.csv rasp modes object pvc_rod.yaml -o table.csv
refused bar.csv rasp modes compute --shape bar:length=100mm,width=10mm,thickness=10mm --material steel --modes 2 -o bar.csv
refused part.yaml rasp analyse struck.csv -o part.yaml
rasp render -q "$ROOT/scenes/strike.yaml" -o out/strike.wav
refused found.csv rasp modes extract out/strike.wav --method spectrogram -o found.csv
echo "-- what bears no mark replaces no sound either"
cp out/strike.wav sound.wav
for call in 'new -o' 'modes object pvc_rod.yaml -o' 'surface convert basswood.gsf'; do
    # shellcheck disable=SC2086
    rasp $call sound.wav 2> err || echo "exit $?: $(grep error: err)"
done
cmp out/strike.wav sound.wav
echo "-- a set: a link in its own folder, too"
rasp batch -q set.yaml -o set
mv set/one.wav sound.wav
ln -s ../sound.wav set/one.wav
rasp batch -q set.yaml -o set || echo "exit $?"
rasp batch -q set.yaml -o set --force || echo "exit $?"
[ -L set/one.wav ] && cmp set/one.wav sound.wav
echo "-- what is no file is refused as ever; --verify writes its summary again"
rm -f out/a.wav
ln -s /dev/null out/a.wav
rasp render -q a.yaml -o out/a.wav --force || echo "exit $?"
rasp render -q a.yaml -o out/c.wav --verify && rasp render -q a.yaml -o out/c.wav || echo "exit $?"

# As many places as -40 dB needs, and what a table says of its interpolation: against sounds of the object itself, at
# places nobody picked.
. "$ROOT/tests/lib/test.sh"
error_of() { sed -n 's/^# interpolation_error: \(-[0-9.]*\) dB,.*/\1/p' "$1"; }
places_of() { awk -F, '!/^#/ && $1 ~ /^[0-9]+$/ && !($1 in seen) { seen[$1]; n++ } END { print n }' "$1"; }
below() { awk -v x="${1:-0}" -v limit="$2" 'BEGIN { exit !(x <= limit) }'; }
cat > plate.yaml << 'END'
material: steel
object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}
END
sed 's/supported/free/' plate.yaml > free.yaml
cat > plank.yaml << 'END'
material: oak
object: {shape: plate, edges: supported, length: 40 cm, width: 10 cm, thickness: 1 cm}
END
cat > bar.yaml << 'END'
material: steel
object: {shape: bar, edges: free, length: 30 cm, width: 2 cm, thickness: 5 mm}
END
for object in plate free plank bar; do
    rasp modes object $object.yaml --modes 40 -o $object.csv 2> /dev/null > said
    error=$(error_of $object.csv)
    below "$error" -40 || fail "$object: default places leave ${error:-no error told}"
    grep -q "between them gains are off by $error dB" said || fail "$object: the report says $(cat said)"
    below "$(places_of $object.csv)" 1000 || fail "$object: $(places_of $object.csv) places"
done

echo '== the error told is that of the sound: strikes at 12 random places of the object and of its table (sounds weigh modes otherwise, 12 are few: 6 dB)'
for options in '' '--grid 9,7' '--grid 33,23'; do
    # shellcheck disable=SC2086
    rasp modes object plate.yaml --modes 25 $options -f -q -o table.csv 2> /dev/null
    : > squares
    for at in $(awk 'BEGIN { srand(17); for (i = 0; i < 12; i++) printf "%.5f,%.5f ", 0.3 * rand(), 0.2 * rand() }'); do
        for response in "response: table.csv" "material: steel, object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}"; do
            cat > scene.yaml << END
rasp: 1
surface: {$response, modes: 25}
motion: {path: still, at: [$at], duration: 0.2 s}
contact: {model: given, given: {file: click.csv}}
output: {sample_rate: 48 kHz, encoding: float64, level: {full_scale: 1}, tail: 0.1 s}
END
            printf 'time_s,force_n\n0,0\n0.04,0\n0.04001,1\n0.04002,0\n0.2,0\n' > click.csv
            rasp render -q -o "${response%%:*}.wav" scene.yaml 2> /dev/null
        done
        { rasp compare --snr 300 material.wav response.wav || true; } | awk -v rms="$(sed -n 's/.*"rms": *\([0-9.e+-]*\).*/\1/p' material.json | head -1)" '$1 == "SNR" { print rms * rms, rms * rms * 10 ^ (-$2 / 10) }' >> squares
    done
    found=$(awk '{ whole += $1; wrong += $2 } END { print 10 * log(wrong / whole) / log(10) }' squares)
    told=$(sed -n 's/^# interpolation_error: \(-[0-9.]*\) dB,.*/\1/p' table.csv)
    awk -v x="$found" -v y="${told:-99}" 'BEGIN { exit !(x - y < 6 && y - x < 6) }' || fail "$options: told ${told:-nothing}, found $found dB"
done

echo '== what is round has no grid: more places than that are not taken unasked'
printf 'material: glass\nobject: {shape: disk, diameter: 20 cm, thickness: 2 mm, edges: clamped}\n' > disk.yaml
rasp modes object disk.yaml --modes 40 -o disk.csv > /dev/null 2> said
below "$(places_of disk.csv)" 4096 || fail "a disk of $(places_of disk.csv) places"
sed 's/-[0-9.]* dB, and/X dB, and/' said
grep -q interpolation_error disk.csv || fail 'a disk: no error told'
rasp modes object bar.yaml --at 1cm,1cm -q -o one.csv
grep -q interpolation_error one.csv && fail 'an error between places of one place'
finish

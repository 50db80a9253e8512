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
printf 'material: glass\nobject: {shape: disk, diameter: 20 cm, thickness: 2 mm, edges: free}\n' > disk.yaml
printf 'material: steel\nobject: {shape: drum, diameter: 3.73 cm, surface_tension: 30 kN/m, thickness: 0.2 mm}\n' > drum.yaml
for object in plate free plank bar disk drum 'bar --load 5g' 'disk --load 20g'; do
    load=${object#"${object%% *}"} object=${object%% *}
    # shellcheck disable=SC2086
    rasp modes object $object.yaml $load --modes 40 -f -o $object.csv 2> /dev/null > said
    error=$(error_of $object.csv)
    below "$error" -40 || fail "$object: default places leave ${error:-no error told}"
    grep -q "between them gains are off by $error dB" said || fail "$object: the report says $(cat said)"
    below "$(places_of $object.csv)" 1500 || fail "$object: $(places_of $object.csv) places"
done

echo '== the error told is that of the sound: strikes at 12 random places of the object and of its table (sounds weigh modes otherwise, 12 are few: at most 6 dB above, 12 below)'
plate="material: steel, object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}"
in_plate='x = 0.3 * rand(); y = 0.2 * rand()'
in_disk='r = d / 2 * (i % 10 ? sqrt(rand()) : 0.999); a = 6.2832 * rand(); x = r * cos(a); y = r * sin(a)' # some by the rim
while IFS='|' read -r object options in; do
    printf '%s\n' "${object%%, *}" "${object#*, }" > this.yaml
    # shellcheck disable=SC2086
    rasp modes object this.yaml --modes 25 $options -f -q -o table.csv 2> /dev/null
    : > squares
    for at in $(awk "BEGIN { srand(17); for (i = 0; i < 12; i++) { $in; printf \"%.5f,%.5f \", x, y } }"); do
        for response in "response: table.csv" "$object"; do
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
    awk -v x="$found" -v y="${told:-99}" 'BEGIN { exit !(x - y < 6 && y - x < 12) }' || fail "$object $options: told ${told:-nothing}, found $found dB"
    case $options in --grid*) ;; *) below "$told" -40 || fail "$object: $told dB" ;; esac
done << END
$plate||$in_plate
$plate|--grid 9,7|$in_plate
$plate|--grid 33,23|$in_plate
material: glass, object: {shape: disk, diameter: 20 cm, thickness: 2 mm, edges: free}||d = 0.2; $in_disk
material: oak, object: {shape: disk, diameter: 7.31 cm, thickness: 3 mm, edges: supported}||d = 0.0731; $in_disk
material: steel, object: {shape: disk, diameter: 41.7 cm, thickness: 6 mm, edges: clamped}||d = 0.417; $in_disk
material: steel, object: {shape: drum, diameter: 3.73 cm, surface_tension: 30 kN/m, thickness: 0.2 mm}||d = 0.0373; $in_disk
END

echo '== rows of rings in any order: the same sound'
{ grep '^#' table.csv; grep '^place' table.csv; grep '^[0-9]' table.csv | sort -t, -k4,4n -k2,2; } > other.csv
cmp -s table.csv other.csv && fail 'the rows are in the same order'
sed 's/^surface: .*/surface: {response: table.csv, modes: 25}/' scene.yaml > one.yaml
sed 's/table.csv/other.csv/' one.yaml > other.yaml
rasp render -q -o one.wav one.yaml
rasp render -q -o other.wav other.yaml
cmp one.wav other.wav || fail 'the order of rows is heard'

echo '== more places than the limits are not taken unasked, and that is told'
printf 'material: glass\nobject: {shape: disk, diameter: 80 cm, thickness: 2 mm, edges: clamped}\n' > large.yaml
rasp modes object large.yaml --modes 500 -o large.csv > /dev/null 2> said
below "$(places_of large.csv)" 4096 || fail "a disk of $(places_of large.csv) places"
sed 's/-[0-9.]* dB, and/X dB, and/' said
grep -q interpolation_error large.csv || fail 'a disk: no error told'
rasp modes object bar.yaml --at 1cm,1cm -q -o one.csv
grep -q interpolation_error one.csv && fail 'an error between places of one place'
finish

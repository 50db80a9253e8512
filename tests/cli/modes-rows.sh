# The order of a mode table's rows tells nothing: the same bytes in 64-bit floats, of every kind of places, poles, names
# and envelopes. A rectangle of places is bilinear in its middle, and what is symmetric about the middle of a plate
# rings alike on both sides.
. "$ROOT/tests/lib/test.sh"
scene() { # KEYS OF SURFACE, MOTION
    cat << END
rasp: 1
surface: {response: table.csv, $1}
motion: {$2}
contact: {model: given, given: {file: push.csv}}
output: {sample_rate: 48 kHz, encoding: float64, level: {full_scale: 1000}, tail: 50 ms}
END
}
awk 'BEGIN { srand(3); print "time_s,force_n"; for (i = 0; i <= 400; i++) print i / 4000 "," rand() }' > push.csv
header=place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad

# places KIND: name, x, y
places() {
    awk -v kind="$1" 'BEGIN { srand(5); pi = atan2(0, -1)
        if (kind == "grid") for (j = 0; j < 4; j++) for (i = 0; i < 5; i++) print "p" (7 * i + 35 * j) % 20, 0.05 * i, 0.04 * j
        if (kind == "turned") for (j = 0; j < 4; j++) for (i = 0; i < 5; i++) printf "%d %.6f %.6f\n", i + 5 * j, 0.04 * i - 0.02 * j, 0.03 * i + 0.0266666 * j
        if (kind == "circle") for (i = 0; i < 12; i++) printf "c%d %.9f %.9f\n", i, 0.1 + 0.1 * cos(pi * i / 6), 0.06 + 0.1 * sin(pi * i / 6)
        if (kind == "holes") for (j = 0; j < 4; j++) for (i = 0; i < 5; i++) if (i != 1 || j != 2) print i * 4 + j, 0.05 * i, 0.04 * j
        if (kind == "random") { print "a 0 0\nb 0.2 0\nc 0.2 0.12\nd 0 0.12"; for (i = 0; i < 14; i++) print i, 0.2 * rand(), 0.12 * rand() }
        if (kind == "line") for (i = 0; i < 7; i++) print 7 - i, 0.2 * i / 6, 0.02 + 0.08 * i / 6 }'
}

# rows POLES NAMES: of places on standard input; 9 modes in three sorts of equal strength, so that what is left of them by modes: 5 is a tie
rows() {
    awk -v poles="$1" -v names="$2" 'BEGIN { srand(11) } { n++
        for (k = 1; k <= 9; k++) {
            gain = (k % 3 ? 1 : -1) * (1 + 0.5 * sin(30 * $2 * (k % 3 + 1) + 20 * $3)); f = 300 * k; d = 20; phase = 1.5; name = "m" k
            if (poles == "separate") { f *= 1 + 0.02 * rand(); d *= 1 + rand(); phase = 6 * rand(); if (rand() < 0.1) continue }
            if (names == "frequency") name = "n" (k + n * 4) % 9 "_" n
            if (names == "slopes") { printf "%s,%s,%s,%s,%.9g,20,%.9g,1.5,1\n%s,%s,%s,%s,%.9g,90,%.9g,0.5,2\n", $1, $2, $3, name, f, gain, $1, $2, $3, name, f, 2 * gain; continue }
            if (names == "envelope") { for (t = 0; t < 6; t++) printf "%s,%s,%s,%s,%.9g,%g,%.9g,1.5\n", $1, $2, $3, name, f, 0.02 * t, gain * exp(-t); continue }
            printf "%s,%s,%s,%s,%.9g,%.9g,%.9g,%.9g\n", $1, $2, $3, name, f, d, gain, phase
        } }'
}

try() { # KIND POLES NAMES KEYS
    local columns=$header pairing=ids
    case $3 in slopes) columns=$header,slope ;; envelope) columns=place,x_m,y_m,mode,frequency_hz,time_s,amplitude,phase_rad ;; frequency) pairing=frequency ;; esac
    printf '# poles: %s\n# quantity: velocity\n# pairing: %s\n%s\n' "$2" "$pairing" "$columns" > head.txt
    places "$1" | rows "$2" "$3" > rows.txt
    scene "modes: 5, extrapolate: nearest${4:+, $4}" 'path: line, from: [4 cm, 3 cm], to: [15 cm, 8 cm], duration: 0.1 s' > scene.yaml
    [ "$1" != line ] || sed -i 's/from: .*, duration/from: [1 cm, 2.4 cm], to: [18 cm, 9.2 cm], duration/' scene.yaml
    for shuffle in 0 1 2 3; do
        if [ $shuffle = 0 ]; then cat head.txt rows.txt > table.csv
        else { cat head.txt; awk -v seed=$shuffle 'BEGIN { srand(seed) } { printf "%.9f %s\n", rand(), $0 }' rows.txt | sort | cut -d ' ' -f 2-; } > table.csv; fi
        rasp render --quiet -o $shuffle.wav scene.yaml > said 2>&1 || { fail "$*: $(cat said)"; return; }
        rm -f $shuffle.json $shuffle.scene.yaml
        [ $shuffle = 0 ] || cmp -s 0.wav $shuffle.wav || fail "$*: another order of rows, another sound: $(rasp compare --snr 1000 0.wav $shuffle.wav | grep '^SNR')"
    done
    [ "$(tail -c 8000 0.wav | tr -d '\0' | wc -c)" -gt 1000 ] || fail "$*: silent"
}
for kind in grid turned circle holes random line; do
    try $kind shared ids
    try $kind separate ids
    try $kind separate frequency
done
try grid separate ids 'moving: glide'
try random separate frequency 'moving: readout'
try grid shared slopes
try grid shared envelope
try circle separate slopes

echo '== 1, 0, 1, 0 on the corners of a rectangle, the contact in its middle: as 0.5 at one place'
corners() { printf '# poles: %s\n# quantity: velocity\n%s\n' shared $header; for row in "$@"; do echo "$row"; done; }
a=a,0,0,m,500,20,1,0 b=b,0.2,0,m,500,20,0,0 c=c,0.2,0.1,m,500,20,1,0 d=d,0,0.1,m,500,20,0,0
scene '' 'path: still, at: [10 cm, 5 cm], duration: 0.1 s' > scene.yaml
corners m,0,0,m,500,20,0.5,0 > table.csv
rasp render --quiet -o half.wav scene.yaml
for order in "$a $b $c $d" "$b $c $d $a" "$d $b $a $c"; do
    # shellcheck disable=SC2086
    corners $order > table.csv
    rasp render --quiet -o corners.wav scene.yaml && rasp compare --snr 280 half.wav corners.wav > said || fail "corners in the order $order: $(cat said)"
done

echo '== a plate and its mirror image: within 1e-9'
cat > plate.yaml << 'END'
material: steel
object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}
END
rasp modes object plate.yaml --modes 30 --grid 17,9 -q -f -o table.csv
for at in '7.3 cm, 3.1 cm' '22.7 cm, 3.1 cm' '22.7 cm, 16.9 cm' '7.3 cm, 16.9 cm'; do
    scene '' "path: still, at: [$at], duration: 0.1 s" > scene.yaml
    rasp render --quiet -o mirror.wav scene.yaml
    [ -e first.wav ] || cp mirror.wav first.wav
    rasp compare --snr 180 first.wav mirror.wav > said || fail "at $at: $(cat said)"
done
finish

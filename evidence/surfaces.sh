#!/bin/bash
# Makes evidence/surfaces.md and evidence/surfaces.png: ten seconds of every motion on every shipped surface, looked at side by side.
# Needs sox and gnuplot.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
surfaces=(basswood poplar ceramic acrylic pvc glass steel sandpaper)
motions=(back_and_forth line four_in_line circle scribble polyline spline recorded)

motion() {
    case $1 in
    back_and_forth) echo 'path: back_and_forth, from: [0, 0], to: [6 cm, 0], rate: 1.5 Hz, duration: 10 s' ;;
    line) echo 'path: line, from: [0, 0], to: [1.5 m, 0], duration: 10 s' ;;
    four_in_line) echo 'path: four_in_line, from: [0, 0], to: [1.5 m, 0], duration: 10 s' ;;
    circle) echo 'path: circle, radius: 3 cm, turns: 8, duration: 10 s' ;;
    scribble) echo 'path: scribble, size: [6 cm, 4 cm], rate: 1.5 Hz, duration: 10 s' ;;
    polyline) echo 'path: polyline, points: [[0, 0], [20 cm, 5 cm], [40 cm, -5 cm], [60 cm, 5 cm], [80 cm, -5 cm], [1 m, 0]], duration: 10 s' ;;
    spline) echo 'path: spline, points: [[0, 0], [20 cm, 5 cm], [30 cm, -5 cm], [20 cm, -10 cm], [0, 0], [-20 cm, 20 cm], [0, 40 cm], [20 cm, 20 cm]], duration: 10 s' ;;
    recorded) echo 'path: recorded, file: recorded.csv' ;;
    esac
}

# Ten seconds of a hand: loops that grow, 100 positions a second, held to a tenth of a millimetre as trackers do.
awk 'BEGIN { print "time_s,x_m,y_m"; for (i = 0; i <= 1000; i++) { t = i / 100; r = 0.02 + 0.003 * t;
             printf "%.2f,%.4f,%.4f\n", t, r * cos(9 * t) + 0.01 * sin(2.1 * t), 0.7 * r * sin(9 * t + 0.3 * sin(t)) } }' > recorded.csv

render() {
    cat > "$1-$2.yaml" << YAML
rasp: 1
seed: 1
surface: {recipe: $ROOT/surfaces/$1.yaml, response: $ROOT/irs/ceramic_tile_tap.wav}
scraper: {mass: 20 g}
motion: {$(motion "$2")}
grip: {angle: 30 deg}
output: {tail: 0.2 s, encoding: float32, level: {full_scale: 1}}
YAML
    rasp render "$1-$2.yaml" -q -o "$1-$2.wav"
    sox "$1-$2.wav" -n 2> /dev/null gain -n -1 spectrogram -r -x 220 -y 129 -z 90 -o "$1-$2.png"
    rms=$(sed -n 's/^ *"rms": \([0-9.e+-]*\).*/\1/p' "$1-$2.json" | head -n 1)
    rtf=$(sed -n 's/^ *"real_time_factor": \([0-9.e+-]*\).*/\1/p' "$1-$2.json" | head -n 1)
    printf ' %.3g; %.3g x |' "${rms:-0}" "${rtf:-0}"
}

sheet() {
    echo "set terminal pngcairo size 2000,1240 noenhanced font ',9'; set output '$1'; set multiplot layout ${#surfaces[@]},${#motions[@]} margins 0.04,0.995,0.01,0.97 spacing 0.004,0.012"
    echo 'unset key; unset tics; set border 15 lc rgb "grey"; set autoscale noextend'
    local s m
    for s in "${surfaces[@]}"; do
        for m in "${motions[@]}"; do
            [ "$s" = "${surfaces[0]}" ] && echo "set title '$m' offset 0,-0.8" || echo 'unset title'
            [ "$m" = "${motions[0]}" ] && echo "set ylabel '$s' offset 2,0" || echo 'unset ylabel'
            echo "plot '$s-$m.png' binary filetype=png with rgbimage"
        done
    done
    echo 'unset multiplot'
}

{
    echo '# Every motion on every shipped surface'
    echo
    echo "Made by \`evidence/surfaces.sh\` with $(rasp --version). Ten seconds each, held by a hand (30 degrees), on the ceramic tile's impulse response."
    echo 'Entries: rms of the sound (the response'"'"'s unit), and how many times faster than real time it was rendered.'
    echo
    echo "| |$(printf ' %s |' "${motions[@]}")"
    echo "|---|$(printf -- '---|%.0s' "${motions[@]}")"
    for s in "${surfaces[@]}"; do
        printf '| %s |' "$s"
        for m in "${motions[@]}"; do
            render "$s" "$m"
        done
        echo
    done
    echo
    echo 'Spectrograms, 0 to 24 kHz over 10 s, 90 dB below each one'"'"'s own peak: ![contact sheet](surfaces.png)'
} > "$ROOT/evidence/surfaces.md"
sheet "$ROOT/evidence/surfaces.png" | gnuplot

#!/bin/bash
# Makes evidence/force.md: how the scraping force converges, turns, and keeps its spectrum, from the command line.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
read -ra LIBS < <(pkg-config --libs gsl)
gcc -std=c11 -D_GNU_SOURCE -O2 -o judge "$ROOT/evidence/force_judge.c" "${LIBS[@]}" -lm

# force NAME RATE [OPTION...]: the scene on stdin; its force goes to NAME.csv, one column, one row per audio sample.
force() {
    local name=$1 rate=$2
    shift 2
    cat > "$name.yaml"
    rasp render "$name.yaml" -q -o "$name.wav" --set "output={sample_rate: $rate, ramp: 0, diagnostics: {rate: $rate, columns: [force_mean_n]}}" "$@"
}

# ------------------------------------------------------------------ 1

# scene V ALPHA BETA1: a straight stroke over the profile for 60 ms.
scene() {
    local limiter="curve: none"
    [ "$2" = none ] || limiter="alpha: $2"
    cat << YAML
rasp: 1
surface: {height_map: profile.npy, pitch: 5.6 um}
scraper: {mass: 20 g}
motion: {path: line, to: [$(awk "BEGIN { print 0.06 * $1 }"), 0], speed: $1}
load: {approach: 0 s, release: 0 s}
contact: {beta1: $3, smoothing: 0, limiter: {$limiter}}
YAML
}

reversing() {
    cat << YAML
rasp: 1
surface: {height_map: profile.npy, pitch: 5.6 um}
scraper: {mass: 20 g}
motion: {path: back_and_forth, to: [4 mm, 0], rate: 30 Hz, duration: 60 ms}
contact: {beta1: $1, smoothing: 0, limiter: {alpha: 0.01}}
YAML
}

mean() { awk '{ for (i = 1; i <= NF; i++) sum[i] += $i } END { for (i = 1; i <= NF; i++) printf " %.1f |", sum[i] / NR }'; }

convergence() {
    local v alpha beta seed over
    echo '| speed (m/s) | alpha (m) | beta1 | 1x | 2x | 4x | 8x | 16x | asked |'
    echo '|---|---|---|---|---|---|---|---|---|'
    while read -r v alpha beta asked; do
        for seed in 1 2 3; do
            ./judge profile profile.npy 40000 5.6e-6 $seed
            for over in 1 2 4 8 16; do
                scene "$v" "$alpha" "$beta" | force j$over 44100 --set accuracy.oversampling=$over
            done
            ./judge snr profile.npy 5.6e-6 44100 j1.csv:j2.csv:j4.csv:j8.csv:j16.csv v="$v" alpha="$alpha" beta1="$beta" | tr '\n' ' '
            echo
        done > ladder
        echo "| $v | $alpha | $beta |$(mean < ladder) $asked |"
    done << TABLE
0.1 0.01 0 18.8 34.9 49.1 64.0 81.4
0.1 none 0
0.25 0.01 0 13.6 29.6 42.6 55.7 69.8
0.25 none 0
0.5 0.01 0 3.5 21.7 34.0 46.6 59.5
0.5 none 0 2.4 36.5 56.2 73.5 88.1
2 0.01 0
2 none 0
0.25 0.01 5
TABLE
    for beta in 0 5; do
        for seed in 1 2 3; do
            ./judge profile profile.npy 40000 5.6e-6 $seed
            for over in 1 2 4 8 16; do
                reversing $beta | force j$over 44100 --set accuracy.oversampling=$over
            done
            ./judge snr profile.npy 5.6e-6 44100 j1.csv:j2.csv:j4.csv:j8.csv:j16.csv back=30,4e-3 alpha=0.01 beta1=$beta | tr '\n' ' '
            echo
        done > ladder
        echo "| harmonic, to 0.38, with reversals | 0.01 | $beta |$(mean < ladder) |"
    done
}

# ------------------------------------------------------------------ 2

# wave KIND DEGREES FORCE: a plane wave of 1 mm and 5 um, travelled at that angle to its normal.
wave() {
    cat << YAML
rasp: 1
surface: {along: plane, ridges: {shape: sine, spacing: 1 mm, height: 10 um, direction: $((90 + $1)) deg}}
scraper: {mass: 20 g}
motion: {path: line, from: [0, 0], to: [$(awk "BEGIN { a = $2 * atan2(0, -1) / 180; printf \"%.17g, %.17g\", 0.02 * cos(a), 0.02 * sin(a) }")], speed: 0.2 m/s}
load: {approach: 0 s, release: 0 s}
contact: {force: $3, beta1: 0, smoothing: 0, limiter: {curve: none}}
YAML
}

# largest FILE; apart A B: largest difference over largest value of A, away from the ends
largest() { awk 'NR > 200 { x = $1 < 0 ? -$1 : $1; if (x > most) most = x } END { printf "%.9g", most }' <(head -n 4500 "$1"); }
apart() { paste "$1" "$2" | head -n 4500 | awk 'NR > 200 { d = $1 - $2; if (d < 0) d = -d; x = $1 < 0 ? -$1 : $1; if (d > worst) worst = d; if (x > most) most = x } END { printf "%.2g", worst / most }'; }

rotation() {
    wave 0 0 directional | force axis 48000
    wave 0 0 paper | force plain 48000
    echo 'ridges: {shape: sine, spacing: 1 mm, height: 10 um, direction: 90 deg}' > recipe.yaml
    rasp surface synth recipe.yaml map.gsf --size 30mmx30mm --pitch 5um > synth.txt
    echo '| turned by | directional, formula: apart | directional, map of the wave under the turned path: apart | paper, formula: ratio | asked |'
    echo '|---|---|---|---|---|'
    for degrees in 15 30 45; do
        wave $degrees $degrees directional | force turned 48000
        wave $degrees $degrees paper | force paper 48000
        wave 0 $degrees directional | force formula 48000
        wave 0 $degrees directional | sed 's/^surface:.*/surface: {height_map: map.gsf, origin: [-5 mm, -5 mm]}/' | force map 48000
        echo "| $degrees deg | $(apart axis.csv turned.csv) | $(apart formula.csv map.csv) | $(awk "BEGIN { printf \"%.6f\", $(largest paper.csv) / $(largest plain.csv) }") | $(awk "BEGIN { a = $degrees * atan2(0, -1) / 180; printf \"%.6f\", cos(a)^4 + sin(a)^4 }") |"
    done
}

# ------------------------------------------------------------------ 3

# worst A B WITHIN: bands below 8 kHz, and within that many dB of the loudest
worst() {
    paste "$1" "$2" | awk -v within="$3" '$1 < 7000 { a[++n] = $2; b[n] = $4; f[n] = $1; if (n == 1 || $2 > loudest) loudest = $2 }
        END { for (i = 1; i <= n; i++) if (a[i] >= loudest - within) { d = a[i] - b[i]; if (d < 0) d = -d; if (d > most) { most = d; at = f[i] } }
              printf "%.2f at %.0f Hz", most, at }'
}
column() { sox "$1" -t dat - | awk 'BEGIN { print "force_mean_n" } !/^;/ { print $2 }'; }

rates() {
    local scene=$ROOT/scenes/basswood_scrape.yaml rate
    echo '| sample rate (Hz) | force (dB) | sound, bands within 40 dB of the loudest (dB) |'
    echo '|---|---|---|'
    for rate in 192000 22050 44100 48000 96000; do
        rasp render "$scene" -q -o "r$rate.wav" --set output.encoding=float64 --set output.level=null --set output.level.peak=-1 \
            --set output.tail=0.3 --set accuracy=high --set output.sample_rate=$rate \
            --set "output.diagnostics={rate: $rate, columns: [force_mean_n]}" 2> /dev/null
        ./judge bands $rate r$rate.csv > force$rate
        column r$rate.wav > sound.csv
        ./judge bands $rate sound.csv | awk -v peak="$(sed -n 's/^ *"peak": \([-0-9.e]*\).*/\1/p' "r$rate.json" | head -n 1)" '{ print $1, $2 + 20 * log(peak) / log(10) }' > sound$rate
        [ $rate = 192000 ] || echo "| $rate | $(worst force192000 force$rate 200) | $(worst sound192000 sound$rate 40) |"
    done
}

{
    echo '# The scraping force'
    echo
    echo "Made by \`evidence/force.sh\` with $(rasp --version) on $(uname -m), $(getconf _NPROCESSORS_ONLN) processors."
    echo
    echo '## Convergence'
    echo
    echo 'Signal-to-noise ratio in dB, 20 Hz to 20 kHz at 44.1 kHz over 50 ms, against adaptive quadrature of the definition by a program that shares no'
    echo 'code with rasp (`evidence/force_judge.c`); mean over three self-affine profiles (Hurst exponent 0.8, rms 2 um, pitch 5.6 um), among'
    echo 'which figures scatter by 0.5 dB. Asked: the figures to be reached, which plain means over sub-intervals give. Here means are weighted by linear B-splines,'
    echo 'so that what lies beyond the sub-rate folds in with sinc squared: the error falls with the third power of the oversampling, or faster.'
    echo
    convergence
    echo
    echo '## Rotation'
    echo
    echo 'A plane wave (1 mm, 5 um) and the path across it, both turned; without limiter. Apart: largest difference of two samples of the force, over the'
    echo 'largest sample. The paper'"'"'s equation 2 depends on the axes: cos^4 + sin^4 of the angle.'
    echo
    rotation
    echo
    echo '## Sample rates'
    echo
    echo 'Largest difference of a third-octave level below 8 kHz against the same scene (scenes/basswood_scrape.yaml, accuracy high) at 192 kHz.'
    echo
    rates
} > "$ROOT/evidence/force.md"

#!/bin/bash
# Makes evidence/maps.md: what `rasp surface info` says of seven measured profiles and that they render; procedural roughness as asked and as
# measured. The profiles are looked for in ../shared/data/surfaces (or MEASURED); without them their part is left out.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
MEASURED=${MEASURED:-$ROOT/../shared/data/surfaces}
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"

# value KEY FACTOR FORMAT: the first number of that name in info.json
value() { sed -n "s/^ *\"$1\": \([-0-9.e+]*\),*$/\1/p" info.json | head -n 1 | awk -v f="$2" -v form="$3" '{ printf form, $1 * f }'; }

measured() {
    echo '| profile | rms (um) | band limit (cycles/mm) | seam jump if repeated (um) | highest autocorrelation far out | warnings | renders (rms force, N) |'
    echo '|---|---|---|---|---|---|---|'
    local file name
    for file in "$MEASURED"/*.npy; do
        name=$(basename "$file" .npy)
        rasp surface info --json --pitch 1.394068um "$file" > info.json
        cat > scene.yaml << YAML
rasp: 1
surface: {height_map: $file, pitch: 1.394068 um, response: $ROOT/irs/ceramic_tile_tap.wav}
scraper: {mass: 20 g}
motion: {path: back_and_forth, to: [8 cm, 0], rate: 2 Hz, duration: 2 s}
grip: {angle: 30 deg}
output: {diagnostics: {rate: 1 kHz, columns: [force_rms_n]}}
YAML
        rasp render scene.yaml -q -o "$name.wav"
        echo "| $name | $(value sq_m 1e6 %.3g) | $(value limit_cycles_per_m 1e-3 %.3g) | $(value jump_repeated_m 1e6 %.3g) | $(value autocorrelation 1 %.2f) at $(value lag_samples 1 %.0f) samples | $(sed -n '/"warnings"/,/\]/p' info.json | grep -c '^ *"[a-z0-9]' || true) | $(awk 'NR > 1 { s += $1 * $1 } END { printf "%.3g", sqrt(s / (NR - 1)) }' "$name.csv") |"
    done
}

synthetic() {
    echo '| asked | measured on | rms (um) | exponent | skewness | kurtosis |'
    echo '|---|---|---|---|---|---|'
    local rms exponent skewness kurtosis size
    while read -r rms exponent skewness kurtosis size; do
        echo "roughness: {rms: $rms um, exponent: $exponent, longest: 0.5 mm, shortest: 20 um, skewness: $skewness, kurtosis: $kurtosis}" > recipe.yaml
        rasp surface synth -q -f recipe.yaml map.npy --size "$size" --pitch 5um --seed 3
        rasp surface info --json --pitch 5um map.npy > info.json
        echo "| rms $rms um, exponent $exponent, skewness $skewness, kurtosis $kurtosis | $size | $(value sq_m 1e6 %.3f) | $(value exponent 1 %.2f) | $(value ssk 1 %.2f) | $(value sku 1 %.2f) |"
    done << TABLE
4 -2.4 0 3 2m
4 -2.4 0 3 10mmx10mm
1 -3 -1 5 2m
1 -3 -1 5 10mmx10mm
10 -1.5 0.5 4 2m
TABLE
}

{
    echo '# Height maps'
    echo
    echo "Made by \`evidence/maps.sh\` with $(rasp --version)."
    if [ -d "$MEASURED" ]; then
        echo
        echo '## Seven measured profiles'
        echo
        echo 'Confocal-microscope profiles published with ThreeDWorld, read as 1.394068 um apart. Four of them end in resampling artefacts, hold nothing above some'
        echo '13 cycles/mm and would jump if repeated; the acrylic one is rows of an image laid end to end (it resembles itself 1024 samples on).'
        echo
        measured
    fi
    echo
    echo '## Procedural roughness as asked and as measured'
    echo
    echo 'By `rasp surface synth` and `rasp surface info`, whose estimates of one draw scatter: with features of 0.5 mm, a profile of 2 m holds some 4000 of'
    echo 'them, a map of 10 mm by 10 mm some 400. The spectrum of skewed heights is not corrected for the transform (src/surface/heights.h says by how much it changes).'
    echo
    synthetic
    echo
    echo 'With Gwyddion 2.62 (`tests/cli/surface-gwyddion.sh`): the largest difference of a height between what rasp writes and what Gwyddion reads of it is 0.23 pm in'
    echo 'GSF (float32), 0 in SDF, binary and text, 0 in GWY, and half a step in PNG; sizes and missing points survive, and rasp reads what Gwyddion writes.'
} > "$ROOT/evidence/maps.md"

#!/bin/bash
# Makes evidence/rates.md: how far the sound of random scenes depends on the sample rate, from the command line.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
gcc -std=c11 -D_GNU_SOURCE -O2 -o judge "$ROOT/evidence/rates_judge.c" -lm

# render SEED RATE: SEED-RATE.wav, and SEED-RATE.warn if modes were left out because of the rate.
render() {
    { cat "$1.yaml"; echo ", sample_rate: $2, encoding: float64, level: {full_scale: 1}}"; } > "$1-$2.yaml"
    rasp render "$1-$2.yaml" -q -o "$1-$2.wav" 2> "$1-$2.warn"
}

# what SEED: of what the scene is made, as cells.
what() {
    local body contact
    body=$(grep -o 'shape: [a-z]*' "$1.yaml" | sed 's/shape: //' || true)
    contact=$(grep -o 'model: [a-z]*' "$1.yaml" | sed 's/model: //' || true)
    echo "| ${body:-table} | $(grep -o 'modes: [0-9]*' "$1.yaml" | sed 's/modes: //') | ${contact:-scrape} | $(grep -o 'quantity: [a-z]*' "$1.yaml" | sed 's/quantity: //') "
}

# scene SEED: a row, seed first.
scene() {
    local rate left=0
    ./judge scene "$1" "$WORK"
    for rate in 192000 96000 48000 44100; do render "$1" "$rate"; done
    left=$(sed -n 's/.*: \([0-9]*\) of its [0-9]* strongest modes lie.*/\1/p' "$1-44100.warn")
    printf '| %s %s' "$1" "$(what "$1")"
    for rate in 44100 48000 96000; do printf '| %s ' "$(./judge apart "$1-$rate.wav" "$1-192000.wav" | awk '{ print $1 " at " $2 " Hz" }')"; done
    echo "| ${left:-0} |"
    rm -f -- *.wav
}

rows() {
    local seed
    echo '| seed | rings | modes | contact | heard | 44.1 kHz | 48 kHz | 96 kHz | left out at 44.1 kHz |'
    echo '|---|---|---|---|---|---|---|---|---|'
    for ((seed = $1; seed <= $2; seed++)); do scene "$seed"; done
}

# worst: of such rows, how many are beyond 0.5 dB, and the greatest figure.
worst() {
    awk -F'|' 'NR > 2 { n++; most = 0; for (i = 7; i <= 9; i++) { split($i, a, " "); if (a[1] > most) most = a[1] } if (most > 0.5) beyond++; if (most > all) all = most }
               END { printf "%d of %d scenes are off by more than 0.5 dB; the greatest difference is %.3f dB.\n", beyond, n, all }' "$1"
}

rows 1 20 > first
rows 21 100 > others
{
    cat << MD
# The sample rate

Made by \`evidence/rates.sh\` with $(rasp --version | head -n 1) on $(uname -m), $(nproc) processors.

Random scenes (\`tests/unit/rates.h\`: bars, rods, plates, disks, membranes, strings, shells of six materials, and mode tables of any quantity and any phases, with
poles shared or separate; strikes, impacts, forces from a file, scrapes; still and moving), heard as velocity or acceleration, at \`accuracy.preset: high\`, which keeps the
force's own error out. What is shown is the largest difference of third octaves against 192 kHz, in dB: of those that end below 0.4 of the lower rate and lie within
40 dB of the loudest. Asked is 0.5 dB.

Modes are chosen from \`surface.band\`, 20 Hz to 20 kHz, at all rates; those above 0.45 of the rate do not ring, which the last column counts. What sampling
folds into the band is taken out (\`src/convolution/alias.c\`).

## Twenty scenes

$(worst first)

$(cat first)

## Eighty more

$(worst others) A scene beyond 0.1 dB is one in which a mode between 19 845 Hz, 0.45 of 44.1 kHz, and 20 kHz is left out at that rate: what it had below its
resonance is missing. With a band that ends at 19.8 kHz it agrees as the others do.

$(cat others)
MD
} > "$ROOT/evidence/rates.md"

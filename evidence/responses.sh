#!/bin/bash
# Makes evidence/responses.md: how well and at what cost a response that moves with the contact is rendered, from the command line, against
# evidence/responses_judge.c, which sums the definitions sample by sample (about 15 minutes on two cores).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
read -ra LIBS < <(pkg-config --libs gsl sndfile)
gcc -std=c11 -D_GNU_SOURCE -O3 -march=x86-64-v3 -o judge "$ROOT/evidence/responses_judge.c" "${LIBS[@]}" -lm
RATE=44100

# scene NAME SECONDS: the force NAME.npy through the table NAME.csv, from one place to the other.
scene() {
    cat << YAML > "$1.yaml"
rasp: 1
surface: {response: $1.csv, modes: 50}
motion: {path: line, from: [0, 0], to: [1, 0], duration: $2}
contact: {model: given, given: {file: $1.npy, rate: $RATE}}
output: {sample_rate: $RATE, encoding: float64, level: {full_scale: 1}, ramp: 0, tail: 0}
YAML
}

# make NAME SECONDS DMAX [READING...]: table, force, scene, and the judge's sums.
make() {
    local name=$1 seconds=$2 dmax=$3
    shift 3
    ./judge make "$name.csv" "$name.npy" $RATE "$seconds" "$dmax"
    scene "$name" "$seconds"
    for reading; do
        ./judge sum "$reading" "$name.csv" "$name.npy" $RATE "$seconds" "$name-$reading.npy" &
    done
    wait
}

# render NAME OPTION...: to NAME.wav; sets COST, the seconds of CPU of the stage that rings, and ERROR, the predicted error in dB.
render() {
    local name=$1
    shift
    rasp render "$name.yaml" -q -o "$name.wav" "$@"
    read -r COST ERROR < <(python3 -c "import json; c = json.load(open('$name.json'))['contacts'][0]; print(sum(s['cpu_s'] for s in c['stages'] if s['stage'].startswith('surface_')), c.get('response', {}).get('predicted_error_db', 0))")
}

snr() { ./judge snr "$1-$2.npy" "$1.wav" "${@:3}"; }

convergence() {
    local order hop
    echo '| hop | ms | order 1: measured, predicted (dB) | order 2 | order 4 | CPU s, order 4 | times real time |'
    echo '|---|---|---|---|---|---|---|'
    for hop in 4096 2048 1024 512 256 128; do
        printf '| %d | %.1f |' $hop "$(awk "BEGIN { print 1e3 * $hop / $RATE }")"
        for order in 1 2 4; do
            render main --set surface.convolution=overlap_add \
                --set "accuracy={overlap_order: $order, morph_error: 0, overlap_hop: $(awk "BEGIN { printf \"%.9g\", ($hop + 0.1) / $RATE }")}"
            printf ' %s, %.1f |' "$(snr main launch)" "$(awk "BEGIN { print -($ERROR) }")"
        done
        awk "BEGIN { printf \" %.3f | %.1f |\n\", $COST, 2 / $COST }"
    done
}

asked() {
    local error
    echo '| engine | error asked (dB) | measured (dB) | CPU s | times real time |'
    echo '|---|---|---|---|---|'
    for error in -40 -70 -100 -140; do
        for engine in resonators overlap_add nodes; do
            render main --set surface.convolution=$engine --set "accuracy={morph_error: $error, overlap_order: 4, overlap_hop: 1 s}"
            printf '| %s | %d | %s |' $engine $error "$(awk "BEGIN { print -($(snr main launch)) }")"
            awk "BEGIN { printf \" %.3f | %.1f |\n\", $COST, 2 / $COST }"
        done
    done
}

readings() {
    local dmax
    echo '| largest change of frequency | glide against launch (dB) | readout against launch | readout against glide |'
    echo '|---|---|---|---|'
    for dmax in 0 0.001 0.005 0.02 0.1; do
        make r 2 $dmax launch
        for reading in glide readout launch; do
            render r --set surface.moving=$reading --set "accuracy={preset: high, overlap_hop: 0.2 s, morph_error: -90, gain_ramp: 16}"
            cp r.wav r-$reading.wav
        done
        printf '| %s %% | %s | %s | %s |\n' "$(awk "BEGIN { print 100 * $dmax }")" "$(wav_snr launch glide)" "$(wav_snr launch readout)" "$(wav_snr glide readout)"
    done
}
wav_snr() { rasp compare r-"$1".wav r-"$2".wav --snr 300 --json 2>&1 | jq -r '[.. | .snr_db? // empty] | first | . * 10 | round / 10' || true; }

glide() {
    local ramp
    echo '| gain_ramp | SNR (dB) | cost in real time |'
    echo '|---|---|---|'
    for ramp in 256 128 64 32 16 1; do
        render main --set surface.moving=glide --set accuracy.gain_ramp=$ramp
        printf '| %d | %s | %s |\n' $ramp "$(snr main glide)" "$(awk "BEGIN { printf \"%.0f\", 2 / $COST }")"
    done
}

make main 2 0.02 launch glide

{
    cat << MD
# Responses that move with the contact

Made by \`evidence/responses.sh\`. Rendered by \`rasp render\` with \`contact.model: given\`, judged by sums of the definitions, sample by sample
(\`responses_judge.c\`). One object: 50 modes from 100 Hz to 15 kHz, T60 = 0.9 s (f/100 Hz)^-0.3, in 2 s from one place to another at which each
frequency differs by up to 2 %, each decay by up to 30 %, each gain by up to 10 dB; white force, 44.1 kHz.

## \`launch\` by overlap-add: hop and order

SNR against the sum, and the a-priori formula's (\`convolution/ring_survey.c\`), which the summary of a render reports.

$(convergence)

## \`launch\`: what is asked and what is kept

\`accuracy.morph_error\` asked for; each engine chooses hops or nodes by itself.

$(asked)

## \`glide\`: poles ramped linearly

$(glide)

## How much the readings differ

The same force, the same two places, the largest change of frequency as given: which reading is meant matters more than any hop.

$(readings)
MD
} > report.md
mv report.md "$ROOT/evidence/responses.md"

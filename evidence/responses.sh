#!/bin/bash
# Makes evidence/responses.md: how well and at what cost a response that moves with the contact is rendered, from the command line, against
# evidence/responses_judge.c, which sums the definitions sample by sample (about 10 minutes on two cores). Needs build/tests/test_glide (make unit).
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

# scene NAME SECONDS [MOTION]: the force NAME.npy through the table NAME.csv, from one place to the other.
scene() {
    local motion="path: line, from: [0, 0], to: [1, 0]"
    case ${3:-line} in
        jerk) motion="$motion, law: minimum_jerk" ;;
        strokes:*) motion="path: back_and_forth, from: [0, 0], to: [1, 0], rate: ${3#*:} Hz" ;;
        circle:*) motion="path: circle, center: [0.5, 0], radius: 0.5, turns: ${3#*:}" ;;
    esac
    cat << YAML > "$1.yaml"
rasp: 1
surface: {response: $1.csv, modes: 50, extrapolate: nearest}
motion: {$motion, duration: $2}
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

# render NAME OPTION...: to NAME.wav; sets COST, the seconds of CPU of the stage that rings.
render() {
    local name=$1
    shift
    rasp render "$name.yaml" -q -o "$name.wav" "$@"
    COST=$(python3 -c "import json; c = json.load(open('$name.json'))['contacts'][0]; print(sum(s['cpu_s'] for s in c['stages'] if s['stage'].startswith('surface_')))")
}

snr() { ./judge snr "$1-$2.npy" "$1.wav" "${@:3}"; }

# row LABEL NAME READING ENGINE: SNR and CPU time at each gain_ramp.
row() {
    local ramp
    printf '| %s | %s | %s |' "$1" "$3" "$4"
    for ramp in 256 64 16 4; do
        render "$2" --set "surface.moving=$3" --set "surface.convolution=$4" --set accuracy.gain_ramp=$ramp
        printf ' %s, %.3f |' "$(snr "$2" "$3")" "$COST"
    done
    echo
}

head_of() {
    echo "| $1 | reading | engine | gain_ramp 256: SNR (dB), CPU s | 64 | 16 | 4 |"
    echo '|---|---|---|---|---|---|---|'
}

# The same object, along motions that are not at constant speed, 1 s.
motions() {
    local motion reading
    head_of motion
    for motion in line jerk strokes:2 strokes:8 circle:3; do
        ./judge make m.csv m.npy $RATE 1 0.02
        scene m 1 $motion
        for reading in launch glide readout; do
            ./judge sum $reading m.csv m.npy $RATE 1 m-$reading.npy $motion &
        done
        wait
        row $motion m launch resonators
        row $motion m launch overlap_add
        row $motion m glide resonators
        row $motion m readout overlap_add
    done
}

# One mode, of which one thing moves a little, 1 s.
weak() {
    local motion what
    local -A body=([gain]='7000 50 0.8 0.2 7000 50 0.88 0.2' [gain_x3]='7000 50 0.8 0.2 7000 50 2.4 0.2' [frequency]='7000 50 0.8 0.2 7000.7 50 0.8 0.2'
                   [decay]='7000 50 0.8 0.2 7000 50.5 0.8 0.2' [phase]='7000 50 0.8 0.2 7000 50 0.8 0.9')
    head_of 'what moves, motion'
    for what in gain gain_x3 frequency decay phase; do
        # shellcheck disable=SC2086 # eight words
        ./judge one m.csv ${body[$what]}
        for motion in strokes:2 strokes:20; do
            scene m 1 $motion
            ./judge sum launch m.csv m.npy $RATE 1 m-launch.npy $motion
            row "$what, $motion" m launch resonators
        done
    done
}

# Where poles and gains are the same at both places: each reading against the sum.
same() {
    local reading
    make s 1 same launch
    echo '| reading, engine | error (dB) |'
    echo '|---|---|'
    for reading in launch,resonators launch,overlap_add glide,resonators readout,overlap_add; do
        render s --set "surface.moving=${reading%,*}" --set "surface.convolution=${reading#*,}"
        printf '| %s | %s |\n' "$reading" "$(awk "BEGIN { print -($(snr s launch)) }")"
    done
}

readings() {
    local dmax
    echo '| largest change of frequency | glide against launch (dB) | readout against launch | readout against glide |'
    echo '|---|---|---|---|'
    for dmax in 0 0.001 0.005 0.02 0.1; do
        make r 2 $dmax
        for reading in glide readout launch; do
            render r --set surface.moving=$reading --set accuracy=high
            cp r.wav r-$reading.wav
        done
        printf '| %s %% | %s | %s | %s |\n' "$(awk "BEGIN { print 100 * $dmax }")" "$(wav_snr launch glide)" "$(wav_snr launch readout)" "$(wav_snr glide readout)"
    done
}
wav_snr() { rasp compare r-"$1".wav r-"$2".wav --snr 300 --json 2>&1 | jq -r '[.. | .snr_db? // empty] | first | . * 10 | round / 10' || true; }

glide() {
    local ramp
    echo '| gain_ramp | SNR (dB) | times real time |'
    echo '|---|---|---|'
    for ramp in 256 128 64 32 16 1; do
        render main --set surface.moving=glide --set accuracy.gain_ramp=$ramp
        printf '| %d | %s | %s |\n' $ramp "$(snr main glide)" "$(awk "BEGIN { printf \"%.0f\", 2 / $COST }")"
    done
}

# What tests/unit/test_glide.c measures: amplitude of a mode without decay while it is retuned, resonators against the direct form.
modulations() {
    echo '| modulation | least and largest amplitude, normal form | direct form |'
    echo '|---|---|---|'
    "$BUILD/tests/test_glide" | sed -nE 's/^(.*[^ ]) +([0-9.]+ to [0-9.]+); direct form (.*)$/| \1 | \2 | \3 |/p'
}

make main 2 0.02 glide

{
    cat << MD
# Responses that move with the contact

Made by \`evidence/responses.sh\`. Rendered by \`rasp render\` with \`contact.model: given\`, judged by sums of the definitions, sample by sample
(\`responses_judge.c\`). One object: 50 modes from 100 Hz to 15 kHz, T60 = 0.9 s (f/100 Hz)^-0.3, in 2 s from one place to another at which each
frequency differs by up to 2 %, each decay by up to 30 %, each gain by up to 10 dB; white force, 44.1 kHz.

## Motions, readings and engines

The same object, 1 s: along a line, at constant speed and at minimum jerk; to and fro, 2 and 8 times a second; three turns of a circle. SNR against the sum,
and seconds of CPU. \`accuracy.gain_ramp\` from draft's 256 to 4; every second column lies two halvings on, 24 dB finer but for kinks, such as the stop at the end,
of \`readout\`, and for what launch drops and alias taps leave.

$(motions)

## One mode that moves but little

$(weak)

## Poles that do not move

Fifty modes, both places alike: every reading is the same sound (what is left is the response's end at -140 dB, what launch drops at -100 dB, and rounding).

$(same)

## \`glide\`: normal form

$(modulations)

## \`glide\`: poles ramped linearly

$(glide)

## How much the readings differ

The same force, the same two places, the largest change of frequency as given: which reading is meant matters more than any hop.

$(readings)
MD
} > report.md
mv report.md "$ROOT/evidence/responses.md"

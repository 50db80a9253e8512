#!/bin/bash
# Makes evidence/responses.md: how well and at what cost a response that moves with the contact is rendered, from the command line (about 5 minutes on two cores).
# Needs build/unit (make unit).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
read -ra LIBS < <(pkg-config --libs gsl)
gcc -std=c11 -D_GNU_SOURCE -O2 -o object "$ROOT/evidence/responses_object.c" "${LIBS[@]}" -lm
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

# render NAME OPTION...: to NAME.wav; sets COST, the seconds of CPU of the stage that rings.
render() {
    local name=$1
    shift
    rasp render "$name.yaml" -q -o "$name.wav" "$@"
    COST=$(python3 -c "import json; c = json.load(open('$name.json'))['contacts'][0]; print(sum(s['cpu_s'] for s in c['stages'] if s['stage'].startswith('surface_')))")
}

# snr A B: of B.wav against A.wav, dB; nothing where they are the same.
snr() { rasp compare "$1.wav" "$2.wav" --snr 300 --json 2>&1 | jq -r '[.. | .snr_db? // empty] | first | . * 10 | round / 10' || true; }

# row LABEL READING ENGINE: of m.yaml, SNR against the same reading at gain_ramp 1 (by resonators where they can), and CPU time, at each gain_ramp.
row() {
    local ramp
    printf '| %s | %s | %s |' "$1" "$2" "$3"
    for ramp in 256 64 16 4; do
        render m --set "surface.moving=$2" --set "surface.convolution=$3" --set accuracy.gain_ramp=$ramp
        printf ' %s, %.3f |' "$(snr "exact-$2" m)" "$COST"
    done
    echo
}

# exact READING...: exact-READING.wav, at gain_ramp 1.
exact() {
    local reading
    for reading; do
        render m --set "surface.moving=$reading" --set accuracy.gain_ramp=1
        cp m.wav "exact-$reading.wav"
    done
}

head_of() {
    echo "| $1 | reading | engine | gain_ramp 256: SNR (dB), CPU s | 64 | 16 | 4 |"
    echo '|---|---|---|---|---|---|---|'
}

# The same object, along motions that are not at constant speed, 1 s.
motions() {
    local motion
    head_of motion
    ./object make m.csv m.npy $RATE 1 0.02
    for motion in line jerk strokes:2 strokes:8 circle:3; do
        scene m 1 $motion
        exact launch glide readout
        row $motion launch resonators
        row $motion launch overlap_add
        row $motion glide resonators
        row $motion readout overlap_add
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
        ./object one m.csv ${body[$what]}
        for motion in strokes:2 strokes:20; do
            scene m 1 $motion
            exact launch
            row "$what, $motion" launch resonators
        done
    done
}

# Where poles and gains are the same at both places: each reading against glide, which is then fixed.
same() {
    local way
    ./object make m.csv m.npy $RATE 1 same
    scene m 1
    exact glide
    echo '| reading, engine | error (dB) |'
    echo '|---|---|'
    for way in launch,resonators launch,overlap_add readout,overlap_add; do
        render m --set "surface.moving=${way%,*}" --set "surface.convolution=${way#*,}"
        printf '| %s | %s |\n' "$way" "$(snr exact-glide m | sed 's/^/-/')"
    done
}

readings() {
    local dmax reading
    echo '| largest change of frequency | glide against launch (dB) | readout against launch | readout against glide |'
    echo '|---|---|---|---|'
    for dmax in 0 0.001 0.005 0.02 0.1; do
        ./object make m.csv m.npy $RATE 2 $dmax
        scene m 2
        for reading in glide readout launch; do
            render m --set surface.moving=$reading --set accuracy=high
            cp m.wav $reading.wav
        done
        printf '| %s %% | %s | %s | %s |\n' "$(awk "BEGIN { print 100 * $dmax }")" "$(snr launch glide)" "$(snr launch readout)" "$(snr glide readout)"
    done
}

# What tests/unit/test_glide.c measures: amplitude of a mode without decay while it is retuned, resonators against the direct form.
modulations() {
    echo '| modulation | least and largest amplitude, normal form | direct form |'
    echo '|---|---|---|'
    "$BUILD/unit" test_glide | sed -nE 's/^(.*[^ ]) +([0-9.]+ to [0-9.]+); direct form (.*)$/| \1 | \2 | \3 |/p'
}

{
    cat << MD
# Responses that move with the contact

Made by \`evidence/responses.sh\`. Rendered by \`rasp render\` with \`contact.model: given\`. One object (\`responses_object.c\`): 50 modes from 100 Hz to 15 kHz,
T60 = 0.9 s (f/100 Hz)^-0.3, from one place to another at which each frequency differs by up to 2 %, each decay by up to 30 %, each gain by up to 10 dB; white
force, 44.1 kHz. That each reading is its definition, summed sample by sample, \`tests/unit/test_ring.c\` holds, to -150 dB; here is how fast it is
approached, and at what cost.

## Motions, readings and engines

1 s along a line, at constant speed and at minimum jerk; to and fro, 2 and 8 times a second; three turns of a circle. SNR against the same reading at
\`accuracy.gain_ramp: 1\`, and seconds of CPU. From one column to the next gain_ramp is a quarter (the first two are draft and standard): 24 dB, but at
kinks, such as the stop at the end, of \`readout\`, and beyond what the reference itself has.

$(motions)

## One mode that moves but little

$(weak)

## Poles that do not move

Fifty modes, both places alike: every reading is the same sound (what is left is what launch drops at -100 dB, and rounding).

$(same)

## \`glide\`: normal form

$(modulations)

## How much the readings differ

The same force, the same two places, the largest change of frequency as given: which reading is meant matters more than any hop.

$(readings)
MD
} > report.md
mv report.md "$ROOT/evidence/responses.md"

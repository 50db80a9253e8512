#!/bin/bash
# Makes evidence/extract.md and evidence/extract.png: the modes of four real objects from recordings of a hammer's
# strikes on them (channel 1 a microphone, channel 2 the hammer's force), and of a rendered recording whose modes are
# known. The recordings are looked for in ../shared/data/impacts (or RECORDED): steel.wav, ceramic.wav, polycarb.wav,
# wood.wav; without them nothing is done. Needs python3, gnuplot and GNU time.
#
#   OBJECTS="steel ceramic polycarb wood"  JOBS=2  LIMIT=900 (CPU s for each fit)
#   KINDS="Prescott ..."   kinds of OpenBLAS's kernels; default: all that this CPU can run
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export PATH=$BUILD:$PATH
RECORDED=$(realpath -m "${RECORDED:-$ROOT/../shared/data/impacts}")
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/extract.md}")
. "$ROOT/tests/lib/kernels.sh"
KINDS=${KINDS-$(kernels)}
export ROOT KINDS OBJECTS=${OBJECTS:-steel ceramic polycarb wood} LIMIT=${LIMIT:-900}
for object in $OBJECTS; do
    [ ! -f "$RECORDED/$object.wav" ] || continue
    echo "skipped: no $object.wav in ../shared/data/impacts (or RECORDED)"
    exit 0
done
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
for object in $OBJECTS; do
    ln -s "$RECORDED/$object.wav" "$object.wav"
done

cat > plate.yaml << 'YAML'
rasp: 1
surface:
  material: pvc
  modes: 10
  object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}
scraper: {mass: 2 g}
motion: {path: still, at: [7 cm, 6 cm], duration: 5 s}
contact:
  model: strike
  strike: {pulse: half_sine, speed: 1 m/s, stiffness: 2e5, first: 0.5 s, count: 3, interval: 1 s}
output:
  {stems: [force], level: {full_scale: 10 m/s}, sample_rate: 24 kHz, encoding: float32, quantity: velocity}
YAML

# fit OBJECT NAME [OPTION...]: its report, table, exit code, time and memory as OBJECT.NAME.json, .csv, .code, .time.
fit() {
    local to=$1.$2 code=0
    (ulimit -t "$LIMIT"; exec /usr/bin/time -q -o "$to.time" -f '%U %S %M' rasp modes extract "$1.wav" --force-channel 2 \
        --json "${@:3}" -f -o "$to.csv") > "$to.json" 2> "$to.err" || code=$?
    [ -s "$to.time" ] || echo "nan nan nan" > "$to.time"
    echo "$code" > "$to.code"
}

# fits OBJECT: to all strikes, to every other one and to the rest, and to all by every kind of kernels.
fits() {
    local half kind
    fit "$1" all --plot "$1.png"
    if [ "$(< "$1.all.code")" = 0 ]; then
        mapfile -t half < <(python3 "$ROOT/evidence/extract_report.py" halves "$1")
        fit "$1" odd --strikes "${half[0]}"
        fit "$1" even --strikes "${half[1]}"
    else
        for half in odd even; do
            cp "$1.all.json" "$1.$half.json"; cp "$1.all.err" "$1.$half.err"; cp "$1.all.code" "$1.$half.code"
        done
    fi
    for flip in 1 2 3 4; do
        python3 "$ROOT/evidence/extract_report.py" flip "$1" "$flip"
        fit "$1" "flip$flip"
        rm "$1.wav"; ln -s "$RECORDED/$1.wav" "$1.wav"
    done
    for kind in $KINDS; do
        OPENBLAS_CORETYPE=$kind fit "$1" "$kind"
    done
}
export -f fit fits
export RECORDED

sheet() {
    echo "set terminal pngcairo size 2200,1800; set output 'sheet.png'; unset key; unset tics; unset border"
    echo "set multiplot layout 2,2 margins 0,1,0,1 spacing 0,0; set autoscale noextend"
    local object
    for object in $OBJECTS; do
        [ ! -s "$object.png" ] || echo "plot '$object.png' binary filetype=png with rgbimage"
    done
    echo 'unset multiplot'
}

printf '%s\n' $OBJECTS | xargs -P "${JOBS:-2}" -I OBJECT bash -c 'fits OBJECT'
pids=()
for part in ways draws; do
    mkdir $part
    cp plate.yaml $part
    (cd $part; python3 "$ROOT/evidence/extract_known.py" $part > ../$part.md) &
    pids+=($!)
done
for pid in "${pids[@]}"; do
    wait "$pid"
done
sheet | gnuplot
for part in strikes modes apart halves_agree flips kinds order lines said; do
    python3 "$ROOT/evidence/extract_report.py" $part > $part.md
done

cat > report.md << MD
# Modes of real objects

Made by \`evidence/extract.sh\` with $(rasp --version), from the command line. Recordings that are made of drawn modes are
\`evidence/ringing.sh\`'s matter; here are a rendered plate and four real objects.

## A recording whose modes are known

A PVC plate, 30 x 20 cm, its 10 lowest modes of 105 to 3014 Hz, two of them 8 Hz apart and 25 dB of level, rendered
under half sines of 0.3 ms; white noise in the sound, SNR from its peak to the noise's rms. At every 0.12 s a strike
falls into the ringing of the last. A mode is found within 2 Hz and half of its decay; the rest are rms errors of those,
and how many of their frequencies, decays and gains lie within two standard errors (wanted: 95).

| strikes | every (s) | SNR (dB) | found of 10 | others | frequency (Hz) | decay (%) | gain (%) | within 2 standard errors (%) |
|---|---|---|---|---|---|---|---|---|
$(< ways.md)

Three strikes 0.6 s apart in noise of 1e-6 of full scale: 20 draws of the noise, against the truth, and the first with
the last bit of 40 of its 80 000 samples flipped, against itself. Wanted: 10 modes each time; errors of one standard
error, changes of a tenth at most.

| what | recordings | refused | with 10 modes | modes | true modes found | frequency, rms (standard errors) | largest |
|---|---|---|---|---|---|---|---|
$(< draws.md)

## Strikes

Channel 1 a microphone, channel 2 the hammer's force, 16 bits, 44.1 kHz; no scales are known, so that levels are
relative. *Explained*: share of a strike's sound that the modes make of its force. Steel's recording is two sets of
strikes (1 to 5 and 6 to 11) that ring differently, as if the place or the microphone had been moved between them.

$(< strikes.md)

What the program says of them:

$(< said.md)

## Modes

Up to 50 of each. *Energy held*: of the sound, in its band. Distances are from the response to what its modes make of it.
Time and memory are GNU time's.

$(< modes.md)

## Strikes that were not fitted

Every other strike is fitted, and predicts the rest (\`--strikes\`). Wanted: nearly as much as when they are fitted too.

$(< apart.md)

The modes of the two halves, which share no strike. In both: nearer than the wider one's half width, decays within a
factor of two. Differences are over the root of the sum of both squared standard errors, of those between strikes and of
those of the fit. Wanted: 95 %.

$(< halves_agree.md)

## The last bits

The last bit of 40 samples flipped, four times: what changes says how far a table is one of the object. *Strong*: the ten
strongest modes of the fit to the recording as it is that are in the others too, within the wider one's half width and a
factor of 1.5 in decay.

$(< flips.md)

## Kinds of linear algebra

Modes, and median decay by energy (1/s), by OpenBLAS's kernels for different CPUs (OPENBLAS_CORETYPE). Wanted: the same.

$(< kinds.md)

## Damping

Median decays (1/s).

$(< order.md)

## The strongest

$(< lines.md)

## Pictures

By \`--plot\`: ![responses, modes and what is left](extract.png)
MD
[ ! -s sheet.png ] || mv sheet.png "${REPORT%.md}.png"
mv report.md "$REPORT"

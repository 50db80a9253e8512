#!/bin/bash
# Makes evidence/accuracy.md: what accuracy costs. Each preset's error on each shipped scene, and the whole tables of five of them and of one on a map that is made here;
# evidence/accuracy.png is the first of these as a picture. RUNS (3) renders of each setting, the least CPU time counts. All takes 40 minutes (10 where nothing else runs); `evidence/accuracy.sh map`
# and `evidence/accuracy.sh rolls` print one table alone.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
RUNS=${RUNS:-3}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
export NO_COLOR=1
cd "$ROOT"

# presets SCENE: a row of the first table
presets() {
    rasp accuracy "scenes/$1.yaml" --presets --runs "$RUNS" --force --csv "$WORK/presets.csv" > /dev/null
    awk -F, -v scene="$1" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $1 != "preset" { next }
        $2 != "reference" { row = row sprintf(" %s |", $at["snr_db"] == "inf" ? "same bits" : $at["snr_db"] == "" ? "-" : sprintf("%.1f", -$at["snr_db"])) }
        { times = times sprintf(" %.3g |", $at["real_time_factor"]) }
        $at["diverges_s"] != "" { until = sprintf("%.2f s", $at["diverges_s"]) }
        END { print "| " scene " |" row times " " (until == "" ? "" : until) " |" }' "$WORK/presets.csv"
}

# table SCENE TITLE [OPTION...]
table() {
    local scene=$1 title=$2
    shift 2
    printf '\n## %s: %s\n\n```text\n' "$title" "$(basename "$scene" .yaml)"
    rasp accuracy "$scene" --runs "$RUNS" "$@"
    printf '```\n'
}

# A circle over 12 mm x 12 mm of planed basswood, which goes on as its mirror image: heights every 12.5 um, between which splines of the plane go.
map() {
    cd "$WORK"
    rasp surface synth --size 12mmx12mm --pitch 12.5um "$ROOT/surfaces/basswood.yaml" map.gsf > /dev/null
    cp "$ROOT/irs/basswood_plank.csv" "$ROOT/irs/pvc_rod.csv" .
    cat > map_circle.yaml <<'YAML'
rasp: 1
surface: {height_map: map.gsf, off_map: mirror, response: basswood_plank.csv, extrapolate: nearest}
scraper: {mass: 8 g, response: pvc_rod.csv, weight: 0.2}
motion: {path: circle, center: [15 cm, 3.7 cm], radius: 5 mm, turns: 3, speed: 6 cm/s}
load: {constant: 0.8 N}
YAML
    table map_circle.yaml "A scrape on a map"
    printf '\nThe map is a gsf of 960 x 960 heights, made by rasp surface synth from surfaces/basswood.yaml; the scene is in evidence/accuracy.sh.\n'
    cd "$ROOT"
}

rolls() { table scenes/roll_coupled.yaml "A ball that rolls over modes, together"; }

case ${1-} in
map | rolls)
    "$1"
    exit
    ;;
esac

{
    cat <<'TEXT'
# What accuracy costs

Made by `evidence/accuracy.sh` with `rasp accuracy` (`man man/rasp-accuracy.1`). Times are of the machine it ran on; errors are the same everywhere.

## The presets

Error in dB below the sound against the preset reference; times real time of one core; for what diverges, from when on (up to there samples are compared).

| scene | draft | standard | high | draft x | standard x | high x | reference x | diverges |
|---|---|---|---|---|---|---|---|---|
TEXT
    for scene in scenes/*.yaml; do presets "$(basename "$scene" .yaml)"; done
    cat <<'TEXT'

The presets aim at 40, 70 and 100 dB; reference is what double precision and the filters give. Scenes that get less, and what stands in the way (by the knob that is alone to blame in
`rasp accuracy SCENE`):

- **round_tip, 49, 49 and 60 dB:** tip_heights, 1, 1, 2 and 4 in the presets, leaves 50, 50, 60 and some 69 dB; oversampling leaves 104 dB or less. In the plane the way of a ball has kinks
  wherever another asperity bears it, and heights on a grid tell where only to first order or two: 10 dB a doubling, at four times the heights. At 8 it renders at 0.18 times real time
  and would leave 80 dB, at more than 10 the heights under the tip (2048 x 2048) do not suffice, so that no preset reaches 100 dB; 2, 4 and 8 would leave 60, 69 and 80 dB at half
  the speed or less, and a reference of 8 would refuse larger tips. So the presets stay, and `accuracy: {error: -80 dB}` takes what is needed. Along a line
  (roll, eccentric_ball) a doubling brings 36 dB, and nothing is missed.
- **scribble, 53, 64 and 96 dB, and recorded, 39, 60 and 97 dB:** oversampling alone. At their fastest, 0.51 and 0.64 m/s, 20 um, the shortest wavelength of their ground, pass at 26 and
  32 kHz, more than half the sample rate: all of that folds at draft, and at standard sub-intervals are still about as long as what they have to average, so that the order is
  0.8 and 1.8; from 4 to 16 it is 2.7 and 3.0. (circle, at 0.30 m/s on the same wavelength, gets 44, 71 and 108 dB.)
- **rubbing, draft, 24 dB:** oversampling: impacts 22.7 us long, one each 22.7 us, are a force that is white beyond half the sample rate, and its means over whole samples fold; the sound is an
  acceleration, which is weighed towards high frequencies. Two sub-intervals leave 58 dB by the pilot runs of accuracy.error.
- **nodal_lines, draft, 32 dB:** oversampling: its limiter has an alpha of 1 cm, so that its force is smoothed over a third of the time that the default of 3 cm gives (with which draft leaves 50 dB), and a ground of
  10 um passes at 20 kHz (of 20 um: 38 dB).
- **material_space, high, 92 dB:** gain_ramp, whose 16 samples leave 91 dB of a glide whose poles move that fast; 8 leave 99 dB.
- **marble_drop** is chaotic, see its table.

One sub-interval is what draft is for, so a scene that needs more says so, or asks for its error.
TEXT
    table scenes/basswood_scrape.yaml "A scrape on procedural roughness" --plot "$WORK/accuracy.png"
    printf '\n![error against speed](accuracy.png)\n'
    table scenes/ridged_profile.yaml "A scrape on a profile"
    map
    table scenes/morphing.yaml "A response that changes on the way"
    rolls
    table scenes/marble_drop.yaml "A ball that bounces on modes, together: chaotic"
} > "$WORK/accuracy.md"
mv "$WORK/accuracy.png" "$WORK/accuracy.md" evidence/

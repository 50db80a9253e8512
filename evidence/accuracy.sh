#!/bin/bash
# Makes evidence/accuracy.md: what accuracy costs, on every shipped scene by `rasp accuracy` as it is called by default, with the CPU time that each took; evidence/accuracy.png is one of these as a
# picture. All takes some four minutes of CPU time. `evidence/accuracy.sh map` prints one table alone, of a scene on a map that is made here.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
export NO_COLOR=1
cd "$ROOT"

# A circle over 12 mm x 12 mm of planed basswood, which goes on as its mirror image: heights every 12.5 um, between which splines of the plane go.
map() {
    cd "$WORK"
    rasp surface synth --size 12mmx12mm --pitch 12.5um "$ROOT/surfaces/basswood.yaml" map.gsf > /dev/null
    cp "$ROOT/irs/basswood_plank.csv" "$ROOT/irs/pvc_rod.csv" .
    cat > map_circle.yaml <<'YAML'
rasp: 1
surface: {height_map: map.gsf, off_map: mirror, response: basswood_plank.csv, extrapolate: nearest}
scraper: {mass: 8 g, response: pvc_rod.csv, weight: 0.2}
motion: {path: circle, center: [15 cm, 0 cm], radius: 5 mm, turns: 3, speed: 6 cm/s}
load: {constant: 0.8 N}
YAML
    table map_circle.yaml
    cd "$ROOT"
}

# table SCENE [OPTION...]: appends the scene's rows to the first two tables, and prints its own
table() {
    local name cpu
    name=$(basename "$1" .yaml)
    TIMEFORMAT='%U %S'
    cpu=$({ time rasp accuracy "$@" --csv "$WORK/$name.csv" > "$WORK/$name.txt"; } 2>&1 | tail -n 1 | awk '{ printf "%.1f", $1 + $2 }')
    printf '\n## %s\n\n```text\n%s\n```\n' "$name" "$(cat "$WORK/$name.txt")"
    awk -F, -v scene="$name" -v cpu="$cpu" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        {
            e = "refused"; x = ""
            if (!$at["exit_code"]) {
                below = $at["below_reference"]
                e = (below ? "<" : "") sprintf("%.0f", -(below ? $at["reference_snr_db"] : $at["snr_db"]))
                if (!below && $at["snr_db"] == "inf") e = "same bits"
                x = sprintf(", x%.3g", $at["real_time_factor"])
            }
        }
        $1 == "asked" { row[$2] = e x }
        $1 == "preset" && $2 != "reference" { presets = presets " " e x " |" }
        { excerpt = $at["excerpt_s"]; until = $at["diverges_s"] }
        END {
            printf "| %s |", scene > "/dev/stderr"
            for (e = -40; e >= -120; e -= 20) printf " %s |", row[e] == "" ? "-" : row[e] > "/dev/stderr"
            if (excerpt != "") excerpt = excerpt " s"
            if (until != "") until = sprintf("%.2f s", until)
            printf "%s %s | %s | %s |\n", presets, excerpt, until, cpu > "/dev/stderr"
        }' "$WORK/$name.csv" 2>> "$WORK/rows"
}

if [ "${1-}" = map ]; then
    map
    exit
fi

for scene in scenes/*.yaml; do
    plot=()
    [ "$scene" != scenes/basswood_scrape.yaml ] || plot=(--plot "$WORK/accuracy.png")
    table "$scene" "${plot[@]}"
    [ ${#plot[@]} = 0 ] || printf '\n![error against time](accuracy.png)\n'
done > "$WORK/tables"
map >> "$WORK/tables"
{
    cat <<'TEXT'
# What accuracy costs

Made by `evidence/accuracy.sh` with `rasp accuracy SCENE` (`man man/rasp-accuracy.1`). Times are of the machine it ran on; knobs, excerpts and errors are the same everywhere.

## All scenes

For each asked error (`accuracy.error`) and preset the measured error in dB, below the sound, and times real time of one core; the excerpt that was taken; for what diverges, from when on (no error can
be asked then, and up to there samples are compared); and the CPU time that the command took for all of it. `-`: not asked, as pilot runs of a round tip in the plane are dear (-70 dB was asked, in its table).
`<`: below what the reference can tell.

| scene | -40 dB | -60 dB | -80 dB | -100 dB | -120 dB | draft | standard | high | excerpt | diverges | CPU (s) |
|---|---|---|---|---|---|---|---|---|---|---|---|
TEXT
    cat "$WORK/rows"
    awk -F'|' '{ if ($13 + 0 > most) { most = $13 + 0; scene = $2 } sum += $13 } END { printf "\nThe longest is%swith %.1f s, all take %.0f s.\n", scene, most, sum }' "$WORK/rows"
    cat <<'TEXT'

Every asked error that could be had is kept. The presets draft, standard and high aim at -40, -70 and -100 dB. Over the whole motion, without excerpts, all three are had on every scene but
marble_drop, which is chaotic (`rasp render SCENE --set accuracy=high --verify`). What is dear, and why:

- **round_tip:** tip_heights. In the plane the way of a ball has kinks wherever another asperity bears it, and heights on a grid tell where only to first order or two: 10 dB a doubling, at four
  times the heights, up to the memory's limit (2048 x 2048). Along a line (roll, eccentric_ball) a doubling brings 36 dB.
- **rubbing:** oversampling: impacts one a sample are a force that is white beyond half the sample rate, and its means over whole samples fold.
- **recorded:** its excerpt is of a beginning that is slower than the rest. 20 um, the shortest wavelength of its ground, pass at 32 kHz at the fastest, so that sub-intervals are about as long as
  what they average.
- **material_space:** gain_ramp, of a glide whose poles move fast.
TEXT
    cat "$WORK/tables"
} > "$WORK/accuracy.md"
mv "$WORK/accuracy.png" "$WORK/accuracy.md" evidence/

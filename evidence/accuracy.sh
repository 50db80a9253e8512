#!/bin/bash
# Makes evidence/accuracy.md: what accuracy costs. Each preset's error on each shipped scene, and the whole tables of four of them; evidence/accuracy.png is the first of these as
# a picture. RUNS (3) renders of each setting, the least CPU time counts.
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
    rasp accuracy "scenes/$1.yaml" --presets --runs "$RUNS" --csv "$WORK/presets.csv" > /dev/null
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
    printf '\n## %s: %s\n\n```text\n' "$title" "$scene"
    rasp accuracy "scenes/$scene.yaml" --runs "$RUNS" "$@"
    printf '```\n'
}

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
    table basswood_scrape "A scrape on a profile" --plot "$WORK/accuracy.png"
    printf '\n![error against speed](accuracy.png)\n'
    table ridged_profile "A scrape on a map"
    table morphing "A response that changes on the way"
    table marble_drop "A ball and the modes under it, together"
} > "$WORK/accuracy.md"
mv "$WORK/accuracy.png" "$WORK/accuracy.md" evidence/

#!/bin/bash
# Makes evidence/effects.md, and the table of README: what each effect of tests/effects/list adds to what runs, and what it costs (about 15 minutes on one core). Needs valgrind.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
export LC_ALL=C
command -v valgrind > /dev/null || { echo "valgrind is not installed: skipped"; exit 0; }
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
. "$ROOT/tests/lib/effects.sh"
RATE=48000
# What runs for each block of samples, and what ends the sound: nothing that reads, chooses or opens. None of these calls another.
COUNTED=()
for name in render_parts_run render_parts_sum render_parts_stem sound_add stems_add sound_finish stems_finish; do
    COUNTED+=("--toggle-collect=$name")
done
ONLY=${ONLY:-.} # of the rows, for trying out
SHORT='^\| (limiter, alpha f|smoothing|round tip|ridges|grit|continuation|response|scraper|glides in place of f|plate in|stems|diagnostics|ball off|ground)'

# count SECONDS [OPTION...]: instructions, as callgrind counts them; the same render is not counted twice.
count() {
    local kept
    effects_scene "$scene" "$1"
    shift
    kept=$WORK/$(echo "$SCENE ${DURATION[*]} $*" | sha256sum | cut -c1-20)
    [ -s "$kept" ] || (cd "$ROOT" && valgrind --tool=callgrind "${COUNTED[@]}" --callgrind-out-file=/dev/null rasp render -q "$SCENE" "${DURATION[@]}" "$@" -o "$WORK/sound.wav") 2>&1 |
        sed -n 's/.*Collected : //p' > "$kept"
    cat "$kept"
}

# per_sample [OPTION...]: of the second 0.2 s; what is run ahead of the first block and what ends the last are not in.
per_sample() {
    local short long
    short=$(count 0.2 "$@")
    long=$(count 0.4 "$@")
    echo $(((long - short) / (RATE / 5)))
}

rows() {
    local effect scene both without with stages files a b
    while IFS='|' read -r effect scene both without with stages files; do
        effects_options "$both" "$without"
        a=$(per_sample "${OPTIONS[@]}")
        effects_options "$both" "$with"
        b=$(per_sample "${OPTIONS[@]}")
        echo "| $effect | $scene | ${without:-.} | $with | $stages | $a | $b | $((b - a)) |"
    done < <(effects_rows | grep -E -- "$ONLY")
}

# How far two counts of one render lie apart, in instructions per sample
repeats() {
    local scene=scrape a b
    a=$(count 0.2)
    rm -f "$WORK"/*
    b=$(count 0.2)
    awk -v a="$a" -v b="$b" -v n=$((RATE / 5)) 'BEGIN { d = a - b; printf "%.2g", (d < 0 ? -d : d) / n }'
}

apart=$(repeats)
rows > "$WORK/rows"
{
    echo '# What each effect costs'
    echo
    echo 'Made by `evidence/effects.sh` from `tests/effects/list`: a short scene (`tests/effects/`) with an effect and without. What an effect is not asked'
    echo 'for is not in the plan (`rasp plan`), and costs nothing. Stages: what the plan gains, and (with a minus) loses; none: a stage that runs anyway has more to do.'
    echo 'That the plans differ by exactly this, and that what lies before an effect and beside it keeps its bits, is tested for each row (`tests/cli/effects.sh`).'
    echo
    echo "Instructions are those of one audio sample at 48 kHz, accuracy standard: callgrind's count of 0.4 s less that of 0.2 s, of what runs block by block (reading a scene and"
    echo "choosing settings are not in). Two counts of the same render lie $apart instructions a sample apart. Valgrind's CPU has AVX2 and no"
    echo 'AVX-512: where that is there, hot loops have up to half the instructions. A count is no time: a division counts as one.'
    echo
    echo '| effect | scene | without | with | stages | instructions without | with | more |'
    echo '|---|---|---|---|---|---|---|---|'
    cat "$WORK/rows"
} > "$WORK/effects.md"
[ "$ONLY" = . ] || { cat "$WORK/effects.md"; exit; }
cp "$WORK/effects.md" "$ROOT/evidence/effects.md"

# The short form
awk -F' *[|] *' '
    BEGIN { print "| effect | stages | instructions a sample without | more |"; print "|---|---|---|---|" }
    { print "| " $2 " | " $6 " | " $7 " | " ($9 > 0 ? "+" : "") $9 " |" }' <(grep -E "$SHORT" "$WORK/rows") > "$WORK/short"
awk -v file="$WORK/short" '
    /^<!-- effects: end -->$/ { inside = 0 }
    !inside { print }
    /^<!-- effects -->$/ { inside = 1; while ((getline line < file) > 0) print line }' "$ROOT/README.md" > "$WORK/README.md"
cmp -s "$WORK/README.md" "$ROOT/README.md" || cat "$WORK/README.md" > "$ROOT/README.md"

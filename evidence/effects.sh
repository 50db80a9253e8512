#!/bin/bash
# Makes evidence/effects.md, evidence/effects.png and the table of README: what each effect of tests/effects/list adds to what runs, and what it costs (about 15 minutes on one core). Needs valgrind.
# `evidence/effects.sh picture` draws the picture alone.
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

# picture: evidence/effects.png from the table: rows of the short form, without and with
picture() {
    awk -F' *[|] *' -v short="$SHORT" '$0 ~ short { print ++n "\t" $2 "\t" $7 "\t" $8 }' "$ROOT/evidence/effects.md" > "$WORK/bars"
    gnuplot << END
set terminal pngcairo size 1100,520 font 'sans,10'
set output '$WORK/effects.png'
set datafile separator '\t'
set grid xtics linewidth 0.5 linecolor rgb '#dddddd'
set ytics scale 0
set yrange [] reverse
set offsets 0, 0, 0.7, 0.7
set lmargin at screen 0.24
set rmargin at screen 0.97
set bmargin at screen 0.11
set tmargin at screen 0.92
set key outside center top horizontal samplen 1
set logscale x
set xrange [1500:70000]
set xtics (2000, 5000, 10000, 20000, 50000)
set xlabel 'instructions for an audio sample'
plot '$WORK/bars' using 3:1:(\$4-\$3):(0):ytic(2) with vectors nohead linewidth 2 linecolor rgb '#bbbbbb' notitle, \
    '' using 3:1 with points pointtype 6 linecolor rgb '#0072b2' title 'without the effect', \
    '' using 4:1 with points pointtype 7 linecolor rgb '#d55e00' title 'with it'
END
    mv "$WORK/effects.png" "$ROOT/evidence/effects.png"
}

if [ "${1-}" = picture ]; then
    picture
    exit
fi

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
    echo 'For a scene of one'"'"'s own: `rasp plan --without --measure SCENE`.'
    echo
    echo "Instructions are those of one audio sample at 48 kHz, accuracy standard: callgrind's count of 0.4 s less that of 0.2 s, of what runs block by block (reading a scene and"
    echo "choosing settings are not in). Two counts of the same render lie $apart instructions a sample apart. Valgrind's CPU has AVX2 and no"
    echo 'AVX-512: where that is there, hot loops have up to half the instructions. A count is no time: a division counts as one.'
    echo
    echo '![instructions for an audio sample without and with some of the effects](effects.png)'
    echo
    echo '| effect | scene | without | with | stages | instructions without | with | more |'
    echo '|---|---|---|---|---|---|---|---|'
    cat "$WORK/rows"
} > "$WORK/effects.md"
[ "$ONLY" = . ] || { cat "$WORK/effects.md"; exit; }
cp "$WORK/effects.md" "$ROOT/evidence/effects.md"
picture

# The short form
awk -F' *[|] *' '
    BEGIN { print "| effect | stages | instructions a sample without | more |"; print "|---|---|---|---|" }
    { print "| " $2 " | " $6 " | " $7 " | " ($9 > 0 ? "+" : "") $9 " |" }' <(grep -E "$SHORT" "$WORK/rows") > "$WORK/short"
awk -v file="$WORK/short" '
    /^<!-- effects: end -->$/ { inside = 0 }
    !inside { print }
    /^<!-- effects -->$/ { inside = 1; while ((getline line < file) > 0) print line }' "$ROOT/README.md" > "$WORK/README.md"
cmp -s "$WORK/README.md" "$ROOT/README.md" || cat "$WORK/README.md" > "$ROOT/README.md"

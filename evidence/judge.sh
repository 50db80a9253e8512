#!/bin/bash
# Makes evidence/judge.md: experiment 2 of Agarwal et al. 2021 with a program as the listener (rasp judge listen), its confusion matrices and equation 14, for
# three sources of templates: the full model with other seeds, another condition, and recordings where somebody has them.
# SEEDS ("1 2 3 4 5") are judged; TAKES ("101 102 103") are the templates' seeds; OTHER (only_surface): the other condition; RECORDINGS=TABLE.csv (file_name,
# motion); SETS=DIR keeps the rendered sets (else they go); JOBS. About 12 minutes on two cores.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
SEEDS=${SEEDS:-1 2 3 4 5} TAKES=${TAKES:-101 102 103} OTHER=${OTHER:-only_surface}
export LC_ALL=C PATH=$BUILD:$PATH
make -C "$ROOT" -s BUILD="$BUILD" "$BUILD/rasp"
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
SETS=$(realpath -m "${SETS:-$WORK/sets}")
mkdir -p "$SETS"

# The design with another seed; relative names in it start at its folder.
for seed in $SEEDS $TAKES; do
    sed -e "s#^seed: .*#seed: $seed#" -e "s#\.\./\.\./#$ROOT/#g" -e "s#^base: #base: $ROOT/scenes/experiments/#" \
        "$ROOT/scenes/experiments/000_experiment_2.yaml" > "$SETS/seed_$seed.yaml"
    nice rasp batch "$SETS/seed_$seed.yaml" -o "$SETS/seed_$seed" --jobs "${JOBS:-$(nproc)}" > /dev/null
done

takes=() other=() kind=()
for seed in $TAKES; do
    takes+=(--templates "$SETS/seed_$seed")
done

# listen SOURCE NAME OPTION...: each seed by these templates, into SOURCE_SEED.csv, and the spread and errors of the nearest template.
listen() {
    local source=$1 seed
    shift
    for seed in $SEEDS; do
        rasp judge listen "$SETS/seed_$seed" "$@" -o "$WORK/${source}_$seed.csv" > "$WORK/${source}_$seed.txt"
    done
}

# means SOURCE REFERENCE: a row a condition; equation 14 of each seed, against REFERENCE_SEED.csv's matrix (of its condition full, or the only one).
means() {
    local seed
    for seed in $SEEDS; do
        local reference=$WORK/$2_$seed.csv pick=(--reference full)
        [ -e "$reference" ] || { reference=$WORK/$2.csv && pick=(); }
        rasp judge similarity "$reference" "$WORK/$1_$seed.csv" "${pick[@]}" --json > "$WORK/similarity.json"
        rasp judge choices "$WORK/$1_$seed.csv" --json > "$WORK/choices.json"
        python3 - "$WORK" "$1_$seed.csv" << 'END_PYTHON'
import json, os, sys
work, name = sys.argv[1:]
right = {c["condition"]: c["right_mean_of_rows"] for c in json.load(open(work + "/choices.json"))["conditions"]}
for c in json.load(open(work + "/similarity.json"))["compared"]:
    if os.path.basename(c["file"]) == name:
        print(c["condition"], c["spectral"], c["frobenius"], 100 * right[c["condition"]])
END_PYTHON
    done | awk -v says="full=highest only_surface=performs_similarly_to_the_full_model constant_force=greatly_decrease no_nonlinearity=greatly_decrease physical=below_the_full_model signal=below_the_full_model noise=below_the_full_model" '
        BEGIN { n = split(says, word, " "); for (i = 1; i <= n; i++) { split(word[i], pair, "="); gsub(/_/, " ", pair[2]); paper[pair[1]] = pair[2] }
            print "| condition | eq. 14, spectral: mean | least to most | Frobenius | right, % | what 000 says |"; print "|---|---|---|---|---|---|" }
        !($1 in count) { order[++rows] = $1; low[$1] = $2; high[$1] = $2 }
        { count[$1]++; spectral[$1] += $2; frobenius[$1] += $3; right[$1] += $4; if ($2 < low[$1]) low[$1] = $2; if ($2 > high[$1]) high[$1] = $2 }
        END { for (i = 1; i <= rows; i++) { c = order[i]; n = count[c]
            printf "| %s | %.2f | %.2f to %.2f | %.2f | %.0f | %s |\n", c, spectral[c] / n, low[c], high[c], frobenius[c] / n, right[c] / n, paper[c] } }'
}

# The matrix that stands for C_recorded: the templates themselves, each judged without itself.
own() {
    local source=$1 first=$2
    shift 2
    rasp judge listen "$first" "$@" -o "$WORK/$source.csv" > "$WORK/$source.txt"
}

{
    echo '# A program that listens: experiment 2 of Agarwal et al. 2021'
    echo
    echo "Made by \`evidence/judge.sh\`. Judged: \`scenes/experiments/000_experiment_2.yaml\`, seeds $SEEDS; templates: seeds $TAKES."
    echo 'The listener (`src/analysis/listener.c`) is ours and knows level and brightness over time; the paper'"'"'s were 41 people, and its figures are pictures:'
    echo 'only its words can be laid beside. `C_recorded` of equation 14 is a matrix of templates, each judged without itself: recordings where there are any,'
    echo 'else a stand-in, which favours the condition that the stand-in is of.'
    echo
    echo '## Templates: the full model with other seeds'
    echo
    first=${TAKES%% *}
    listen full "${takes[@]}" --where condition=full
    head -q -n 1 "$WORK"/full_*.txt | sed -e "s#$SETS/##" -e 's/^/    /'
    echo
    # the takes of the full model alone, as a table of their own
    { echo file_name,motion,condition; for seed in $TAKES; do awk -F, -v dir="$SETS/seed_$seed/" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["condition"] == "full" { print dir $at["file_name"] "," $at["motion"] ",full" }' "$SETS/seed_$seed/manifest.csv"; done; } > "$WORK/takes_full.csv"
    own reference_full "$WORK/takes_full.csv" --templates "$WORK/takes_full.csv"
    means full reference_full
    echo
    echo "Matrices of seed ${SEEDS%% *} (rows: played; columns: chosen, %):"
    echo
    sed -e '1d' -e 's/^/    /' -e 's/ *$//' "$WORK/full_${SEEDS%% *}.txt"
    echo
    echo "## Templates: the condition $OTHER with other seeds"
    echo
    listen other "${takes[@]}" --where "condition=$OTHER"
    sed "s/,full\$/,$OTHER/; s#/full\.#/$OTHER.#" "$WORK/takes_full.csv" > "$WORK/takes_other.csv"
    own reference_other "$WORK/takes_other.csv" --templates "$WORK/takes_other.csv"
    means other reference_other
    echo
    echo '## Templates: recordings'
    echo
    if [ -n "${RECORDINGS:-}" ]; then
        listen recorded --templates "$RECORDINGS"
        own reference_recorded "$RECORDINGS" --templates "$RECORDINGS"
        means recorded reference_recorded
    else
        echo 'None were at hand: `RECORDINGS=TABLE.csv evidence/judge.sh` takes a table of them (file_name, motion; two takes of each motion at least).'
    fi
} > "$WORK/report.md"
cat "$WORK/report.md" > "$ROOT/evidence/judge.md"

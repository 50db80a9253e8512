#!/bin/bash
# Makes evidence/judge.md: experiment 2 of Agarwal et al. 2021 with a program as the listener (rasp judge listen), its confusion matrices and equation 14, for
# three sources of templates: the full model with other seeds, another condition, and recordings where somebody has them; and the materials of Ren et al. 2013.
# SEEDS ("1 2 3 4 5") are judged; TAKES ("101 102 103") are the templates' seeds; OTHER ("only_surface constant_force"): other conditions; RECORDINGS=TABLE.csv (file_name,
# motion); SETS=DIR keeps the rendered sets, and takes those that are there; JOBS. About five minutes of
# one core.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
SEEDS=${SEEDS:-1 2 3 4 5} TAKES=${TAKES:-101 102 103} OTHER=${OTHER:-only_surface constant_force}
export LC_ALL=C PATH=$BUILD:$PATH
make -C "$ROOT" -s BUILD="$BUILD" "$BUILD/rasp"
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
SETS=$(realpath -m "${SETS:-$WORK/sets}")
mkdir -p "$SETS"

# The design with another seed; relative names in it start at its folder.
for seed in $SEEDS $TAKES; do
    [ ! -e "$SETS/seed_$seed/manifest.csv" ] || continue
    sed -e "s#^seed: .*#seed: $seed#" -e "s#\.\./\.\./#$ROOT/#g" -e "s#^base: #base: $ROOT/scenes/experiments/#" \
        "$ROOT/scenes/experiments/000_experiment_2.yaml" > "$SETS/seed_$seed.yaml"
    nice rasp batch "$SETS/seed_$seed.yaml" -o "$SETS/seed_$seed" --jobs "${JOBS:-$(nproc)}" > /dev/null
done

for design in experiments/003_materials designs/struck_materials; do
    [ -e "$SETS/${design#*/}/manifest.csv" ] || nice rasp batch "$ROOT/scenes/$design.yaml" -o "$SETS/${design#*/}" --quiet 2> /dev/null
done

takes=()
for seed in $TAKES; do
    takes+=(--templates "$SETS/seed_$seed")
done

# listen SOURCE OPTION...: each seed by these templates, into SOURCE_SEED.csv; what is printed into SOURCE_SEED.txt.
listen() {
    local source=$1 seed
    shift
    for seed in $SEEDS; do
        rasp judge listen "$SETS/seed_$seed" "$@" -o "$WORK/${source}_$seed.csv" > "$WORK/${source}_$seed.txt"
    done
}

# means SOURCE REFERENCE: a row a condition, the mean of seeds; equation 14 against the matrix of REFERENCE.csv.
means() {
    local seed
    for seed in $SEEDS; do
        rasp judge similarity "$WORK/$2.csv" "$WORK/$1_$seed.csv" --json > "$WORK/similarity.json"
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
        function beside(c, d) { d = (spectral[c] - spectral["full"]) / n; return "`" c "` is " (d < 0 ? "below" : "above") sprintf(" the full model by %.2f", d < 0 ? -d : d) }
        END { for (i = 1; i <= rows; i++) { c = order[i]; n = count[c]
                printf "| %s | %.2f | %.2f to %.2f | %.2f | %.0f | %s |\n", c, spectral[c] / n, low[c], high[c], frobenius[c] / n, right[c] / n, paper[c] }
            print "\n000 has both below it: " beside("constant_force") ", " beside("no_nonlinearity") \
                (spectral["constant_force"] < spectral["full"] ? "." : "; by the templates of a constant force its own sounds are the nearest, so that 000'"'"'s order does not come out of these.") }'
}

# own NAME TABLE: the matrix that stands for C_recorded, of templates, each judged without itself, into NAME.csv.
own() { rasp judge listen "$2" --templates "$2" -o "$WORK/$1.csv" > /dev/null; }

# materials CUE: 003's sounds by objects of other shapes, into materials_CUE.csv; a row: right, and how like each of the paper's tables that is.
study=$ROOT/scenes/answers/003_study.csv
materials() {
    rasp judge listen "$SETS/003_materials" --templates "$SETS/struck_materials" --factor material --by "$1" -o "$WORK/materials_$1.csv" > "$WORK/materials_$1.txt"
    for reference in recorded synthesised; do
        rasp judge similarity "$study" "$WORK/materials_$1.csv" --reference $reference --json > "$WORK/like_$reference.json"
    done
    rasp judge choices "$study" --json > "$WORK/study.json"
    rasp judge choices "$WORK/materials_$1.csv" --json > "$WORK/choices.json"
    python3 - "$WORK" "$1" << 'END_PYTHON'
import json, sys
work, cue = sys.argv[1:]
told = {"motion": "level and brightness over time", "material": "how fast it fades, how bright it is"}
like = {r: json.load(open(f"{work}/like_{r}.json"))["compared"] for r in ("recorded", "synthesised")}
of = lambda r, at: "%.2f, %.2f" % (like[r][at]["spectral"], like[r][at]["frobenius"])
right = lambda name, of: [100 * c["right_mean_of_rows"] for c in json.load(open(f"{work}/{name}.json"))["conditions"] if c["condition"] == of][0]
if cue == "motion": print(f"| 003's listeners, synthesised sounds | {right('study', 'synthesised'):.0f} | {of('recorded', 0)} | - |")
print(f"| the program, by {told[cue]} | {right('choices', 'synthesised'):.0f} | {of('recorded', 1)} | {of('synthesised', 1)} |")
END_PYTHON
}

{
    echo '# A program that listens: experiment 2 of Agarwal et al. 2021, and the materials of Ren et al. 2013'
    echo
    echo "Made by \`evidence/judge.sh\`. Judged: \`scenes/experiments/000_experiment_2.yaml\`, seeds $SEEDS; templates: seeds $TAKES."
    echo 'The listener (`src/analysis/machine_listener.c`) is ours and knows level and brightness over time (of materials, how fast a sound fades and how bright it is); 000'"'"'s were 41 people, and its figures are pictures:'
    echo 'only its words can be laid beside. `C_recorded` of equation 14 is a matrix of templates, each judged without itself: recordings where there are any,'
    echo 'else a stand-in, which favours the condition that the stand-in is of. The scribble is drawn from each seed, so that its templates are other scribbles.'
    echo
    echo '## Templates: the full model with other seeds'
    echo
    listen full "${takes[@]}" --where condition=full
    head -q -n 1 "$WORK"/full_*.txt | sed -e "s#$SETS/##" -e 's/^/    /'
    echo
    # the takes of the full model alone, as a table of their own
    { echo file_name,motion,condition; for seed in $TAKES; do awk -F, -v dir="$SETS/seed_$seed/" 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } $at["condition"] == "full" { print dir $at["file_name"] "," $at["motion"] ",full" }' "$SETS/seed_$seed/manifest.csv"; done; } > "$WORK/takes_full.csv"
    own reference_full "$WORK/takes_full.csv"
    means full reference_full
    echo
    echo "Matrices of seed ${SEEDS%% *} (rows: played; columns: chosen, %):"
    echo
    sed -e '1,2d' -e 's/^/    /' -e 's/ *$//' "$WORK/full_${SEEDS%% *}.txt"
    echo
    for other in $OTHER; do
        echo "## Templates: the condition $other with other seeds"
        echo
        listen "$other" "${takes[@]}" --where "condition=$other"
        sed "s/,full\$/,$other/; s#/full\.#/$other.#" "$WORK/takes_full.csv" > "$WORK/takes_$other.csv"
        own "reference_$other" "$WORK/takes_$other.csv"
        means "$other" "reference_$other"
        echo
    done
    echo '## Templates: recordings'
    echo
    if [ -n "${RECORDINGS:-}" ]; then
        listen recorded --templates "$RECORDINGS"
        own reference_recorded "$RECORDINGS"
        means recorded reference_recorded
    else
        echo 'None were at hand: `RECORDINGS=TABLE.csv evidence/judge.sh` takes a table of them (file_name, motion; two takes of each motion at least).'
    fi
    cat << 'END'

## Materials: section F of Ren et al. 2013

Judged: `scenes/experiments/003_materials.yaml`, 16 strikes on objects of fitted materials. Templates: `scenes/designs/struck_materials.yaml`, two plates and a bar of
each material, of rasp's own table of materials: no object and no law of damping is in both. The tables of 003 are `scenes/answers/003_study.csv`; how alike
what its listeners said of recorded and of synthesised sounds is (a number that 003 does not print) is what a program may be measured by.

| who | right, % | like 003's recorded: eq. 14, spectral, Frobenius | like 003's synthesised |
|---|---|---|---|
END
    materials motion
    materials material
    cat << 'END'

By how fast they fade and how bright they are wood is taken for plastic and porcelain for glass, as by listeners; and metal for glass, which they do less often: at 5 kHz the fitted
metal fades by 11 1/s, rasp's steel by 4 and its glass by 16. Neither pair of features comes as near to listeners as their two tables are to each other.

END
    for cue in motion material; do
        echo "By $cue (\`--by $cue\`; rows: played; columns: chosen, %):"
        echo
        sed -e 's/^/    /' -e "s#$SETS/##" -e 's/ *$//' "$WORK/materials_$cue.txt"
        echo
    done
} > "$WORK/report.md"
cat "$WORK/report.md" > "$ROOT/evidence/judge.md"

#!/bin/bash
# Makes evidence/batch.md: sets of stimuli from one command. To be run on a machine that does nothing else. What it takes is set by
#   MANY    two-second stimuli of a run that is timed
#   WHOLE   of the one great set (10000; 4 GB on the disk for some minutes)
#   SIZES   sets of which the memory is measured
#   KILLS   how often experiment 1 is killed
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
MANY=${MANY:-200}
WHOLE=${WHOLE:-10000}
SIZES=${SIZES:-100 1000 10000}
KILLS=${KILLS:-10}
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
EXPERIMENT=${EXPERIMENT:-$ROOT/scenes/experiments/000_experiment_1.yaml}

# measured COMMAND...: wall clock (s), CPU time (s), greatest memory (kB).
measured() {
    python3 -c '
import resource, subprocess, sys, time
start = time.monotonic()
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL)
wall, r = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
print(round(wall, 2), round(r.ru_utime + r.ru_stime, 2), r.ru_maxrss)' "$@"
}

# same A B: all files that SHA256SUMS names, the sums and the tables have the same bytes.
same() { (cd "$2" && sha256sum --quiet -c SHA256SUMS > /dev/null) && cmp -s "$1/SHA256SUMS" "$2/SHA256SUMS" && echo "the same bytes" || echo "OTHER BYTES"; }

# ------------------------------------------------------------------ experiment 1

killed() {
    local longest=$1 left=0
    RANDOM=1
    for _ in $(seq "$KILLS"); do
        timeout -s KILL "$(awk -v r=$RANDOM -v t="$longest" 'BEGIN { printf "%.3f", 0.02 + t * r / 32768 }')" rasp batch "$EXPERIMENT" -o killed -j 2 -q > /dev/null 2>&1 || left=$((left + 1))
    done 2> /dev/null
    rasp batch "$EXPERIMENT" -o killed -j 2 -q
    echo "| killed at $left random moments, then run to its end | | | $(same one killed) |"
}

experiment() {
    local one two
    read -r -a one < <(measured rasp batch "$EXPERIMENT" -o one -j 1 -q)
    read -r -a two < <(measured rasp batch "$EXPERIMENT" -o two -j 2 -q)
    echo '| | wall clock (s) | CPU time (s) | SHA256SUMS against -j 1 |'
    echo '|---|---|---|---|'
    echo "| -j 1 | ${one[0]} | ${one[1]} | |"
    echo "| -j 2 | ${two[0]} | ${two[1]} | $(same one two) |"
    for i in 3 7 1 5 2 6 4; do
        rasp batch "$EXPERIMENT" -o parts --shard $i/7 -q > /dev/null
    done
    rasp batch "$EXPERIMENT" -o parts -q --no-render
    echo "| seven shards, joined | | | $(same one parts) |"
    killed "$(awk -v t="${two[0]}" -v n="$KILLS" 'BEGIN { print 2 * t / (n + 2) }')"
    read -r -a two < <(measured rasp batch "$EXPERIMENT" -o two -j 2 -q)
    echo "| -j 2 once more, nothing to do | ${two[0]} | ${two[1]} | $(same one two) |"
    STIMULI=$(($(wc -l < one/manifest.csv) - 1))
    SOUND=$(python3 -c 'import csv; print(round(sum(float(r["duration_s"]) for r in csv.DictReader(open("one/manifest.csv")))))')
}

# ------------------------------------------------------------------ many

# design N SCENE KEYS: N stimuli of two motions; each is of a cell of its own up to half of them.
design() {
    cat << YAML
rasp-design: 1
base: $2
seed: 1
set: {$3}
factors:
  motion.rate: [$(seq -s ', ' -f '%g Hz' 1 "$(awk -v n="$1" 'BEGIN { print 1.5 / (n / 2 - 1) }')" 2.5)]
replicates: 2
level: {common: {full_scale: $4}}
length: 2 s
YAML
}

cpu_of_renders() { python3 -c 'import csv, sys; print(sum(float(r["cpu_s"]) for r in csv.DictReader(open(sys.argv[1]))))' "$1/timings.csv"; }

rates() {
    echo '| scene, accuracy | stimuli | per second, one core | two cores | CPU of a stimulus (ms) | of this: rendering | all else |'
    echo '|---|---|---|---|---|---|---|'
    while read -r scene accuracy scale; do
        design "$MANY" "$ROOT/scenes/$scene.yaml" "accuracy: $accuracy, motion.duration: 2 s, output.tail: 0 s, output.diagnostics.rate: 1 kHz" "$scale" > many.yaml
        rm -rf many
        local one two
        read -r -a one < <(measured rasp batch many.yaml -o many -j 1 -q)
        local n renders
        n=$(($(wc -l < many/manifest.csv) - 1))
        renders=$(cpu_of_renders many)
        rm -rf many
        read -r -a two < <(measured rasp batch many.yaml -o many -j 2 -q)
        awk -v scene="$scene, $accuracy" -v n="$n" -v a="${one[0]}" -v b="${two[0]}" -v cpu="${one[1]}" -v r="$renders" \
            'BEGIN { printf "| %s | %d | %.1f | %.1f | %.2f | %.2f | %.2f |\n", scene, n, n / a, n / b, 1000 * cpu / n, 1000 * r / n, 1000 * (cpu - r) / n }'
    done << 'SCENES'
paper_force draft 4
basswood_scrape draft 1
basswood_scrape standard 1
SCENES
}

# $WHOLE of basswood_scrape at draft on two cores, beside 100 of them.
whole() {
    echo '| stimuli | wall clock (s) | per second | CPU of a stimulus (ms) | greatest memory (MB) | sound (GB) |'
    echo '|---|---|---|---|---|---|'
    for n in 100 "$WHOLE"; do
        design "$n" "$ROOT/scenes/basswood_scrape.yaml" "accuracy: draft, motion.duration: 2 s, output.tail: 0 s, output.diagnostics.rate: 1 kHz" 1 > whole.yaml
        rm -rf whole
        local r
        read -r -a r < <(measured rasp batch whole.yaml -o whole -j 2 -q)
        (cd whole && sha256sum --quiet -c SHA256SUMS)
        awk -v n="$(($(wc -l < whole/manifest.csv) - 1))" -v t="${r[0]}" -v cpu="${r[1]}" -v m="${r[2]}" -v kb="$(cat whole/*.wav | wc -c)" \
            'BEGIN { printf "| %d | %.1f | %.1f | %.2f | %.1f | %.2f |\n", n, t, n / t, 1000 * cpu / n, m / 1024, kb / 1e9 }'
    done
    rm -rf whole
}

memory() {
    echo '| stimuli | level | greatest memory (MB) | again, all there (MB) |'
    echo '|---|---|---|---|'
    cat > tiny.yaml << YAML
rasp: 1
surface: {roughness: {exponent: -2.4, rms: 5 um, longest: 2 mm, shortest: 50 um}, response: $ROOT/irs/pvc_rod.csv}
scraper: {mass: 20 g}
motion: {path: line, to: [1 cm, 0], duration: 20 ms}
accuracy: draft
output: {tail: 0 s, ramp: 1 ms}
YAML
    for level in 'full_scale: 1' 'peak: -3 dB'; do
        for n in $SIZES; do
            printf '%s\n' 'rasp-design: 1' 'base: tiny.yaml' 'factors: {scraper.mass: [20 g, 30 g]}' "replicates: $((n / 2))" "level: {common: {$level}}" > tiny_set.yaml
            rm -rf tiny
            local first again
            read -r -a first < <(measured rasp batch tiny_set.yaml -o tiny -j 2 -q)
            read -r -a again < <(measured rasp batch tiny_set.yaml -o tiny -j 2 -q)
            awk -v n="$n" -v level="$level" -v a="${first[2]}" -v b="${again[2]}" 'BEGIN { printf "| %d | %s | %.1f | %.1f |\n", n, level, a / 1024, b / 1024 }'
        done
    done
}

if [ "${1-}" = whole ]; then
    whole
    exit
fi
experiment > experiment.txt
cat > batch.md << EOF
# Sets of stimuli from one command

Made by \`make evidence\` (evidence/batch.sh), on $(nproc) cores. Times are of one run, and move with the machine's neighbours.

## Experiment 1 of Agarwal et al. (2021): $STIMULI stimuli, $SOUND s of sound

$(cat experiment.txt)

## Many two-second stimuli

$MANY stimuli a run, each with a WAV and a table of forces at 1 kHz, half of them cells of their own, the gain known beforehand. The goal was 300 a second on one core and 520
on two. It counted on 3.3 ms for a stimulus, which is 35 ns a sample for all of it; what rendering takes is most of it, as the table shows, but all else
alone is more than that, too: it is reading and checking the scene, planning its cell before anything is rendered, measuring (true peaks alone take 2.7 ms) and hashing what was written, the records and the tables.

$(rates)

The whole set (\`evidence/batch.sh whole\` prints it alone), -j 2, its sums checked behind it. Half of the stimuli are cells of their own, with levels, labels and what these set: of each stimulus 1.3 kB stay, where there are replicates alone 0.2 kB (below); nothing else grows:

$(whole)

## Memory

Stimuli of 20 ms; how long a sound is does not matter, as it is made in blocks. What grows with the set is the list of its stimuli: names, values of factors, seeds.

$(memory)
EOF
cp batch.md "$ROOT/evidence/batch.md"

#!/bin/bash
# Makes evidence/papers.md and its pictures: for each experiment, figure, table and equation of the papers what they print, what rasp gives, and the command. About
# six minutes of one core; SETS=FOLDER keeps the rendered sets for the next time. Needs python3 and gnuplot.
#     evidence/papers.sh
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
export LC_ALL=C
command -v gnuplot > /dev/null || { echo "gnuplot is not installed: skipped"; exit 0; }
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
SETS=${SETS:-$WORK}
cd "$ROOT"
render() { rasp render -q "$@" 2> /dev/null; }
row() { echo "| $1 | $2 | $3 | $4 |"; }
default() { rasp explain "$1" | sed -n 's/^ *default *//p'; }
counted() { rasp batch "scenes/experiments/$1.yaml" -o "$WORK/none" --dry-run 2> /dev/null | tail -n 1 | cut -d, -f1; }
scenes() { echo "$(find "scenes/experiments/$1" -maxdepth 1 -name '*.yaml' | wc -l) scenes"; }
number() { python3 -c "import json; d = json.load(open('$1')); print('%.3g' % ($2))"; }
# per_row TABLE AWK: awk over a table's rows by the columns' order
per_row() { awk -F, "NR > 1 { $2 } END { $3 }" "$1"; }

# asked DESIGN LISTENERS: its lists for so many, and what is in the first of each session
asked() {
    rasp export "scenes/experiments/$1.yaml" "$SETS/$1" --for psychopy -o "$WORK/asked_$1" --participants "$2" > /dev/null 2>&1
    python3 - "$WORK/asked_$1" << 'END'
import csv, glob, sys
lists = [list(csv.DictReader(open(f))) for f in sorted(glob.glob(sys.argv[1] + "/conditions_*.csv"))]
sessions = len({r["session"] for l in lists for r in l})
training = sum(r["training"] == "1" for r in lists[0])
sounds = sum(k.startswith("file_") for k in lists[0][0])
print(f"{len(lists) // sessions} listeners: " + (f"{sessions} sessions of " if sessions > 1 else "") + f"{len(lists[0]) - training} trials of {sounds} sound" + "s" * (sounds > 1)
      + (f", {training} before them for training" if training else ""))
END
    rm -r "$WORK/asked_$1"
}

# degrees FIGURES.json NAME...: F's degrees of freedom
degrees() {
    python3 -c 'import json, sys
of = {p["figure"]: p["ours"] for p in json.load(open(sys.argv[1]))["paper"]}
print("%d listeners: " % of["listeners"] + ", ".join("F(%d, %d) of %s" % (of["df(%s)" % n], of["df_error(%s)" % n], n.replace(":", " x ")) for n in sys.argv[2:]))' "$@"
}

for design in 000_experiment_1 000_experiment_2 000_experiment_3 002_rolling 002_controls 003_materials 004_continuum; do
    [ -s "$SETS/$design/manifest.csv" ] || rasp batch "scenes/experiments/$design.yaml" -o "$SETS/$design" --quiet 2> /dev/null
done
# Answers that are drawn, as in the tests of rasp judge: the study's size is the paper's, its figures are nobody's.
. tests/cli/judge-make.inc
ratings > "$WORK/ratings.csv"
rasp judge ratings "$WORK/ratings.csv" --factors resonator,surface,kappa,mu --paper evidence/papers.csv --item 002_III --json > "$WORK/ratings.json"
pairs > "$WORK/pairs.csv"
rasp judge pairs "$WORK/pairs.csv" --paper evidence/papers.csv --item 002_VI --json > "$WORK/pairs.json"
rasp judge choices scenes/answers/003_study.csv --paper evidence/papers.csv --item 003_F --json > "$WORK/study.json"
rasp judge similarity scenes/answers/003_study.csv --reference recorded --json > "$WORK/like.json"
render scenes/limited_trajectory.yaml -o "$WORK/figure_2.wav"
rasp plot "$WORK/figure_2.wav" -o evidence/papers_trajectory.png -f png --force --panels trajectory --from 0.03 --to 0.06 --title 'papers/000, figure 2' > /dev/null
for what in scratching rubbing; do
    render scenes/$what.yaml -o "$WORK/$what.wav"
    rasp plot "$WORK/$what.wav" -o evidence/papers_$what.png --force --panels waveform --from 0.3 --to 0.42 --title "papers/004, figure 2: $what" > /dev/null
done
# Of 2 Hz, 6 cm to and fro: omega^2 L = 4.737 m/s^2 at the ends.
cat > "$WORK/grip.yaml" << 'END'
rasp: 1
surface: {roughness: {}}
scraper: {mass: 20 g}
motion: {path: back_and_forth, to: [6 cm, 0], rate: 2 Hz, duration: 1 s}
grip: {angle: 30 deg, friction: 0.3}
load: {approach: 0, release: 0}
output: {quantity: force, diagnostics: {rate: 2 kHz, columns: [normal_force_n, alpha_m]}}
END
render "$WORK/grip.yaml" -o "$WORK/grip.wav"
extremes=$(per_row "$WORK/grip.csv" 'if (NR == 2 || $1 > most) most = $1; if (NR == 2 || $1 < least) least = $1' \
    'a = 4 * 3.14159265358979 ^ 2 * 4 * 0.03; t = 0.577350269189626; m = 0.02 / (1 - 0.3 * t); x = most / (m * (9.80665 + a * t)) - 1; y = least / (m * (9.80665 - a * t)) - 1
    x = x < 0 ? -x : x; y = y < 0 ? -y : y; printf("both within %.1g of the formulas", (x > y ? x : y))')
alpha=$(per_row "$WORK/grip.csv" 'n[NR] = $1; a[NR] = $2; if (NR == 2 || $1 > most) most = $1; if (NR == 2 || $1 < least) least = $1' \
    'for (i = 2; i <= NR; i++) { nu = ((n[i] - least) / (most - least)) ^ 0.95; d = ((1 - nu) * 0.05 + nu * 0.01) / a[i] - 1; d = d < 0 ? -d : d; if (d > worst) worst = d } printf "each row within %.1g", worst')
render scenes/stoelinga_chaigne.yaml -o "$WORK/plate.wav" --set output.diagnostics='{rate: 2 kHz, columns: [energy_j, energy_residual_j, contact_loss_j, mode_loss_j]}'
plate=$(per_row "$WORK/plate.csv" 'e = $1 > e ? $1 : -$1 > e ? -$1 : e; r = $4 > r ? $4 : -$4 > r ? -$4 : r; c = $2; m = $3' \
    'printf "energy balances to %.1g of its greatest; lost in the contact %.1g J, in the plate %.2g J", r / e, c, m')

{
    cat << END
# The papers' experiments, figures, tables and equations, beside rasp's

Made by \`evidence/papers.sh\` with $(rasp --version | head -n 1). 000 is Agarwal et al. 2021, 002 and 004 Conan et al. 2014 (TASLP and CMJ), 003 Ren et al. 2013. What listeners said (000, figures 4B, 5C, 5D and 7B; 002, sections III-D and
VI-D; 003, tables 1 and 2; 004, figure 3's curve) is not here: no program gives it by itself.

## 000

| item | the paper prints | rasp gives | command |
|---|---|---|---|
END
    row 'eq. 1 to 3, the force' 'f_v = m S_tt; f_h = beta1 \|v S_s\|^beta2' 'as printed, or as one derivative along the path: `evidence/force.md`' '`--set contact.force=paper`, `directional`'
    row 'beta1, beta2' '0.05, 1' "$(default contact.beta1), $(default contact.beta2)" '`rasp explain contact.beta1`'
    row 'eq. 4 to 7, alpha(N)' '(1 - nu) alpha_max + nu alpha_min' "$alpha" '`rasp render`, column alpha_m'
    row 'zeta, alpha_max, alpha_min' '0.95, 0.05, 0.01' "$(default contact.limiter.zeta), $(default contact.limiter.alpha_max), $(default contact.limiter.alpha_min)" '`rasp explain contact.limiter`'
    row 'smoothing' 'half a window of 5 samples at 44.1 kHz' "$(default contact.smoothing)" '`rasp explain contact.smoothing`'
    row 'figure 2' 'more force, a more extreme way' 'below' '`rasp plot --panels trajectory`, `scenes/limited_trajectory.yaml`'
    row 'eq. 8, 9, figure 3' 'N at the ends' "$extremes" '`rasp render`, column normal_force_n'
    row 'section 2.4, A_i(t), 50 modes' 'sinusoidal modelling' "$(default surface.modes) modes; amplitude and phase of each mode over time" '`rasp modes extract RECORDING --envelopes FALL.csv`'
    row 'eq. 10 to 13' 'a response for each place' '`evidence/responses.md`' '`--set surface.moving=readout` and others'
    row 'eq. 15 to 19' 'a ball that follows S' 'as printed, or as Newton has it: `src/README.md`' '`--set contact.roll.penetration=paper`, `contact.roll.follows=point`, `load.phase=falling`'
    row 'experiment 1' '30 trials of 7 sounds' "$(counted 000_experiment_1)" '`rasp batch scenes/experiments/000_experiment_1.yaml -o out`'
    row 'experiment 2' '5 motions, 7 methods and recordings' "$(counted 000_experiment_2), 40 with recordings" '`rasp batch scenes/experiments/000_experiment_2.yaml -o out`'
    row 'experiment 3' '18 trials of 7 sounds' "$(counted 000_experiment_3)" '`rasp batch scenes/experiments/000_experiment_3.yaml -o out`'
    cat << 'END'

![figure 2](papers_trajectory.png)

The three experiments: what they are like, before anybody listens. The gain says how loud the force was: without the non-linearity it is "unrealistically high", and the sound brighter, "unrealistically rough".
"Our model" is `full`; `physical`, `signal`, `noise`, `coupled` are the paper's baselines, of which it prints names (the designs' heads say what is ours). `physical` has no cross-faded responses: these planks have the same poles everywhere.

END
    for n in 1 2 3; do
        printf 'Experiment %s:\n\n' $n
        python3 evidence/papers.py "$SETS/000_experiment_$n" condition
        echo
    done
    cat << 'END'
## 002

| item | the paper prints | rasp gives | command |
|---|---|---|---|
END
    row 'eq. 1, Stoelinga and Chaigne' "Hertz's spring, no loss in it, a plate in bending" "$plate" '`rasp render scenes/stoelinga_chaigne.yaml`'
    row 'eq. 2 to 4, Rath and Rocchesso' 'a ball and modes, solved together' '`evidence/rolling.md`' '`contact.model: roll_coupled`'
    row 'section III' '36 stimuli' "$(scenes 002_rolling)" '`rasp render scenes/experiments/002_rolling/*.yaml`'
    row 'section II-B, FoleyAutomatic, Hermes' 'noise at the speed; gammatones' 'two scenes' '`rasp render scenes/foley_rolling.yaml scenes/hermes_rolling.yaml`'
    row 'figures 4 to 10, table I, eq. 9, 12' 'statistics of impacts' '`evidence/impacts_paper.md`' '`rasp analyse FORCE.csv`'
    row 'eq. 7, 8' '(1 + m sin 2 pi nu t) f, nu ~ v/R' 'to rounding (tests/cli/modulation.sh)' '`--set contact.modulation={radius: 1 cm}`'
    row 'section II-B, modulated recordings' 'artificial modulation of recorded rolling' 'the same, of a WAV' '`contact.model: given`, `output.quantity: force`, `contact.modulation`'
    row 'section VI-B' '45 stimuli: 3 controls, 3 sets, 5 levels' "$(scenes 002_controls)" '`rasp render scenes/experiments/002_controls/*.yaml`'
    row 'section VII, comb filter' '"the amplitude variation of the modes over time when the ball is rolling on a finite surface"; no formula' 'the modes themselves, by place; or a comb filter, the formula ours' '`surface.object`, or a table with places; `contact.comb`'
    row 'section VII, rolling water drops' 'an action and an object that never meet' 'a scene' '`rasp render scenes/rolling_drops.yaml`'
    cat << 'END'

## 003

| item | the paper prints | rasp gives | command |
|---|---|---|---|
END
    row 'sections A to C, eq. 1 to 10' 'modes, damping, metrics, the search' '`evidence/materials.md`' '`rasp modes material`'
    row 'section D, algorithm 1' 'a residual, carried over' '`src/README.md`' '`rasp modes residual`, `surface.residual`'
    row 'section E' 'five objects' 'five objects' '`irs/fitted/`'
    cat << 'END'

## 004

| item | the paper prints | rasp gives | command |
|---|---|---|---|
END
    row 'figure 2' 'recordings that all heard as scratching, as rubbing: few impacts, many' 'below' '`rasp plot --panels waveform`, `scenes/scratching.yaml`, `scenes/rubbing.yaml`'
    row 'figure 3' '30 sounds of rising density' "$(scenes 004_continuum)" '`rasp render scenes/experiments/004_continuum/*.yaml`'
    row 'eq. 2, 3, figures 4 to 8' 'impacts and their statistics' '`evidence/impacts.md`' '`contact.model: impacts`'
    row 'rolling, durations by amplitude' 'an informal test' "$(scenes 004_durations)" '`rasp render scenes/experiments/004_durations/*.yaml`'
    row 'figure 9, eq. 8 to 11' 'the disk of actions; a low-pass that follows the hand' 'the same disk' '`contact.impacts.space`, `contact.gesture`'
    row 'outlook: a marble in a bowl' '"velocity profiles"' 'a scene' '`rasp render scenes/marble_in_bowl.yaml`'
    cat << 'END'

Figure 2 has recordings, which the paper does not give; ours are synthesised, 0.12 s of each: of scratching single impacts are seen, of rubbing none.

![scratching](papers_scratching.png)

![rubbing](papers_rubbing.png)

## Listening tests

What listeners said is theirs; what they are given, and what is made of their answers, are commands. `rasp export DESIGN FOLDER --participants N` gives each of N listeners a list in an order of their own, here counted in
those for PsychoPy (`--for psychopy`; `webmushra`, `jspsych`, `page` have the same). The papers' recordings are theirs: 5 of experiment 2, 8 of 003.

| experiment | the paper prints | rasp gives | command |
|---|---|---|---|
END
    row '000, experiment 1' '40 listeners; 30 trials of 7 sounds, MUSHRA' "$(asked 000_experiment_1 40)" '`rasp export`'
    row '000, experiment 2' '41 listeners; one sound, one of five paths' "$(asked 000_experiment_2 41)" '`rasp export`'
    row '000, experiment 3' '33 listeners; 7 sounds, MUSHRA; 3 balls, 3 surfaces, up and down' "$(asked 000_experiment_3 33)" '`rasp export`'
    row '002, section III-B' '17 listeners; 36 sounds, 6 others before them; a slider' "$(asked 002_rolling 17)" '`rasp export`'
    row '002, section VI-B' '14 listeners; 3 sessions, each of one control, 3 blocks of 10 pairs, 3 trials of training' "$(asked 002_controls 14)" '`rasp export`'
    row '003, section F' '24 clips, 8 of them recorded; one of five materials; listeners: not printed' "$(asked 003_materials 41)" '`rasp export`'
    row '004, figure 3' '35 listeners; 30 sounds in random order; rubbing or scratching' "$(asked 004_continuum 35)" '`rasp export`'
    row '000, figures 4B and 7B' 'mean and SEM of each method' 'means and standard errors' '`rasp judge ratings`'
    row '000, eq. 14' 'similarity of confusion matrices; the norm is not named' 'both norms; a program that listens: `evidence/judge.md`' '`rasp judge similarity`, `rasp judge listen`'
    row '002, section III-D' 'F(1, 16) of resonator, F(4, 64) of kappa x mu, 17 listeners' "$(degrees "$WORK/ratings.json" resonator kappa:mu)" '`rasp judge ratings --paper evidence/papers.csv --item 002_III`, of drawn answers'
    row '002, section VI-D' 'F(4, 52) of size, velocity and roughness, 14 listeners' "$(degrees "$WORK/pairs.json" size velocity)" '`rasp judge pairs --paper evidence/papers.csv --item 002_VI`, of drawn answers'
    row '003, tables 1 and 2' '50 percentages' "the fewest answers that give them: all within $(python3 -c 'import json, sys; print("%.2g" % max(abs(float(p["paper"]) - p["ours"]) for p in json.load(open(sys.argv[1]))["paper"]))' "$WORK/study.json")" '`rasp judge choices scenes/answers/003_study.csv --paper evidence/papers.csv --item 003_F`'
    row '003, tables 1 and 2' 'synthesised "compares favorably" to recorded' "$(python3 -c 'import json, sys; c = json.load(open(sys.argv[1]))["compared"][0]; print("alike by %.2f (spectral), %.2f (Frobenius)" % (c["spectral"], c["frobenius"]))' "$WORK/like.json")" '`rasp judge similarity scenes/answers/003_study.csv --reference recorded`'
}  > "$WORK/papers.md"
mv "$WORK/papers.md" evidence/papers.md

#!/bin/bash
# Makes evidence/rolling.md and rolling.png: a ball that rolls and bounces by the coupled model, beside closed forms and beside papers/002 (about 5 minutes
# on two cores). Needs gnuplot and jq.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
read -ra GSL < <(pkg-config --libs gsl)
read -ra LIBS < <(pkg-config --libs sndfile yaml-0.1 fftw3 gsl jansson libebur128 libcrypto libpng soxr)
gcc -std=c11 -D_GNU_SOURCE -O2 -o judge "$ROOT/evidence/rolling_judge.c" "${GSL[@]}" -lm
for program in impacts runs; do
    gcc -std=c11 -D_GNU_SOURCE -O2 -I"$ROOT/src" -o $program "$ROOT/evidence/rolling_$program.c" "$BUILD/librasp.a" "${LIBS[@]}" -lsleef -lm
done

KAPPA='N/(m^1.5 kg)'

# The ball of papers/002 on its ground, 5 s; one step per sample, as there. 30 g: force over mass does not depend on it.
cat > paper.yaml << YAML
rasp: 1
seed: 2
surface: {fractal: {exponent: -0.5, maximum: 0.1 um, pitch: 0.1 mm}}
ball: {radius: 1 cm, mass: 30 g, material: steel, patch: 0}
motion: {path: line, to: [1 m, 0], speed: 20 cm/s}
contact:
  model: roll_coupled
  gravity: 9.81 m/s^2
  roll: {kappa: 5e9 $KAPPA, mu: 1 s/m, ground: rigid}
output: {sample_rate: 44.1 kHz, quantity: force, encoding: float64, level: {full_scale: 1 N}, ramp: 0}
accuracy: {contact_steps: 1, oversampling: 1}
YAML

# roll NAME MAXIMUM BETA KAPPA MU COLUMNS [OPTION...]: to NAME.json and NAME.csv. Fails where rasp refuses; NAME.txt says why.
roll() {
    local name=$1
    rasp render paper.yaml -q -o "$name.wav" --set "surface.fractal={exponent: $3, maximum: $2, pitch: 0.1 mm, length: 1 m}" \
        --set "contact.roll.kappa=$4 $KAPPA" --set "contact.roll.mu=$5" --set "output.diagnostics={rate: 44100, columns: [$6]}" "${@:7}" > "$name.txt" 2>&1
}
report() { jq -r ".contacts[0].roll.$2" "$1.json"; }

# ------------------------------------------------------------------ 2

# The largest residual of the table, the bound, and what the energies reach.
ledger() {
    jq -r '.contacts[0].roll | "\(.steps) \(.energy_residual) \(.contact_share) \(.lift_offs) \(.iterations_mean_most[0]) \(.iterations_mean_most[1])"' "$1.json" |
        awk -v what="$2" '{ printf "| %s | %.2e | %.1e | %.1e | %.1f %% | %d | %.2f, %d |\n", what, $1, $2, 1e-10 + 4 * 2.220446e-16 * $1, 100 * $3, $4, $5, $6 }'
}

plate() {
    cat << YAML
rasp: 1
seed: 6
surface:
  fractal: {exponent: -0.5, maximum: $1, pitch: 0.1 mm, length: 4 m, interpolation: $2}
  material: ceramic
  object: {shape: plate, length: 40 cm, width: 20 cm, thickness: 2.5 mm, edges: supported}
ball: {radius: 8 mm, material: glass, patch: 0}
motion: {path: back_and_forth, from: [3 cm, 8.3 cm], to: [37 cm, 8.3 cm], rate: 0.25 Hz, duration: 60 s}
contact: {model: roll_coupled, roll: {mu: 0.5 s/m}}
output: {sample_rate: 44.1 kHz, diagnostics: {rate: 100 Hz, columns: [energy_residual_j]}}
YAML
}

energy() {
    echo '| 60 s on a ceramic plate of 50 modes | steps | largest residual over greatest energy | bound | in contact | lift-offs | passes a step in contact: mean, most |'
    echo '|---|---|---|---|---|---|---|'
    plate '0.01 um' spline > low.yaml
    plate '1 um' spline > high.yaml
    plate '1 um' nearest > steps.yaml
    rasp render low.yaml -q -o low.wav
    ledger low 'hardly rough (0.01 um)'
    rasp render high.yaml -q -o high.wav
    ledger high 'rough (1 um), spline'
    rasp render steps.yaml -q -o steps.wav --set accuracy.contact_steps=12
    ledger steps 'rough (1 um), nearest, contact_steps 12'
    rasp render high.yaml -q -o coarse.wav --set accuracy.contact_steps=1 --set accuracy.oversampling=1 --set 'surface.modes=50' 2> /dev/null &&
        ledger coarse 'rough (1 um), spline, one step per sample'
    echo
    echo "Ring-down of 49 modes after the ground has left the ball: $(./runs ringdown)."
}

resting() {
    cat > rest.yaml << YAML
rasp: 1
surface:
  material: ceramic
  object: {shape: plate, length: 40 cm, width: 20 cm, thickness: 2.5 mm, edges: supported}
ball: {radius: 8 mm, material: glass, patch: 0}
motion: {path: still, at: [13 cm, 8.3 cm], duration: 3600 s}
contact: {model: roll_coupled, roll: {mu: 0.5 s/m}}
output: {sample_rate: 8 kHz, quantity: force, encoding: float64, level: {full_scale: 1 N},
         diagnostics: {rate: 1 Hz, columns: [force_mean_n, height_m, energy_residual_j]}}
accuracy: {contact_steps: 1, oversampling: 1}
YAML
    local ground mu
    echo '| ball at rest for an hour on | largest height, m | mean force over weight, less 1 | lift-offs | largest residual, J |'
    echo '|---|---|---|---|---|'
    for ground in elastic rigid; do
        rasp render rest.yaml -q -o rest.wav --set contact.roll.ground=$ground 2> rest.txt
        awk -F, -v ground=$ground -v lifts="$(report rest lift_offs)" -v weight="$(weight rest)" 'NR > 2 && NR < 3600 { force += $1; n++; h = $2 < 0 ? -$2 : $2; if (h > most) most = h; e = $3 < 0 ? -$3 : $3; if (e > off) off = e }
            END { printf "| %s | %.1e | %+.1e | %d | %.1e |\n", ground, most, force / n / weight - 1, lifts, off }' rest.csv
    done
    rm rest.wav
    echo
    echo '| dropped 1 cm on rigid ground, 6 s, mu (s/m) | mean force over weight, less 1 (all 6 s) | penetration at the end over (m g/k)^(2/3), less 1 | bounces | passes: mean, most | residual, of the greatest |'
    echo '|---|---|---|---|---|---|'
    for mu in 0.5 5 50; do
        rasp render rest.yaml -q -o drop.wav --set surface.object=null --set motion.at=null --set motion.duration='6 s' --set contact.roll.ground=rigid --set contact.roll.mu=$mu \
            --set contact.roll.drop='1 cm' --set output.sample_rate=44100 --set accuracy.contact_steps=40 --set 'output.diagnostics={rate: 10, columns: [force_mean_n, penetration_m]}'
        awk -F, -v mu=$mu -v rest="$(report drop rest_penetration_m)" -v weight="$(weight drop)" -v bounces="$(report drop bounces)" -v passes="$(jq -r '.contacts[0].roll.iterations_mean_most | "\(.[0]), \(.[1])"' drop.json)" \
            -v off="$(report drop energy_residual)" 'NR > 1 && NR < 61 { force += $1; n++; last = $2 } END { printf "| %s | %+.1e | %+.1e | %d | %s | %.1e |\n", mu, force / n / weight - 1, last / rest - 1, bounces, passes, off }' drop.csv
    done
}

# k xi^1.5 of the report: the weight.
weight() { jq -r '.contacts[0].roll | .stiffness * .rest_penetration_m * (.rest_penetration_m | sqrt)' "$1.json"; }

# ------------------------------------------------------------------ 4

regimes() {
    local kappa mu beta cell
    echo '| kappa, mu, beta | 0.1 um: in contact, landings/s, peaks/s, mean peak over weight | 0.1 um, rk4 | 10 um | 10 um, rk4 |'
    echo '|---|---|---|---|---|'
    for kappa in 5e7 5e9 5e11; do
        for mu in 0.1 1 10; do
            for beta in -0.5 -1; do
                printf '| %s, %s, %s |' $kappa $mu $beta
                for cell in '0.1 um,discrete_gradient' '0.1 um,rk4' '10 um,discrete_gradient' '10 um,rk4'; do
                    if roll g "${cell%,*}" $beta $kappa $mu force_mean_n --set contact.roll.integrator="${cell#*,}"; then
                        awk -v share="$(report g contact_share)" -v lifts="$(report g lift_offs)" '{ printf " %.3f, %.0f, %.0f, %.2f |", share, lifts / 5, $2, $5 }' < <(amplitude g)
                    else
                        printf ' %s |' "$(grep -o 'lasts [0-9.]* steps\|reaches [0-9.e+]* at' g.txt | head -n 1 | sed 's/lasts \(.*\)/refused: \1 in an impact/; s/reaches \(.*\) at/refused: mu k xi^1.5 step\/m \1/')"
                    fi
                done
                echo
            done
        done
    done
}
# The set at the edge: it stays down or bounces for seconds at a time.
edge() {
    local integrator
    for integrator in discrete_gradient exact_impact rk4; do
        roll e '0.1 um' -0.5 5e9 0.1 force_mean_n --set contact.roll.integrator=$integrator --set accuracy.contact_steps=40 --set 'motion.to=[12 m, 0]' --set output.diagnostics=null
        printf '%s %.2f, ' $integrator "$(report e contact_share)"
    done
}
# Mean force, peaks per second, -, -, mean of the local maxima over the mean force.
amplitude() {
    ./judge peaks "$1.csv" 44100 0.001 > a.txt
    awk -v top="$(awk 'NR > 2205 && $1 > most { most = $1 } END { print most }' "$1.csv")" '{ print $1, $2, 0, 0, ($10 == "-" ? 1 : $10 * top / $1) }' a.txt
}

# Table I's series, by all local maxima and by those that stand out by half the weight.
intervals() {
    local how maximum beta
    echo '| between the heights, R | maximum | beta -1.5: in contact; ms between peaks, between peaks above half the weight, between landings | beta -0.5 | beta 0 |'
    echo '|---|---|---|---|---|'
    for how in spline linear nearest 'spline, 0.1 mm'; do
        for maximum in 0.1 1 10 20; do
            printf '| %s | %s um |' "$how" $maximum
            for beta in -1.5 -0.5 0; do
                roll i "$maximum um" $beta 3.3333333e9 1 force_mean_n --set surface.fractal.interpolation="${how%,*}" --set ball.radius="$(case $how in *mm) echo 0.1 mm ;; *) echo 1 cm ;; esac)"
                awk -v share="$(report i contact_share)" -v lifts="$(report i lift_offs)" '{ x[NR] = $4 } END { printf " %.2f; %s, %s, %s |", share, x[1] == "-" ? "-" : sprintf("%.2f", x[1]), x[2] == "-" ? "-" : sprintf("%.2f", x[2]), (lifts > 9) ? sprintf("%.2f", 5000 / lifts) : "-" }' \
                    < <(./judge peaks i.csv 44100 0.001; ./judge peaks i.csv 44100 0.5)
            done
            echo
        done
    done
}

# Means and deviations over seeds of the judge's columns.
over_seeds() {
    awk '{ for (i = 1; i <= NF; i++) { sum[i] += $i; square[i] += $i * $i; if ($i !~ /^[-+.e0-9]+$/) bad[i] = 1 } }
         END { for (i = 1; i <= NF; i++) { m = sum[i] / NR; v = square[i] / NR - m * m; if (bad[i]) printf "- "; else printf "%.3g+-%.1g ", m, (v > 0) ? sqrt(v) : 0 } print "" }'
}
table_one() {
    local maximum beta seed
    echo '| | intervals: mean (ms) | sigma (ms) | a1 | b1 | amplitudes: mean | sigma | a1 | b1 | correlation |'
    echo '|---|---|---|---|---|---|---|---|---|---|'
    echo '| **002, table I, rho = 0** | 3.1 | 0.19 | -0.97 | -0.34 | 0.43 | 0.04 | -0.97 | 0.07 | "highly" |'
    echo '| **002, table I, rho = 1** | 6.4 | 0.85 | -0.93 | 0.35 | 0.27 | 0.04 | -0.93 | 0.32 | "highly" |'
    for maximum in 3 10; do
        for beta in -1.5 -1 -0.5 0; do
            for seed in 1 2 3 4; do
                roll t "$maximum um" $beta 3.3333333e9 1 force_mean_n --set seed=$seed
                ./judge peaks t.csv 44100 0.5
            done | over_seeds | tee series-$maximum-$beta |
                awk -v what="$maximum um, beta $beta" '{ print "| " what " | " $4 " | " $9 " | " $7 " | " $8 " | " $10 " | " $15 " | " $13 " | " $14 " | " $3 " |" }'
        done
    done
}

# 002 fig. 7: speeds 10 to 100 cm/s, the 27 sets of fig. 4.
landings() {
    local maximum speed kappa mu beta share
    echo '| maximum | speed | sets that ever land, of 27 | landings | mean, cm/s | deviation | 99 % | greatest |'
    echo '|---|---|---|---|---|---|---|---|'
    for maximum in 0.1 1 3 10; do
        for speed in 10 30 100; do
            : > all.txt
            share=0
            for kappa in 1e9 5e9 1e10; do
                for mu in 0.5 1 2; do
                    for beta in 0 -0.5 -1; do
                        roll l "$maximum um" $beta $kappa $mu penetration_m,height_m --set "motion={path: line, to: [$(awk "BEGIN { print 0.015 * $speed }"), 0], speed: $speed cm/s}" --set surface.fractal.length='1.5 m' --set output.quantity=force
                        ./judge landings l.csv 44100 > one.txt
                        [ ! -s one.txt ] || share=$((share + 1))
                        cat one.txt >> all.txt
                    done
                done
            done
            ./judge spread < all.txt | awk -v what="$maximum um | $speed cm/s | $share" '$2 == "-" { print "| " what " | " $1 " | | | | |" } $2 != "-" { printf "| %s | %d | %.2f | %.2f | %.2f | %.2f |\n", what, $1, 100 * $2, 100 * $3, 100 * $5, 100 * $7 }'
        done
    done
}

rolling_time() {
    local maximum
    echo '| maximum | contacts in 5 s | theta'"'"', R^2 of the logarithms | R^2 with theta'"'"' = 0.29 |'
    echo '|---|---|---|---|'
    echo '| **002** (0.1 um) | | 0.29 from single impacts | 0.70 |'
    for maximum in 1 3 10 20; do
        roll c "$maximum um" -1 2e9 1 force_mean_n,penetration_m
        ./judge contacts c.csv 44100 | awk -v m="$maximum um" '{ print "| " m " | " $4 " | " $1 ", " $2 " | " $3 " |" }'
    done
}

# ------------------------------------------------------------------ 6

# share FILE: percentage of a render's CPU that the coupled stage takes.
share() {
    rasp render "$ROOT/scenes/$1" -q -o share.wav 2> /dev/null
    jq -r '[.contacts[0].stages[] | select(.stage == "roll_coupled") | .share] | add * 100 | round' share.json
}

# fastest TABLE: ./runs TABLE five times, of each cell the fastest: other programs only make it slower. Cycles come first in a cell, or CPU time behind a comma.
fastest() {
    local k
    for k in 1 2 3 4 5; do ./runs "$1" > "run$k.txt"; done
    awk -F' [|] ' '
        function cost(cell) { return cell ~ /^[0-9]+ [(]/ ? cell + 0 : cell ~ /^[0-9.]+, [0-9.]+/ ? substr(cell, index(cell, ",") + 1) + 0 : 0 }
        { for (i = 1; i <= NF; i++) if (NR == FNR || cost($i) < cost(best[FNR, i])) best[FNR, i] = $i; rows = FNR; cells = NF }
        END { for (r = 1; r <= rows; r++) for (i = 1; i <= cells; i++) printf "%s%s", best[r, i], i < cells ? " | " : "\n" }' run[1-5].txt
}

lanes() {
    awk -F'|' -v plate="$(share marble_drop.yaml)" -v rigid="$(share roll_coupled.yaml)" '
        function cycles(cell) { sub(/^ */, "", cell); return cell + 0 }
        /rigid, discrete/ { one = cycles($3) } /50 modes, discrete/ { all = cycles($3); some = cycles($5); flight = cycles($7) }
        END {
            contact = all / (flight + one / 8); bounce = some / (some - 0.24 * (all - flight) * 7 / 8)
            printf "Eight scenes, one per lane: the modes of one scene already fill the lanes, so what could be saved is the waiting for one contact'"'"'s chain of divisions and roots. Of %d cycles a step with 50 modes %d are the modes'"'"' (flight); were ", all, flight
            printf "the rest (%d on rigid ground) shared by eight, the stage would be at most %.1f times as fast in contact, %.1f times bouncing. The stage is %d %% of the CPU of `scenes/marble_drop.yaml` and %d %% of ", one, contact, bounce, plate, rigid
            printf "`scenes/roll_coupled.yaml`: a batch of eight would gain at most %.2f and %.2f times, if all eight had the same number of modes and of steps and bounced together. ", 1 / (1 - plate / 100 * (1 - 1 / bounce)), 1 / (1 - rigid / 100 * (1 - 1 / 8))
            print "It does not pay beside `--jobs`, which gives each scene a core and asks for none of that."
        }' cost.txt
}

# ------------------------------------------------------------------ 7

chaos() {
    local kappa mu maximum
    echo '| kappa, mu, maximum | in contact, landings/s | height off by 1e-15 of itself: 24 bits, 10 % | by 1e-12 | exact_impact against it: 10 % |'
    echo '|---|---|---|---|---|'
    while read -r kappa mu maximum; do
        roll x "$maximum um" -0.5 "$kappa" "$mu" penetration_m,height_m --set output.sample_rate=176400 --set output.diagnostics.rate=176400 --set motion.to='[0.6 m, 0]'
        echo "| $kappa, $mu, $maximum um |$(./runs chaos x.csv 176400 "$kappa" "$mu")"
        ./runs trace x.csv 176400 "$kappa" "$mu" > "trace-$kappa-$mu-$maximum"
    done << TABLE
5e9 1 0.1
5e9 1 1
5e9 1 10
5e11 1 1
5e9 10 1
TABLE
}

statistics() {
    local maximum steps integrator seed
    echo '| maximum | integrator, contact_steps | mean force over weight, less 1 | in contact | landings/s | peaks/s above half the weight | mean interval (ms) |'
    echo '|---|---|---|---|---|---|---|'
    for maximum in 1 10; do
        while read -r integrator steps; do
            for seed in 1 2 3; do
                roll s "$maximum um" -0.5 5e9 1 force_mean_n --set seed=$seed --set surface.fractal.length='6 m' --set 'motion={path: line, to: [6 m, 0], speed: 20 cm/s}' --set contact.roll.integrator="$integrator" \
                    --set accuracy.contact_steps="$steps"
                ./judge peaks s.csv 44100 0.5 | awk -v share="$(report s contact_share)" -v lifts="$(report s lift_offs)" '{ print ($1 / 0.2943 - 1) * 1e4, share, lifts / 30, $2, $4 }'
            done | over_seeds | awk -v what="$maximum um | $integrator, $steps" '{ print "| " what " | (" $1 ")e-4 | " $2 " | " $3 " | " $4 " | " $5 " |" }'
        done << TABLE
discrete_gradient 1
discrete_gradient 40
discrete_gradient 160
exact_impact 40
rk4 40
TABLE
    done
}

hashes() {
    local flags
    echo '| built with | force, 6 s of bounces on 50 moving modes |'
    echo '|---|---|'
    while read -r flags; do
        # shellcheck disable=SC2086
        if command -v "${flags%% *}" > /dev/null; then
            $flags -std=c11 -D_GNU_SOURCE -ffp-contract=off -I"$ROOT/src" -o hashed "$ROOT"/evidence/rolling_runs.c "$ROOT"/src/convolution/coupled*.c "$BUILD/librasp.a" "${LIBS[@]}" -lsleef -lm
            echo "| $flags | $(./hashed hash) |"
        fi
    done << TABLE
gcc -O0
gcc -O2 -fno-tree-slp-vectorize
gcc -O3 -fno-tree-slp-vectorize -march=x86-64-v3 -DRASP_NO_CLONES
clang -O2
TABLE
}

# ------------------------------------------------------------------ picture

picture() {
    roll low '0.1 um' -0.5 5e9 1 force_mean_n
    roll high '10 um' -0.5 5e9 1 force_mean_n
    ./judge curve 5e9 1 > curve.dat
    for beta in -1.5 -1 -0.5 0; do
        awk -v b=$beta '{ split($4, x, "[+]-"); print b, x[1], x[2] }' "series-10-$beta"
    done > means.dat
    for name in low high; do
        awk 'NR > 1 && NR % 2 && NR < 30000 && NR > 26000 { print NR / 44.1, $1 / 0.2943 }' $name.csv > $name.curve
    done
    gnuplot << PLOT
set terminal pngcairo size 1000,720 font "sans,9"
set output "$ROOT/evidence/rolling.png"
set multiplot layout 2,2
set title "Duration of an impact, kappa 5e9, mu 1"
set logscale xy; set xlabel "speed (m/s)"; set ylabel "s"; set key bottom left
plot "curve.dat" using 1:2 with lines lw 2 title "gravity in the contact", "" using 1:3 with lines lw 2 title "without", 3.92e-4 * x ** -0.23 dt 2 title "v^{-0.23}"
unset logscale; set key top right
set title "Force over weight, 20 cm/s, beta -0.5"; set xlabel "ms"; set ylabel ""
plot "high.curve" with lines title "maximum 10 um", "low.curve" with lines lw 2 title "0.1 um, as 002 has it"
set title "Mean interval between impacts"; set xlabel "beta"; set ylabel "ms"; set yrange [0:8]; set xrange [-1.7:0.2]; set key bottom right
plot "means.dat" with yerrorbars title "maximum 10 um", "-" with points pt 7 title "002, table I"
-1.5 3.1
0 6.4
e
set title "Two forces whose heights at the start differ by 1e-15"; set xlabel "s"; set ylabel "of the rms"; set logscale y; set format y "10^{%L}"; set yrange [1e-17:100]; set xrange [0:1.2]
plot "trace-5e9-1-0.1" with lines title "0.1 um", "trace-5e9-1-1" with lines title "1 um", "trace-5e9-1-10" with lines title "10 um", "trace-5e11-1-1" with lines title "1 um, kappa 5e11"
PLOT
}

# ------------------------------------------------------------------ the page

# Two at a time, each in a folder of its own; what is timed comes last, alone.
part() {
    local name
    for name; do
        mkdir "$name"
        ln -s ../judge ../runs ../impacts ../paper.yaml "$name"
        (cd "$name" && $name > ../$name.txt)
    done
}
part energy resting landings rolling_time hashes &
other=$!
part regimes edge intervals table_one chaos statistics
wait $other
ln -sf table_one/series-* chaos/trace-* .
picture
fastest cost > cost.txt
fastest ladder > ladder.txt

cat << MD > report.md
# A ball that rolls and bounces

Made by \`evidence/rolling.sh\` with $(rasp --version) on $(uname -m), $(getconf _NPROCESSORS_ONLN) processors. The coupled model (\`src/convolution/coupled.h\`, papers/002
equations 2 and 3), \`evidence/rolling_impacts.c\` and \`rolling_runs.c\`, and from the command line; beside it what shares no code with rasp: \`rolling_closed.h\`
(closed forms, quadrature of 002's equation 10, GSL's Runge-Kutta of order 8) and \`rolling_judge.c\`. kappa = k/m in N/(m^1.5 kg), mu in s/m.

![durations, forces, intervals, chaos](rolling.png)

## 1. One impact: the speed it leaves with

Least and greatest error (speed out - exact)/(speed in) of 32 arrivals within a step, at 1, 4, 16, 64 steps per sample of 44.1 kHz; in brackets the samples that the contact lasts.
Of rk4, an impact of less than 12 steps or with mu k xi^1.5 step/m above 1 is refused.

| kappa, mu, speed | integrator | 1 | 4 | 16 | 64 |
|---|---|---|---|---|---|
$(./impacts grid)

discrete_gradient errs by the same for every arrival but where mu v is large and the contact has some five steps; it loses too little, never gains. By the number of steps in the contact,
with the order between columns, and the largest spread over arrivals:

| kappa, mu, speed | 40 | 160 | 640 | 2560 | spread |
|---|---|---|---|---|---|
$(./impacts order)

The grid of a public program (f = k xi^1.5 (1 + 0.3 xi'), 10 g, 1 m/s): restitution at 44.1, 96 and 192 kHz, one step per sample; last with 40 steps in the contact, which is what \`accuracy.contact_steps\`
gives by default at any rate.

| k (N/m^1.5) | contact (us) | exact | theirs | discrete_gradient | exact_impact | 40 steps |
|---|---|---|---|---|---|---|
$(./impacts peer)

002's grid at 44.1 kHz, one step per sample; speeds 0.01, 0.05, 0.2 and 1 m/s, 32 arrivals each. "ok" is: it comes back, no faster than exact plus the error, which follows; on 50 modes (100 Hz to 15 kHz,
1 kg) the greatest energy afterwards, ball and modes, over that before. rk4 refuses: on modes those that it would damp more than they are damped (from 5 kHz or so), at 5e11 impacts of few steps.

| kappa, mu | rigid: discrete_gradient | exact_impact | rk4 | 50 modes: discrete_gradient | rk4 |
|---|---|---|---|---|---|
$(./impacts paper)

## 2. Energy

The contact goes to and fro over the plate, across nodal lines, so that shapes change sign; \`energy_residual_j\`. Bound: 1e-10 + 4 eps steps, beyond which rasp ends with an error.

$(cat energy.txt)

$(cat resting.txt)

With mu = 0.5 the contact damps so little at small speeds that the ball still rings after 6 s; with more it lies at rest to the last digit. No stall, never more than a few passes.

## 3. How long an impact lasts

Equation 10 by quadrature, and how far the durations of 400 and 1600 steps in the contact are from it; kappa 5e9. Last the exponent theta of v^-theta from 0.1 to 5 cm/s.

| mu | 0.1 cm/s | 1 cm/s | 5 cm/s | 1 m/s | theta |
|---|---|---|---|---|---|
$(./impacts times)

**theta = 0.23 (002: R^2 > 0.99; theta' = 0.29, R^2 = 0.93).** Least to greatest over the nine sets (kappa 1e9, 5e9, 1e10; mu 0.5, 1, 2) and least R^2, by regression of the logarithms over speeds even in
their logarithm; the set of 002's example (kappa 2e9, mu 1) by itself.

| speeds | theta, no gravity (equation 10) | theta, gravity in the contact | kappa 2e9, mu 1 | theta' (by force), gravity | kappa 2e9, mu 1 |
|---|---|---|---|---|---|
$(./judge laws)

Equation 10 itself cannot give 0.23: 0.20 at most, less with mu. With gravity acting in the contact, as it does in 002's equation 2, slow impacts last longer, and the exponent is 0.23 where the
fit covers 0.1 cm/s to 0.5 or 1 m/s: for all nine sets at once, R^2 0.99. Over 0.1 to 5 cm/s, the speeds that 002 gives, it is 0.23 to 0.26. theta' falls with the range as well: 0.28 with
R^2 = 0.93 over 0.1 to 50 cm/s for the example's set, 0.46 over 0.1 to 5 cm/s. So one condition, which 002 does not state, gives theta, theta' and both R^2 nearly: single impacts with gravity, 0.1 cm/s to about
half a metre per second. Without gravity theta' is 1/6 (A ~ v^(6/5)) with R^2 = 1.

**Raised cosines (equation 9), 002: 0.90 < R^2 < 0.99 for 0.1 to 5 cm/s.** Least to greatest of the nine sets; t0 and A taken from the impact (its duration, its greatest force), or fitted, with its place.
Again it is gravity that makes 002's range; last the impacts of 18 that never end, as the ball stays down.

| speed | no gravity, taken | fitted | gravity, taken | fitted | stay |
|---|---|---|---|---|---|
$(./judge shapes)

## 4. papers/002, sections III and IV, beside ours

R = 1 cm, 20 cm/s, heights every 0.1 mm, 44.1 kHz, one step per sample, 5 s, rigid ground, the rolling curve of 002's fig. 1, as in 002. **Micro-impacts or none** (section III-B's 18 sets; fig. 3 and section IV-A: "f can be considered as
a succession of micro-impacts"):

$(cat regimes.txt)

At 0.1 um, the height that 002 states, the ball does not leave the ground: at kappa = 5e9 its weight alone presses it 1.57 um deep, 16 times the largest height, and the force is the weight with a ringing of about
490 Hz. The one exception, kappa = 5e9 with mu = 0.1, rings until it bounces, and calms down again: 5 s say little there; over 60 s at beta = -0.5, with 40 steps in a contact,
it is down for a share of $(sed 's/, $//' edge.txt) of the time. At a hundred times that height, 10 um, there are the impacts that 002 shows, but where the contact is soft (5e7).

**Intervals** (table I and fig. 10; kappa = 1e10/3, mu = 1): 002 has 3.1 ms at beta = -1.5 and 6.4 ms at beta = 0. By height and by what lies between the heights, which 002 does not state ("0.1 mm": the ground itself, not rolled over by a ball of 1 cm):

$(cat intervals.txt)

Every local maximum counts several times per contact where the ground is rough on the scale of a contact (0.5 ms is one height at 20 cm/s); peaks that stand out by half the weight are one per contact, and
their intervals grow with beta as 002's do. No interpolation, nor the ground itself instead of the rolling curve, gives 002's intervals and their growth at 0.1 um: there they are the period of the ball on its contact, 2.3 ms, at
any beta (on steps 1.8 ms, as each step shakes it). With 10 um all three interpolations give them nearly.

**The series** (section IV-E, table I: x_n + a1 x_(n-1) = e_n + b1 e_(n-1), e of deviation sigma; amplitudes over the greatest; here from the first two correlations, four seeds, mean+-deviation):

$(cat table_one.txt)

At 10 um the intervals, their memory (a1), deviations, and the amplitudes are near 002's, the intervals over a narrower span (3.8 to 5.9 ms), and amplitude and interval are "highly correlated", as 002's fig. 4 has it. So the
model of 002 is this one; what its simulations had for heights must have been some 100 times the 0.1 um that it states, at which the model gives no impacts. What remains apart (b1 of the intervals, the mean amplitude on rough
ground) depends on how peaks are told apart and on the greatest of the run, neither of which 002 gives.

**Speeds of impacts** (fig. 7: "do not exceed 5 cm/s"; rolling at 10 to 100 cm/s, the 27 sets of fig. 4; 1.5 s each):

$(cat landings.txt)

002's 5 cm/s hold at 1 um at any of these speeds, at 3 um for 98 of 100 impacts, and at 10 um for rolling at 10 cm/s alone: here its heights were 1 to 3 um rather than 10. Always far above 0.1 um.

**Duration against amplitude while rolling** (section IV-E: kappa 2e9, mu 1, beta -1):

$(cat rolling_time.txt)

While it rolls, a contact of 1 to 2 ms goes over several heights, which lengthen or part it: duration follows from amplitude less well than 002 has it, at any height tried.

## 5. What it costs

Cycles per step (times real time at 44.1 kHz; share of contact), kappa 5e9: over low bumps, always in contact, at 1 and 8 steps per sample; bouncing; in flight. Last, a prototype's (on another CPU; 50 standing modes, always in contact,
1 and 8 steps per sample): it kept no account of energy and contacts.

| ground, integrator | contact, 1x | 8x | bouncing, 1x | 8x | flight, 1x | prototype |
|---|---|---|---|---|---|---|
$(cat cost.txt)

Accuracy against time: a ball dropped 1 mm, the first 30 ms. Signal-to-noise ratio of the force (means over samples) in dB, and CPU time in ms per second of sound, at that many steps per sample.

| ground | integrator | 1 | 2 | 4 | 16 | 64 |
|---|---|---|---|---|---|---|
$(cat ladder.txt)

Where it is not refused, and the contact has a few dozen steps, rk4 is the better buy for 60 dB and more: with modes half of the time for 60 dB and a quarter from 70 dB on, on rigid ground with a soft contact four
fifths of it for 80 dB and a third for 108, as discrete_gradient's flights cost next to nothing there (each sample is a run of its own here, and what begins a run is paid for each). For less, with a stiff contact or with high modes at the rate of the samples, where rk4 is refused, and wherever the energy must balance, discrete_gradient is. On rigid ground exact_impact errs in an
isolated impact by rounding alone (section 1); here its error is that of gravity in the contact, of the same size as discrete_gradient's.

$(lanes)

## 6. Hard cases, chaos

A ball that bounces forgets its start: two forces whose initial heights differ by a part of 1e-15 (rounding) are apart by the last of 24 bits, and by 10 % of the rms, after the times given; 3 s, beta -0.5, 176.4 kHz, one step per sample.
"never": the largest difference in brackets.

$(cat chaos.txt)

So of a bouncing ball two runs agree to the last bit for 0.07 to 0.3 s at most, two integrators to 10 % for 20 to 200 ms, and beyond that a pointwise comparison means nothing; where the ball stays down, or mu damps it, it holds
for ever. What can be compared instead, 30 s, three seeds, mean+-deviation; 20 cm/s, kappa 5e9, mu 1, beta -0.5:

$(cat statistics.txt)

The same bits from every build, in that regime:

$(cat hashes.txt)

Cases: a bounce without loss to 1e-12 and order 2 (section 1); a drop to rest (section 2: penetration, mean force, passes); kappa 1e12, mu 10, 1 m/s at one step per sample (section 1: no gain of energy, rk4 refuses); modes to 0.49 of the
rate (section 2, ring-down); the balance with shapes that change sign, and on steps (section 2); chaos and its bits (above).
MD
mv report.md "$ROOT/evidence/rolling.md"

#!/bin/bash
# Makes evidence/impacts_paper.md and impacts_paper.png, impacts_paper_white.png, impacts_paper_law.png: the statistics of impacts of papers/002, section IV, and of
# papers/004, figures 4 to 6, from the force of the physical model by `rasp analyse` (a few minutes on two cores). Needs gnuplot and jq.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"

KAPPA='N/(m^1.5 kg)'
MASS=0.03 # kg; force over mass does not depend on it

# The ball of papers/002 on its ground, one step per sample, as there: 20 s, four times over 1 m of ground (002 states 5 s: 1 m).
cat > paper.yaml << YAML
rasp: 1
surface: {fractal: {exponent: -0.5, maximum: 0.1 um, pitch: 0.1 mm, length: 1 m}}
ball: {radius: 1 cm, mass: $MASS kg, material: steel, patch: 0}
motion: {path: line, to: [4 m, 0], speed: 20 cm/s}
contact:
  model: roll_coupled
  gravity: 9.81 m/s^2
  roll: {kappa: 5e9 $KAPPA, mu: 1 s/m, ground: rigid}
output: {sample_rate: 44.1 kHz, quantity: force, encoding: float64, level: {full_scale: 1 N}, ramp: 0}
accuracy: {contact_steps: 1, oversampling: 1}
YAML

# render SCENE NAME [OPTION...]: to NAME.wav; of rasp's warnings (the ground repeats itself) only errors are shown.
render() {
    rm -f "$2".{wav,json,csv,scene.yaml}
    rasp render "$1" -q -o "$2.wav" "${@:3}" 2> "$2.txt" || { cat "$2.txt" >&2; return 1; }
}
# roll NAME SETTING BETA KAPPA MU SEED [OPTION...]: 002's ball. SETTING: height in um, and what lies between the heights.
roll() {
    local height=${2%% *}
    render paper.yaml "$1" --set "surface.fractal.exponent=$3" --set "surface.fractal.maximum=$height um" --set "surface.fractal.interpolation=${2##* }" \
        --set "contact.roll.kappa=$4 $KAPPA" --set "contact.roll.mu=$5" --set seed="$6" "${@:7}"
}
# look NAME [OPTION...]: what rasp analyse finds, to NAME.found
look() { rasp analyse "$1.wav" --scale 1 --keep-modulation --json "${@:2}" > "$1.found"; }

# fields NAME EXPRESSION...: a row of numbers; "-" where there is none.
fields() {
    local name=$1 list
    shift
    list=$(IFS=,; echo "$*")
    jq -r 'def among($x; $from; $to): [$x[$from:$to][] | fabs] | max;
           .statistics as $s | ($s.amplitude_n // {}) as $a | ($s.interval_s // {}) as $t | ($s.cross_correlation // []) as $c | ($s.white_cross_correlation // []) as $w |
           ['"$list"'] | map(if . == null then "-" else tostring end) | join(" ")' "$name.found"
}
# Means and deviations over rows, of seeds; widths of columns do not matter.
over_seeds() {
    awk '{ for (i = 1; i <= NF; i++) { sum[i] += $i; square[i] += $i * $i; if ($i !~ /^[-+.eE0-9]+$/ || $i == "-") bad[i] = 1 } }
         END { for (i = 1; i <= NF; i++) { m = sum[i] / NR; v = square[i] / NR - m * m; if (bad[i]) printf "- "; else printf "%.3g+-%.1g ", m, (v > 0) ? sqrt(v) : 0 } print "" }'
}
means() { awk '{ for (i = 1; i <= NF; i++) { sum[i] += $i; if ($i == "-") bad[i] = 1 } } END { for (i = 1; i <= NF; i++) printf "%s ", bad[i] ? "-" : sprintf("%.4g", sum[i] / NR); print "" }'; }
row() { sed 's/ *$//; s/ / | /g; s/^/| '"$1"' | /; s/$/ |/'; }

SEEDS='1 2 3'

# ------------------------------------------------------------------ figures 4, 6, 8, 9

# The seven sets of figure 4: column of the figure, kappa, mu, beta.
cat > sets << TABLE
kappa 1e9 1 -0.5
both 5e9 1 -0.5
kappa 1e10 1 -0.5
mu 5e9 0.5 -0.5
mu 5e9 2 -0.5
beta 5e9 1 0
beta 5e9 1 -1
TABLE

CORRELATIONS=('.source.impacts / 20' '$a.correlation[1]' '$a.correlation[10]' '$t.correlation[1]' '$t.correlation[10]' '$c[50]'
    'if $s then among($a.white_correlation; 1; 51) else null end' 'if $s then among($t.white_correlation; 1; 51) else null end'
    '$w[50]' '$w[49]' '$w[51]' 'if $s then ([among($w; 0; 49), among($w; 52; 101)] | max) else null end')

correlations() {
    local setting kappa mu beta seed seeds
    for setting in '0.1 spline' '0.1 linear' '0.1 nearest' '1 spline' '3 spline' '10 spline'; do
        : > all.txt
        case $setting in *spline) seeds=$SEEDS ;; *) seeds=1 ;; esac
        while read -r _ kappa mu beta; do
            for seed in $seeds; do
                roll c "$setting" "$beta" "$kappa" "$mu" "$seed"
                look c
                fields c "${CORRELATIONS[@]}"
                fields c '$a.whiteness_p' '$t.whiteness_p' >> "white-${setting/ /-}"
                [ "$seed" != 1 ] || cp c.found "curves-${setting/ /-}-$kappa-$mu-$beta"
            done | means | tee -a all.txt | { [ "$setting" != '10 spline' ] || row "$kappa, $mu, $beta" >> ten.txt; cat > /dev/null; }
        done < ../sets
        awk '{ for (i = 1; i <= NF; i++) { if (NR == 1 || $i < low[i]) low[i] = $i; if (NR == 1 || $i > high[i]) high[i] = $i; bad[i] += $i == "-" } n = NF }
             END { for (i = 1; i <= n; i++) if (bad[i]) printf "%s ", "-"; else printf "%.3g..%.3g ", low[i], high[i]; print "" }' all.txt | sed 's/\.\./_to_/g' |
            row "${setting/ / um, }" | sed 's/_/ /g'
    done
}
# Of how many of the forces of a setting Ljung and Box's test takes the whitened series for white, at 1 %.
whitened() {
    awk -v what="${1/-/ um, }" '{ a += $1 > 0.01; t += $2 > 0.01 } END { printf "%s %d and %d of %d; ", what, a, t, NR }' "correlations/white-$1"
}

distributions() {
    local setting seed
    for setting in '0.1 spline' '1 spline' '3 spline' '10 spline'; do
        for seed in $SEEDS; do
            roll d "$setting" -0.5 5e9 1 "$seed"
            look d -o d.yaml --force --distribution table
            fields d '$a.white.gaussian_r2' '$a.white.gaussian_distance' '$a.white.skewness' '$a.white.kurtosis' '$t.white.gaussian_r2' '$t.white.gaussian_distance' '$t.white.skewness' '$t.white.kurtosis'
            if [ "$seed" = 1 ]; then
                for series in amplitude interval; do
                    cp d.$series.csv "density-$series-${setting% *}"
                    fields d '$a.white_deviation.value' '$t.white_deviation.value' > "deviations-${setting% *}"
                done
            fi
        done | over_seeds | row "${setting/ / um, }"
    done
}

# ------------------------------------------------------------------ figure 10, table I

SERIES=("\$t.mean.value * 1e3" "\$t.white_deviation.value * 1e3" "\$t.a1.value" "\$t.b1.value" "\$a.mean.value / $MASS" "\$a.mean.value / .source.greatest_n" "\$a.white_deviation.value / $MASS"
    "\$a.white_deviation.value / \$a.mean.value" "\$a.a1.value" "\$a.b1.value" "\$a.white_deviation.value / .source.greatest_n")

roughness() {
    local setting beta seed
    for setting in '0.1 spline' '1 spline' '3 spline' '10 spline'; do
        for beta in -1.5 -1.25 -1 -0.75 -0.5 -0.25 0; do
            for seed in $SEEDS; do
                roll r "$setting" "$beta" 3.3333333e9 1 "$seed"
                look r
                fields r "${SERIES[@]}"
            done > seeds.txt
            means < seeds.txt | sed "s/^/$beta /" >> "beta-${setting% *}"
            case $beta in -1.5 | -1 | -0.5 | 0) over_seeds < seeds.txt | row "${setting/ / um, }; $beta" ;; esac
        done
    done
    for setting in '0.1 linear' '0.1 nearest'; do
        for beta in -1.5 0; do
            for seed in $SEEDS; do
                roll r "$setting" "$beta" 3.3333333e9 1 "$seed"
                look r
                fields r "${SERIES[@]}"
            done | over_seeds | row "${setting/ / um, }; $beta"
        done
    done
}

# What counts as an impact: 10 um, beta 0.
prominence() {
    local share seed
    for share in 0.001 0.02 0.1 0.5; do
        for seed in $SEEDS; do
            roll p '10 spline' 0 3.3333333e9 1 "$seed"
            look p --prominence $share
            fields p '.source.impacts / 20' '$t.mean.value * 1e3' '$t.white_deviation.value * 1e3' '$t.a1.value' '$t.b1.value' '$a.a1.value' '$a.b1.value' '$w[50]'
        done | over_seeds | row $share
    done
}

# What else could differ from 002, on rough ground (beta 0).
elsewhere() {
    local what setting seed
    while IFS='|' read -r what setting options; do
        for seed in $SEEDS; do
            read -ra more <<< "$options"
            roll e "$setting" 0 3.3333333e9 1 "$seed" "${more[@]}"
            look e --prominence 0.1
            fields e '$t.mean.value * 1e3' '$t.white_deviation.value * 1e3' '$t.a1.value' '$t.b1.value' '$a.a1.value' '$a.b1.value'
        done | over_seeds | row "$what"
    done << TABLE
as above|10 spline|
linear|10 linear|
nearest|10 nearest|
mu 0.5|10 spline|--set contact.roll.mu=0.5
mu 2|10 spline|--set contact.roll.mu=2
integrator rk4|10 spline|--set contact.roll.integrator=rk4
the ground itself, not the curve of a ball of 1 cm; 3 um|3 spline|--set ball.radius=0.0001
TABLE
}

# ------------------------------------------------------------------ sections IV-D, IV-E

# singles LOW HIGH (cm/s): 25 single impacts of kappa 2e9, mu 1, evenly in the logarithm of their speed, dropped on level ground at 176.4 kHz; to singles.csv,
# one force with silence between, and laws.txt: speed, duration, greatest force.
singles() {
    local v
    : > force.txt
    : > laws.txt
    while read -r v; do
        render paper.yaml d --set surface.fractal=null --set motion=null --set "motion={path: still, at: [0, 0], duration: $(awk -v v="$v" 'BEGIN { printf "%.6f", v / 9.81 + 0.01 }') s}" \
            --set "contact.roll.kappa=2e9 $KAPPA" --set "contact.roll.drop=$(awk -v v="$v" 'BEGIN { printf "%.12g", v * v / 19.62 + (9.81 / 2e9) ^ (2 / 3) }') m" \
            --set output.sample_rate=176400 --set accuracy.contact_steps=40 --set 'output.diagnostics={rate: 176400, columns: [force_mean_n, penetration_m]}'
        awk -F, -v v="$v" 'NR > 1 { if ($2 > 0) { n++; f = $1 > 0 ? $1 : 0; if (f > most) most = f; print f } else if (n) exit }
            END { for (i = 0; i < 400; i++) print 0; print v, n / 176400, most >> "laws.txt" }' d.csv >> force.txt
    done < <(awk -v a="$1" -v b="$2" 'BEGIN { for (i = 0; i < 25; i++) print a / 100 * (b / a) ^ (i / 24) }')
    awk 'BEGIN { print "time_s,force_n" } { printf "%.9f,%s\n", (NR + 400) / 176400, $1 }' force.txt > singles.csv
}
# Exponents and R^2 by regression of logarithms: of duration over speed, over greatest force.
exponents() {
    awk '{ a = log($1); b = log($2); c = log($3); n++; x += a; xx += a * a; y += b; yy += b * b; z += c; zz += c * c; xy += a * b; zy += c * b }
         END { p = n * xy - x * y; q = n * zy - z * y; X = n * xx - x * x; Y = n * yy - y * y; Z = n * zz - z * z
               printf "%.3f, %.3f | %.3f, %.3f\n", -p / X, p * p / (X * Y), -q / Z, q * q / (Z * Y) }' laws.txt
}
laws() {
    local range
    for range in '0.1 5' '0.1 20' '0.1 50' '0.1 100'; do
        # shellcheck disable=SC2086
        singles $range
        rasp analyse singles.csv --json > s.found
        echo "| ${range/ / to } cm/s | $(exponents) | $(fields s .duration.theta_single .duration.r2_single_log .duration.r2_single | awk '{ printf "%.3f, %.3f (%.3f)", $1, $2, $3 }') | $(
            fields s '.shape.cosine_r2_5_50_95[]' | awk '{ printf "%.4f, %.4f, %.4f", $1, $2, $3 }') |"
        [ "$range" != '0.1 50' ] || cp singles.csv example.csv
    done
}
DURATIONS=(.duration.theta .duration.zeta_s*1e3 .duration.r2_log .duration.r2)
rolling_time() {
    local setting seed
    for setting in '0.1 spline' '1 spline' '3 spline' '10 spline' '20 spline'; do
        for seed in $SEEDS; do
            roll t "$setting" -1 2e9 1 "$seed"
            look t --single ../example.csv
            fields t "${DURATIONS[@]}" '.shape.cosine_r2_5_50_95[0]' '.shape.cosine_r2_5_50_95[1]' > both
            look t
            echo "$(cat both) $(fields t .duration.theta .duration.r2_log .duration.r2)"
        done | over_seeds | awk '{ print $2, $3, $4, $5, $6, $7, $8, $9 }' | row "${setting/ / um, }"
    done
}

# ------------------------------------------------------------------ papers/004

# k = lambda = 1e7 and 5 g: kappa = 2e9, mu = 1. 5.34 mm is the radius of 5 g of steel; 1 m of ground, ten times.
small() {
    render paper.yaml "$1" --set "contact.roll.kappa=2e9 $KAPPA" --set ball.mass='5 g' --set ball.radius='5.34 mm' --set 'motion={path: line, to: [10 m, 0], speed: 50 cm/s}' \
        --set "surface.fractal={exponent: -1.2, spectrum: $3, maximum: $2, pitch: 0.1 mm, length: 1 m}" --set seed="$4"
}
other_paper() {
    local spectrum height seed
    for spectrum in amplitude power; do
        for height in '1 nm' '0.1 um' '1 um' '10 um' '30 um' '100 um'; do
            for seed in $SEEDS; do
                small f "$height" $spectrum "$seed"
                look f
                echo "$(jq -r '.contacts[0].roll | "\(.contact_share) \(.lift_offs / 20)"' f.json) $(
                    fields f 'if $s then .source.impacts / 20 else null end' '$a.correlation[1]' '$a.correlation[10]' '$t.correlation[1]' '$t.correlation[10]' '$c[50]' '$w[50]' '$w[49]' '$a.white.gaussian_r2' '$t.white.gaussian_r2')"
                [ "$seed" != 1 ] || cp f.found "small-$spectrum-${height/ /}"
                if [ "$seed$spectrum$height" = '1power10 um' ]; then
                    look f -o f.yaml --force --distribution table
                    cp f.amplitude.csv f.interval.csv ..
                fi
            done | over_seeds | sed 's/+-0 / /g' | row "$spectrum, $height"
        done
    done
}
# What there is at 1 nm: ripples of which share of the weight.
ripples() {
    small f '1 nm' amplitude 1
    look f --prominence 1e-6
    fields f '.source.impacts / 20' '($a.variance | sqrt) / $a.mean.value'
}

# ------------------------------------------------------------------ pictures

# curve SETTING KAPPA MU BETA KIND: lags and values
curve() {
    jq -r --arg kind "$5" '.statistics as $s | if $kind == "cross" then $s.cross_correlation elif $kind == "white_cross" then $s.white_cross_correlation
            elif $kind == "a" then $s.amplitude_n.correlation elif $kind == "t" then $s.interval_s.correlation
            elif $kind == "white_a" then $s.amplitude_n.white_correlation else $s.interval_s.white_correlation end |
        (if length > 60 then 50 else 0 end) as $middle | to_entries[] | "\(.key - $middle) \(.value)"' "correlations/curves-$1-$2-$3-$4" > "$5-$2-$3-$4.dat"
}
# panel KIND COLUMN TITLE: what one panel of figure 4 holds
panel() {
    echo "set title \"$3\""
    case $2 in
        kappa) set -- "$1" 1e9-1--0.5 'kappa 1e9' 5e9-1--0.5 '5e9' 1e10-1--0.5 '1e10' ;;
        mu) set -- "$1" 5e9-0.5--0.5 'mu 0.5' 5e9-1--0.5 '1' 5e9-2--0.5 '2' ;;
        beta) set -- "$1" 5e9-1-0 'beta 0' 5e9-1--0.5 '-0.5' 5e9-1--1 '-1' ;;
    esac
    echo "plot \"$1-$2.dat\" with lines lw 1.5 lc rgb '#1f77b4' title \"$3\", \"$1-$4.dat\" with lines lw 1.5 dt 2 lc rgb 'black' title \"$5\", \"$1-$6.dat\" with lines lw 1.5 lc rgb '#d62728' title \"$7\""
}
panels() { # KIND TITLE
    local column
    for column in kappa mu beta; do panel "$1" $column "$2"; done
}
picture() {
    local kind kappa mu beta
    while read -r _ kappa mu beta; do
        for kind in cross a t white_cross white_a white_t; do curve 10-spline "$kappa" "$mu" "$beta" $kind; done
    done < sets
    {
        cat << PLOT
set terminal pngcairo size 1080,1000 font "sans,9"
set output "$ROOT/evidence/impacts_paper.png"
set multiplot layout 4,3 title "002, figures 4 and 6, at a maximum of 10 um; lags in impacts"
set yrange [-0.2:1.05]; set key top right; set xzeroaxis
PLOT
        echo 'set xrange [-50:50]'
        panels cross 'fig. 4: amplitude with interval'
        echo 'set xrange [0:50]'
        panels a 'fig. 4: amplitudes'
        panels t 'fig. 4: intervals'
        echo 'set xrange [-20:20]'
        panels white_cross 'fig. 6: whitened amplitude with interval'
    } | gnuplot
    {
        cat << PLOT
set terminal pngcairo size 1080,1000 font "sans,9"
set output "$ROOT/evidence/impacts_paper_white.png"
set multiplot layout 4,3 title "002, figure 8 (10 um) and figure 9"
set yrange [-0.2:1.05]; set key top right; set xzeroaxis; set xrange [0:50]
PLOT
        panels white_a 'fig. 8: whitened amplitudes'
        panels white_t 'fig. 8: whitened intervals'
        densities
        for height in 1 3 10; do density "distributions/density-amplitude-$height" "$(cut -d' ' -f1 "distributions/deviations-$height")" "fig. 9: whitened amplitudes, $height um"; done
        for height in 1 3 10; do density "distributions/density-interval-$height" "$(cut -d' ' -f2 "distributions/deviations-$height")" "fig. 9: whitened intervals, $height um"; done
    } | gnuplot
}
densities() { echo 'set datafile separator ","; set xrange [-4:4]; set yrange [0:0.65]; set xlabel "deviations"; set key top right; set fit quiet nolog; set samples 300'; }
# density FILE SIGMA TITLE: a table of density in deviations, and the normal curve nearest to it by least squares, as 002 takes its variance
density() {
    cat << PLOT
set title "$3"
middle = 0.1; width = 0.9
normal(x) = exp(-((x - middle) / width) ** 2 / 2) / (width * sqrt(2 * pi))
fit normal(x) '< grep -v ^# $1 | tail -n +2' using (\$1/$2):(\$2*$2) via middle, width
plot '< grep -v ^# $1 | tail -n +2' using (\$1/$2):(\$2*$2) with filledcurves y1=0 lc rgb '#a8cbe6' title 'found', normal(x) lw 2 lc rgb '#d62728' title sprintf('normal, %.2f', abs(width))
PLOT
}
# column NUMBER TITLE AT0 AT1: a panel of figure 10, with table I's ends
column() {
    local height
    echo "set title \"$2\""
    printf '$table << END\n-1.5 %s\n0 %s\nEND\nplot ' "$3" "$4"
    for height in 0.1 1 3 10; do printf '"roughness/beta-%s" using 1:%s with linespoints pt 7 ps 0.5 title "%s um", ' $height "$1" $height; done
    echo '$table with points pt 2 ps 2 lw 2 lc rgb "black" title "002, table I"'
}
law_picture() {
    local series
    {
        cat << PLOT
set terminal pngcairo size 1080,1000 font "sans,9"
set output "$ROOT/evidence/impacts_paper_law.png"
set multiplot layout 4,3 title "002, figure 10 and table I (kappa 1e10/3, mu 1; colours of all panels as in the first; 0.1 um is out of range in some); 004, figures 5 and 6"
set xrange [-1.6:0.1]; set xlabel "beta"; set key top left maxrows 3 samplen 1.5; set yrange [0:1.3]
PLOT
        column 3 'deviation of whitened intervals (ms)' 0.19 0.85
        echo 'unset key; set yrange [-1:-0.85]'
        column 4 'a1 of intervals' -0.97 -0.93
        echo 'set yrange [0:8]'
        column 2 'mean interval (ms)' 3.1 6.4
        echo 'set yrange [0:0.1]'
        column 12 'deviation of whitened amplitudes over the greatest' 0.04 0.04
        echo 'set yrange [-1:-0.85]'
        column 10 'a1 of amplitudes' -0.97 -0.93
        echo 'set yrange [0:1]'
        column 7 'mean amplitude over the greatest' 0.43 0.27
        echo 'set yrange [-1:0.5]'
        column 5 'b1 of intervals' -0.34 0.35
        echo 'set yrange [-0.1:0.5]'
        column 11 'b1 of amplitudes' 0.07 0.32
        echo 'set key top right; set yrange [-0.2:1.05]; set xzeroaxis; set xlabel "lag"; set xrange [-50:50]'
        echo 'set title "004, fig. 5b: 10 um (power)"'
        echo "plot 'five.dat' using 1:2 with lines lw 1.5 title 'intervals', '' using 1:3 with lines lw 1.5 title 'amplitudes', '' using 1:4 with lines dt 2 lw 1.5 lc rgb 'black' title 'cross'"
        echo 'set title "004, fig. 6a: whitened, 10 um (power)"; set xrange [-20:20]'
        echo "plot 'six.dat' using 1:2 with lines lw 1.5 title 'intervals', '' using 1:3 with lines lw 1.5 title 'amplitudes', '' using 1:4 with lines dt 2 lw 1.5 lc rgb 'black' title 'cross'"
        densities
        for series in amplitude_n interval_s; do
            density "f.${series%_*}.csv" "$(jq ".statistics.$series.white_deviation.value" other_paper/small-power-10um)" "004, fig. 6: whitened ${series%_*}s"
        done
    } | gnuplot
}
# three FILE PREFIX: lag, intervals, amplitudes, cross, for lags -50 to 50
three() {
    jq -r --arg p "$2" '.statistics as $s | range(-50; 51) as $k | (if $k < 0 then -$k else $k end) as $i |
        "\($k) \($s.interval_s[$p + "correlation"][$i]) \($s.amplitude_n[$p + "correlation"][$i]) \($s[$p + "cross_correlation"][$k + 50])"' "$1"
}

# ------------------------------------------------------------------ the page

part() {
    local name
    for name; do
        mkdir -p "$name"
        cp paper.yaml "$name"
        (cd "$name" && $name > "../$name.txt")
    done
}
mkdir laws && cp paper.yaml laws
(cd laws && laws > ../laws_table.txt && cp example.csv ..)
part correlations distributions &
other=$!
part roughness prominence elsewhere rolling_time other_paper ripples
wait $other
three other_paper/small-power-10um '' > five.dat
three other_paper/small-power-10um white_ > six.dat
picture
law_picture

cat << MD > report.md
# Impacts of the physical model, beside papers/002 and 004

Made by \`evidence/impacts_paper.sh\` with $(rasp --version): forces of \`contact.model: roll_coupled\` on rigid ground (one step per sample of 44.1 kHz, float64), analysed by \`rasp analyse --keep-modulation\`.
R = 1 cm, 20 cm/s, heights every 0.1 mm, 20 s over 1 m of ground, seeds 1 to 3, unless said otherwise; +- is the deviation over seeds. kappa in N/(m^1.5 kg), mu in s/m. Amplitudes: 002 does not state their unit; here N per
kg of ball, and over the greatest of the run, which has no unit. The papers' figures are here as their text describes them and table I prints them: no curve was read off.

**What is known from \`evidence/rolling.md\`** (section 4) and not repeated: at 0.1 um, the height that 002 states, the ball does not leave the ground whatever lies between the heights, as its weight alone presses it 1.6 um deep; at 10 um it bounces
as 002 shows. So each item is given for several heights.

## Summary

| 002, 004 | here | at |
|---|---|---|
| fig. 4: amplitudes and intervals have memory, "highly correlated" | yes: 0.88 to 0.97 between neighbours, 0.96 to 0.98 with each other | 10 um, all sets; from 3 um on nearly so |
| the same | no: amplitudes ring (memory, no impacts), intervals have none, no correlation | 0.1 um, spline, linear or nearest |
| fig. 6: whitened, "nearly a Dirac", "totally correlated" | in part: 0.60 to 0.72 at lag 0, but also 0.40 to 0.43 with the interval before | 10 um; less below |
| fig. 8: one pole and one zero whiten | yes: largest of 50 lags 0.05, all forces pass the test | 10 um (3 um: all but one) |
| fig. 9: Gaussian | yes: R^2 0.99 and more; intervals with long tails below 10 um | 1 to 10 um |
| fig. 10: intervals, their deviation, a1 and b1 grow with beta; amplitudes show no trend | yes, if amplitudes are over the greatest; in newtons they more than double | 3 and 10 um |
| table I, rho = 0 | 7 of 8 lie between the values of two heights; a1 of the intervals -0.957 for -0.97 | 1 to 10 um, b1 of the amplitudes 0.1 to 1 um; beta -1.5 |
| table I, rho = 1 | 5 of 8 within 15 %; over the greatest, amplitudes 0.38 for 0.27 and their sigma 0.051 for 0.04; b1 of intervals 0.0 for 0.35 | 10 um, beta 0 |
| theta = 0.23 (R^2 > 0.99), theta' = 0.29 (0.93) | 0.233 (0.995), 0.279 (0.929); by \`rasp analyse\` 0.290 (0.915) | single impacts with gravity, 0.1 to 50 cm/s |
| R^2 = 0.70 while rolling, theta' = 0.29 kept | 0.695 +- 0.05 | 10 um |
| raised cosines, 0.90 < R^2 < 0.99 | fitted 0.997 and more (0.1 to 5 cm/s); with duration and amplitude taken, 0.90 to 0.99 (rolling.md, section 3) | single impacts |
| 004, fig. 4: a series of impacts at 1 nm | no: in contact all the time, ripples of 2e-5 of the weight | 1 nm |
| 004, figs. 5, 6: memory, strong cross-correlation, white after one pole and zero, Gaussian | yes; the whitened cross-correlation in part (0.5 at lag 0, 0.3 to 0.4 before) | 100 um (amplitude spectrum), 10 um (power spectrum) |

No single height gives all of table I: its smooth end is that of 1 (amplitudes) to 6 um (intervals), its rough end that of 10 um. 002 says that its ends were "set according to" its simulations; they may lie further apart than those. At the height that it states nothing of it
comes out, with any interpolation. A slip of a unit, or another measure of height than the maximum, would explain that; the paper does not tell.

## 002, figures 4, 6 and 8: correlations

![figures 4 and 6](impacts_paper.png)

Least to greatest over the seven sets of figure 4 (kappa 1e9, 5e9, 1e10; mu 0.5, 1, 2; beta 0, -0.5, -1), each the mean of three seeds (linear and nearest: one). A: amplitudes, T: intervals, T_n follows A_n; C(k) at lag k; then A_n with T_n; then of the whitened series the
largest |C| of lags 1 to 50; and the whitened A_n with T_n, with T_(n-1) (the interval before), with T_(n+1), and the largest elsewhere.

| maximum | impacts/s | A: C(1) | C(10) | T: C(1) | C(10) | A with T | A white | T white | white: lag 0 | -1 | +1 | elsewhere |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat correlations.txt)

The sets at 10 um (kappa, mu, beta):

| set | impacts/s | A: C(1) | C(10) | T: C(1) | C(10) | A with T | A white | T white | white: lag 0 | -1 | +1 | elsewhere |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat correlations/ten.txt)

Forces whose whitened amplitudes, and intervals, pass for white (Ljung and Box, 20 lags, 1 %): $(for setting in 0.1-spline 0.1-linear 0.1-nearest 1-spline 3-spline; do whitened $setting; done)$(whitened 10-spline | sed 's/; $/./')

- Figure 4 is reproduced from 3 um on, for all sets; damping (mu) shortens the memory, stiffness hardly matters. At 1 um some sets still stay down for much of the time.
- At 0.1 um there is no series of impacts: the maxima are those of a ball that swings on its contact, at its own period whatever beta is. They drift in height (C_A(1) is high), their intervals do not follow.
- Figure 8 is reproduced at 10 um: 0.05 is what 50 lags of 3000 to 4000 white numbers reach. At 0.1 um one pole and one zero do not whiten the intervals.
- Figure 6 is reproduced in part. 002 takes the whitened cross-correlation for "nearly a Dirac delta"; here it is as narrow (two lags wide, 0.1 to 0.2 elsewhere), but not at lag 0 alone, and not 1: an impact's force follows from the speed that the ball
  brings from the flight before (lag -1), and decides on the flight after (lag 0); and each flight ends where the ground happens to be. 002's one process W_n for both is so an approximation. \`rasp analyse\` says so
  ("driven by one process only in part").

## 002, figure 9: distributions

![figures 8 and 9](impacts_paper_white.png)

kappa 5e9, mu 1, beta -0.5. R^2 of the density with a normal curve by least squares; Kolmogorov's distance to the normal distribution of the same deviation; skewness; kurtosis (3).

| maximum | A: R^2 | distance | skewness | kurtosis | T: R^2 | distance | skewness | kurtosis |
|---|---|---|---|---|---|---|---|---|
$(cat distributions.txt)

"Approximately Gaussian" holds for amplitudes at any height with bounces, for intervals in the middle of the density: below 10 um a few double maxima in one contact make tails (kurtosis), and the deviation of the fitted curve, which 002 takes, is 0.76 (1 um), 0.86 (3 um)
and 0.97 (10 um) of the series' own, which is what the tables here have.

## 002, figure 10 and table I

![figure 10, and 004](impacts_paper_law.png)

kappa 1e10/3, mu 1. sigma is that of the whitened series.

| maximum; beta | T: mean (ms) | sigma (ms) | a1 | b1 | A: mean (N/kg) | mean over greatest | sigma (N/kg) | sigma over mean | a1 | b1 | sigma over greatest |
|---|---|---|---|---|---|---|---|---|---|---|---|
| **table I, rho = 0** | 3.1 | 0.19 | -0.97 | -0.34 | | 0.43 | | 0.093 | -0.97 | 0.07 | 0.04 |
| **table I, rho = 1** | 6.4 | 0.85 | -0.93 | 0.35 | | 0.27 | | 0.148 | -0.93 | 0.32 | 0.04 |
$(cat roughness.txt)

- At 3 and 10 um all grows with beta as in 002: mean interval, its deviation, a1 and b1 of both. At 10 um and beta = 0: 6.0 ms, 0.88 ms, -0.92, -0.92 and 0.37 for 6.4 ms, 0.85 ms, -0.93, -0.93 and 0.32. At 3 um and beta = -1.5: 2.6 ms, 0.17 ms, -0.96, -0.96 for 3.1 ms, 0.19 ms, -0.97, -0.97.
- Amplitudes over the greatest of the run show no trend (0.35 to 0.41 at 10 um), and their sigma grows little (0.044 to 0.051; 0.032 to 0.045 at 3 um) where 002 has 0.04 at both ends; in N/kg mean and sigma more than double. So 002's amplitudes are normalised, most
  likely so.
- Not reproduced: 0.27 for the mean amplitude at rho = 1 (the greatest of a run depends on how long it is; 002 does not state it), and b1 = 0.35 of the intervals.
- At 0.1 um nothing of it: intervals of 2.35 ms at any beta.

**b1 of the intervals** depends on what counts as an impact, since a small maximum beside a large one parts an interval in two. 002 says "local maxima" and no more. 10 um, beta 0, by \`--prominence\` (0.02 is what \`rasp analyse\` takes, and the tables here):

| prominence | impacts/s | T: mean (ms) | sigma (ms) | a1 | b1 | A: a1 | b1 | white, lag 0 |
|---|---|---|---|---|---|---|---|---|
$(cat prominence.txt)

And with prominence 0.1 by what else 002 may have had otherwise (beta 0, 10 um):

| | T: mean (ms) | sigma (ms) | a1 | b1 | A: a1 | b1 |
|---|---|---|---|---|---|---|
$(cat elsewhere.txt)

Of these none gives 0.35. One maximum a contact gives 0.05 to 0.1; all others agree with table I as before, but for mu, which a1 tells from 1.

## 002, sections IV-D and IV-E: how long impacts last

25 single impacts of kappa = 2e9, mu = 1 on level ground, with gravity, speeds even in their logarithm, at 176.4 kHz. Exponents and R^2 by regression of logarithms; duration: that of the penetration. By \`rasp analyse\`: from the force alone, R^2 of the logarithms
(of the durations). Last R^2 of raised cosines fitted by it: 5 %, median, 95 %.

| speeds | theta, R^2 | theta', R^2 | theta' by rasp analyse | raised cosines |
|---|---|---|---|---|
| **002** | 0.23, > 0.99 | 0.29, 0.93 | | 0.90 to 0.99 |
$(cat laws_table.txt)

One range of speeds, 0.1 to 50 cm/s, gives theta, theta' and both R^2; over 0.1 to 5 cm/s, which 002 states for its rolling, theta' is 0.45 (rolling.md, section 3, has the other sets).

While rolling (beta -1), theta' = 0.290 of the single impacts kept, zeta' fitted, as 002 does it (\`--single\`); last theta' fitted to the rolling force itself:

| maximum | zeta' (ms N^0.29) | R^2 of logarithms | R^2 of durations | raised cosines, R^2: 5 % | median | theta' of its own | R^2 of logarithms | R^2 of durations |
|---|---|---|---|---|---|---|---|---|
| **002** | | | 0.70 | | | | | |
$(cat rolling_time.txt)

002's 0.70 is that of 10 um, if it is of durations (it does not say). rolling.md has far lower R^2 for the same law (0.1 at 10 um): it takes every contact, however slight, from its first to its last moment; here durations are those of maxima, by their flanks or by their
width at half height (\`src/analysis/impact_find.c\`). At 1 um theta' of its own is 1.1, an "absurd fit" as 002 met them, from which single impacts save. Raised cosines fit rolling impacts as well as single ones.

## papers/004, figures 4 to 6

k = 1e7 N/m^1.5, lambda = 1e7, 5 g (kappa = 2e9, mu = 1; radius, not stated: 5.34 mm, steel), 0.5 m/s, beta = 1.2, 1 m of ground ten times. 004's S is of amplitude or of power: both. White: of the whitened series, A_n with T_n and with T_(n-1); R^2 of the Gaussian fit.

| spectrum, maximum | in contact | lift-offs/s | impacts/s | A: C(1) | C(10) | T: C(1) | C(10) | A with T | white: lag 0 | -1 | A: R^2 | T: R^2 |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat other_paper.txt)

At 1 nm, the maximum that 004 states, the ball is in contact all the time: its weight presses it 2.9 um deep, 2900 times the largest height, and the force is the weight with ripples of $(awk '{ printf "%.1e", $2 }' ripples.txt) of it ($(awk '{ printf "%.0f", $1 }' ripples.txt) maxima a second; \`rasp analyse\` lists 1
impact and says why). Figure 4b's series of impacts needs heights 10000 times (power spectrum) or 100000 times (amplitude spectrum) as large. There figures 5b and 6 come out as described: strong memory, strong cross-correlation, white by one pole and one zero, nearly Gaussian; the whitened cross-correlation
again at two lags.
MD
mv report.md "$ROOT/evidence/impacts_paper.md"

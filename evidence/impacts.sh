#!/bin/bash
# Makes evidence/impacts.md and impacts.png: series of impacts drawn from their statistics, and found again (about 5 minutes on two cores). Needs gnuplot and jq.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
read -ra LIBS < <(pkg-config --libs sndfile yaml-0.1 fftw3 gsl jansson libebur128 libcrypto libpng soxr)
gcc -std=c11 -D_GNU_SOURCE -O2 -o judge "$ROOT/evidence/impacts_judge.c" -lsndfile -lfftw3 -lgsl -lgslcblas -lm
for program in coverage series; do
    gcc -std=c11 -D_GNU_SOURCE -O2 -I"$ROOT/src" -o ${program/coverage/cover} "$ROOT/evidence/impacts_$program.c" "$BUILD/librasp.a" "${LIBS[@]}" -lsleef -lm
done

# The force itself, in newtons, whole: nothing fades, and what begins before the end ends in the tail.
cat > force.yaml << YAML
rasp: 1
seed: 1
motion: {path: still, duration: 10 s}
contact: {model: impacts, impacts: {prototype: roll}}
load: {approach: 0 s, release: 0 s}
output: {sample_rate: 48 kHz, quantity: force, encoding: float64, level: {full_scale: 1 N}, tail: 0.1 s, ramp: 0, impacts: table}
YAML
cat > metal.yaml << YAML
include: [force.yaml]
surface: {space: {from: [-0.5, 0.866], dimension: 2, fundamental: 400 Hz}}
contact: {impacts: {prototype: space}}
YAML
printf 'time_s,angle_deg,radius\n0,0,1\n6,360,1\n8,360,0\n10,360,-1\n' > walk.csv
PLAIN=(--set 'output.level={full_scale: 1 m/s}' --set output.quantity=auto --set output.impacts=none)

# render SCENE NAME [OPTION...]
render() { rasp render "$1" -q -o "$2.wav" "${@:3}"; }

# ------------------------------------------------------------------ 1

coverage() {
    local n rho
    for n in 2000 5000 20000; do
        for rho in 0 0.25 0.5; do
            ./cover rasp $n $((n > 5000 ? 100 : 200)) $rho
        done
    done
}
biases() {
    local rho depth
    for rho in 0 0.5 1; do
        for depth in 0 0.3; do
            [ $rho$depth = 00 ] || [ $rho$depth = 0.50 ] || ./cover rasp 5000 60 $rho $depth
        done
    done
    ./cover own 5000 60 1
}

# forces RHO DEPTH: rows of means over seeds, of what is found in the listing and in the force.
FORCES=20
forces() {
    local rho=$1 depth=$2 seed file scale dir=forces-$1-$2
    mkdir -p "$dir"
    for seed in $(seq $FORCES); do
        render force.yaml "$dir/f" --set seed="$seed" --set contact.impacts.roughness="$rho" --set contact.impacts.modulation.depth="$depth" --set motion.duration='15 s' 2> /dev/null
        for file in impacts.csv wav; do
            [ $file = wav ] && scale=(--scale 1) || scale=()
            rasp analyse "$dir/f.$file" "${scale[@]}" --json 2> /dev/null | jq -r --argjson laid "$(jq '.contacts[0].impacts.count' "$dir/f.json")" '
                def e: .value, .error, .low, .high;
                [.source.impacts / $laid, (.duration | .zeta_s, .theta), (.statistics | (.modulation | if .found then .depth, .rate_hz else "-", "-" end),
                (.amplitude_n, .interval_s | (.mean | e), (.white_deviation | e), (.a1 | e), (.b1 | e)))] | join(" ")' >> "$dir/$file"
        done
    done
    for file in impacts.csv wav; do
        awk -v what="$rho, $depth | $([ $file = wav ] && echo force || echo listing)" -v rho="$rho" '
            BEGIN { split("0.43 0.04 -0.97 0.07 3.1e-3 0.19e-3 -0.97 -0.34", s, " "); split("0.27 0.04 -0.93 0.32 6.4e-3 0.85e-3 -0.93 0.35", r, " ") }
            {
                found += $1; zeta += $2; theta += $3
                if ($4 != "-") { held++; m += $4; nu += $5 }
                for (i = 1; i <= 8; i++) {
                    is = s[i] + rho * (r[i] - s[i]); at = 6 + 4 * (i - 1); z[i] += ($at - is) / $(at + 1); covered[i] += ($(at + 2) <= is && is <= $(at + 3))
                    off[i] += (i % 4 == 1 || i % 4 == 2) ? 100 * ($at / is - 1) : $at - is
                }
            }
            END {
                printf "| %s | %.4f |", what, found / NR
                for (i = 1; i <= 8; i++) printf (i % 4 == 1 || i % 4 == 2) ? " %+.1f %% (%+.2f; %d) |" : " %+.3f (%+.2f; %d) |", off[i] / NR, z[i] / NR, covered[i]
                printf " %+.2f %% | %.4f | %s |\n", 100 * (zeta / NR / 0.394e-3 - 1), theta / NR, held ? sprintf("%d: %.3f, %.3f Hz", held, m / held, nu / held) : "0"
            }' "$dir/$file"
    done
}
forces_flat() { local rho; for rho in 0 0.5 1; do forces $rho 0; done; }
forces_modulated() { local rho; for rho in 0 0.5 1; do forces $rho 0.3; done; }

# ------------------------------------------------------------------ 2

million() {
    local rho depth seed=0
    for rho in 0 0.5 1; do
        for depth in 0 0.3; do
            seed=$((seed + 1))
            ./series draw 1000000 $rho $depth $seed > draws
            ./judge statistics draws $rho $depth 2>> most.txt
        done
    done
}
# Over 40 seeds: how the differences scatter.
scatter() {
    local seed
    for seed in $(seq 101 140); do
        ./series draw 1000000 1 0 "$seed" > draws
        ./judge statistics draws 1 0 2> /dev/null
    done | grep -o '([-+][0-9.]*)' | tr -d '()' | awk '{ n++; square += $1 * $1; beyond += ($1 > 3 || $1 < -3) } END { printf "%d of them: rms %.2f, %d beyond 3", n, sqrt(square / n), beyond }'
}
rates() {
    local what rate same
    for what in roll scratch rub; do
        same=yes
        for rate in 22050 48000 192000; do
            render force.yaml $what$rate --set output.sample_rate=$rate --set contact.impacts.prototype=$what
            cmp -s ${what}22050.impacts.csv $what$rate.impacts.csv || same=NO
        done
        render force.yaml fine --set contact.impacts.prototype=$what --set accuracy.oversampling=32
        echo "| $what | $(($(wc -l < ${what}22050.impacts.csv) - 1)) | $same | $(./judge compare ${what}22050.wav ${what}192000.wav) | $(./judge compare ${what}48000.wav ${what}192000.wav) | $(./judge exact ${what}48000.wav ${what}48000.impacts.csv) | $(./judge exact fine.wav fine.impacts.csv) |"
    done | sed 's/\(e-[0-9]*\) \(-[0-9]*\) |/\1 dB | \2 dB |/g'
}
white() {
    local rate
    for rate in 22050 48000 192000; do
        echo "| $rate | $(./judge white rub$rate.wav 22.6757e-6 22.6757e-6 0.15) | $(./judge white scratch$rate.wav 10e-3 22.6757e-6 0.15) |"
        ./judge white rub$rate.wav 22.6757e-6 22.6757e-6 0.15 1 > white-$rate
    done | awk '{ printf "| %s | %s dB, %s (%d) | %s dB, %s |\n", $2, $4, $5, $6, $8, $9 }'
}
streams() { rates > rates.txt; white > white.txt; ./judge samples roll48000.wav 0.1 > roll.curve; }

# ------------------------------------------------------------------ 3

place() { echo --set "contact.impacts.space={angle: $1 deg, radius: $2}"; }
anchors() {
    local name angle radius seed
    while read -r name angle radius; do
        for seed in 1 2 3 4 5; do
            render metal.yaml a --set seed=$seed --set "contact.impacts.space={angle: $angle deg, radius: $radius}"
            echo "$(jq '.contacts[0].impacts.per_second' a.json) $(./judge moments a.wav)"
        done | awk -v what="$name" '
            { x[1] = $1; x[2] = $3; x[3] = $4; x[4] = $2; for (i = 1; i <= 4; i++) { s[i] += x[i] / 5; q[i] += x[i] * x[i] / 5; if (NR == 1 || x[i] < low[i]) low[i] = x[i]; if (NR == 1 || x[i] > high[i]) high[i] = x[i] } }
            END { printf "| %s |", what; for (i = 1; i <= 4; i++) printf " %.4g (%.4g to %.4g) |", s[i], low[i], high[i]; print "" }'
    done << TABLE
rub 0 1
scratch 120 1
roll 240 1
centre 0 0
rub-scratch 60 1
scratch-roll 180 1
roll-rub 300 1
TABLE
}
walk() {
    local k angle radius
    render metal.yaml walked --set 'contact.impacts.space={walk: walk.csv}' --set accuracy.oversampling=32
    render metal.yaml heard --set 'contact.impacts.space={walk: walk.csv}' "${PLAIN[@]}"
    for k in $(seq 0 40); do
        read -r angle radius < <(awk -v t="$(awk "BEGIN { print $k / 4 }")" 'BEGIN { print t < 6 ? 60 * t : 0, t < 6 ? 1 : 1 - (t - 6) / 2 }')
        render metal.yaml stays --set seed=$((k + 2)) --set "contact.impacts.space={angle: $angle deg, radius: $radius}" "${PLAIN[@]}"
        ./judge bend stays.wav 1
    done > stays.txt
    # The last of 20.2 pieces is the tail.
    ./judge bend heard.wav 202 | awk '{ k = int((NR - 1) / 10); if ($1 > most[k]) most[k] = $1 } END { for (k = 0; k < 20; k++) print most[k] }' > bends.txt
    awk 'NR == FNR { stays[FNR - 1] = $1; next } { most = 0; for (k = 2 * FNR - 2; k <= 2 * FNR; k++) if (stays[k] > most) most = stays[k]; r = $1 / most; if (r > worst) worst = r; sum += r }
        END { printf "%.2f at most, %.2f on average", worst, sum / FNR }' stays.txt bends.txt > bend.txt
    ./judge exact walked.wav walked.impacts.csv > walk-exact.txt
    ./judge click walked.wav 8.9 1e-5 clicked.wav
    echo "a step of 0.01 mN, $(./judge moments walked.wav | awk '{ printf "%.2f", 1e-3 / $1 }') % of the rms force, put into it makes that $(./judge exact clicked.wav walked.impacts.csv)" > walk-step.txt
    ./series walk walk.csv > walk-steps.txt
    ./judge image walked.wav > walk.image
    awk -F, 'NR > 1 { n[int($1 / 0.1)]++ } END { for (i = 0; i < 100; i++) print (i + 0.5) / 10, n[i] * 10 }' walked.impacts.csv > walk.density
}
space() { walk; anchors > anchors.txt; }

# ------------------------------------------------------------------ 4

# One row per scene: control, set, value, duration ms, centroid Hz, rate Hz, rate laid, spread, impacts; problems to problems.txt.
controls() {
    local scene name control size velocity roughness
    for scene in "$ROOT"/scenes/experiments/002_controls/*.yaml; do
        name=$(basename "$scene" .yaml)
        IFS=_ read -r control _ size _ velocity _ roughness <<< "$name"
        render "$scene" sound 2>> problems.txt
        jq -r 'select((.warnings | length) > 0 or .sound.silent or .sound.peak_dbfs > 0 or .sound.rms_dbfs < -30) | .scene' sound.json >> problems.txt
        render "$scene" struck --set output.quantity=force --set output.impacts=table --set output.encoding=float64
        render "$scene" even --set output.quantity=force --set output.encoding=float64 --set contact.impacts.modulation.depth=0
        echo "$control $size $velocity $roughness $(awk -F, 'NR > 1 { d += $4; m += $3; q += $3 * $3; n++ } END { printf "%.4f %.3f", d / n * 1e3, sqrt(q / n - (m / n) ^ 2) / (m / n) }' struck.impacts.csv) $(./judge moments struck.wav | cut -d' ' -f2) $(./judge modulation struck.wav even.wav) $([ "$control" = roughness ] && rasp analyse struck.wav --scale 1 --json 2> /dev/null | jq '.statistics.interval_s | (.variance | sqrt) / .mean.value' || echo -)"
    done > controls.all
    rows size '$3' '$2' '"V = " $3 ", rho = 0.5"' 'sprintf("%.3f ms, %.0f Hz", $5, $7)'
    rows velocity '$2' '$3' '"S = " $2 ", rho = 0.75"' 'sprintf("%.2f Hz (%.2f), m %.2f", $8, 3 * $3 / $2, $9)'
    rows roughness '$2' '$4' '"S = " $2 ", V = 0.5"' 'sprintf("%.3f (%.3f)", $6, $10)'
}
# rows CONTROL SET VALUE TITLE CELL: awk's words for its set, its value, the row's title and its cells.
rows() {
    awk -v c="$1" '$1 == c { print '"$2"', '"$3"', $0 }' controls.all | sort -k1,1g -k2,2g | cut -d' ' -f3- |
        awk -v c="$1" '{ key = '"$4"'; if (key != last) printf "%s| %s | %s |", (NR > 1) ? "\n" : "", c, key; last = key; printf " %s |", '"$5"' } END { print "" }'
}
# Does column COLUMN of controls.all rise (or fall) along each set?
monotonic() { # CONTROL SET VALUE COLUMN SIGN
    awk -v c="$1" -v s="$2" -v v="$3" -v x="$4" -v sign="$5" '$1 == c { print $s, $v, sign * $x }' controls.all | sort -k1,1g -k2,2g |
        awk '$1 == set && $3 <= last { wrong++ } { set = $1; last = $3 } END { print wrong ? wrong " steps the wrong way" : "all 12 steps" }'
}
monotonics() {
    echo "Monotonic in its control: duration by size $(monotonic size 3 2 5 1); centroid falling with size $(monotonic size 3 2 7 -1); rate by velocity $(monotonic velocity 2 3 8 1); spread by roughness $(monotonic roughness 2 4 6 1), as found in the forces $(monotonic roughness 2 4 10 1)."
}
continuum() {
    local i scene
    for i in $(seq -w 30); do
        scene=$ROOT/scenes/experiments/004_continuum/step_$i.yaml
        render "$scene" step --set output.impacts=table 2>> problems.txt
        jq -r 'select((.warnings | length) > 0 or .sound.silent or .sound.peak_dbfs > 0 or .sound.rms_dbfs < -45) | .scene' step.json >> problems.txt
        render "$scene" bare --set output.quantity=force --set output.encoding=float64 --set contact.gesture=null
        echo "$i $(jq -r '[(.scene | split(" ")[0]), .contacts[0].impacts.count / 2, .contacts[0].impacts.limited_intervals, .sound.rms_dbfs] | join(" ")' step.json) $(./judge moments bare.wav | cut -d' ' -f3)"
    done > continuum.all
    awk '{ printf "| %s | %s | %.0f | %.2f | %.1f | %.3g |\n", $1, $2, $3, 100 * $4 / 2 / $3, $5, $6 }' continuum.all | sed -n '1p;4p;7p;10p;13p;16p;19p;22p;25p;28p;30p'
    awk 'NR > 1 && $3 <= last { wrong++ } NR > 1 && $6 >= peaky { blunt++ } { last = $3; peaky = $6 } END { printf "Steps of 29 in which the count does not rise: %d; in which the excess kurtosis does not fall: %d.\n", wrong, blunt }' continuum.all > continuum.end
}
durations() {
    local name
    for name in by_amplitude fixed; do
        render "$ROOT/scenes/experiments/004_durations/$name.yaml" $name --set output.impacts=table --set output.encoding=float64 --set 'output.level={full_scale: 1 N}'
        ./judge bands $name.wav > $name.bands
    done
    cmp <(cut -d, -f1-3 by_amplitude.impacts.csv) <(cut -d, -f1-3 fixed.impacts.csv) > /dev/null && echo same || echo OTHER
    paste by_amplitude.bands fixed.bands | awk '$1 == 200 || $1 == 501 || $1 == 1000 || $1 == 1585 || $1 == 1995 || $1 == 2512 || $1 == 3162 || $1 == 3981 || $1 == 6310 || $1 == 10000 { f = f " " $1 " |"; d = d sprintf(" %+.1f |", $2 - $4) } END { print "| Hz |" f; print "| dB |" d }'
    for name in by_amplitude fixed; do
        awk -F, 'NR > 1 { n++; s += $4; if (n == 1 || $4 < low) low = $4; if ($4 > high) high = $4 } END { printf "%.3f ms (%.3f to %.3f)\n", s / n * 1e3, low * 1e3, high * 1e3 }' $name.impacts.csv
        ./judge moments $name.wav
    done > durations.end
}
stimuli() { : > problems.txt; controls > controls.txt; monotonics > monotonics.txt; continuum > continuum.txt; durations > durations.txt; }

# ------------------------------------------------------------------ 5

# Least CPU time, of 3 renders, of the stage `impacts` and of all, in s; and the number of impacts.
cpu() {
    local k
    for k in 1 2 3; do
        render force.yaml timed --set output.impacts=none --set output.encoding=pcm24 --set output.level.full_scale='100 N' "$@" 2> /dev/null
        jq -r '[([.contacts[0].stages[] | select(.stage == "impacts") | .cpu_s] | add), .cpu_s, .contacts[0].impacts.count, .frames] | join(" ")' timed.json
    done | awk 'NR == 1 || $1 < a { a = $1 } NR == 1 || $2 < b { b = $2 } { c = $3; n = $4 } END { print a, b, c, n }'
}
costs() {
    local rate name mega
    mega=$(./judge hertz)
    custom() { cpu --set "contact.impacts={prototype: custom, amplitude: {mean: 1, deviation: 0.1, a1: -0.9}, interval: {mean: $1 us, deviation: $(awk "BEGIN { print 0.05 * $1 }") us, a1: -0.9}, duration: {zeta: $2 us, theta: $3}, floor: {interval: 1 us}}" --set motion.duration="$4 s"; }
    local base
    base=$(custom 1e6 500 0 20 | cut -d' ' -f1)
    row() { awk -v mega="$mega" -v what="$1" -v base="$base" -v s="$2" '{ printf "| %s | %.0f | %.1f | %.0f | %.0f | %.0f |\n", what, $3 / s, $1 * mega * 1e6 / $4, ($1 - base * s / 20) * mega * 1e6 / $3, $2 * mega * 1e6 / $4, s / $2 }'; }
    while read -r name rate; do
        custom "$rate" 500 0.29 20 | row "custom, $name a second, 0.5 ms, theta 0.29" 20
        custom "$rate" 22.7 0 20 | row "the same, 22.7 us, theta 0" 20
    done << TABLE
10 100000
1000 1000
100000 10
TABLE
    for name in roll scratch rub; do
        cpu --set contact.impacts.prototype=$name --set motion.duration='20 s' | row $name 20
    done
    cpu --set 'contact.impacts={prototype: space, space: {radius: 0}}' --set motion.duration='20 s' | row 'disk, centre' 20
    cpu --set 'contact.impacts={prototype: space, space: {angle: 5 deg}}' --set motion.duration='20 s' | row 'disk, near rub (5 degrees)' 20
}
memory() {
    local name s
    for name in roll rub; do
        for s in 1 60 3600; do
            [ $name$s = rub3600 ] && s=600
            /usr/bin/time -f %M -o peak.txt rasp render force.yaml -q -o long.wav --set output.impacts=none --set output.encoding=pcm16 --set output.level.full_scale='10 N' --set output.sample_rate=8000 --set contact.impacts.prototype=$name --set motion.duration="$s s" 2> /dev/null
            echo "| $name | $s s | $(jq .contacts[0].impacts.count long.json) | $(awk '{ printf "%.1f", $1 / 1024 }' peak.txt) MB | $(jq '[.contacts[0].stages[] | select(.stage == "impacts") | .bytes] | add' long.json) |"
            rm long.wav
        done
    done
}

# ------------------------------------------------------------------ picture

picture() {
    local control
    for control in size velocity roughness; do
        awk -v c=$control '$1 == c { set = (c == "size") ? $3 : $2; x = (c == "size") ? $2 : (c == "velocity") ? $3 : $4; print set, x, $7, $8, $6 }' controls.all | sort -k1,1g -k2,2g |
            awk 'NR > 1 && $1 != last { print ""; print "" } { print; last = $1 }' > $control.dat
    done
    gnuplot << PLOT
set terminal pngcairo size 1300,900 font "sans,9"
set output "$ROOT/evidence/impacts.png"
set multiplot layout 3,3
set palette defined (0 "black", 0.4 "#602080", 0.7 "#e06030", 1 "#ffffa0")
set title "Walk: rub, scratch, roll, rub, centre, beyond: force, dB"
set xrange [0:10]; set yrange [2:4.33]; set cbrange [-140:-60]; set xlabel "s"; set ylabel "Hz"; set ytics ("100" 2, "300" 2.477, "1000" 3, "3000" 3.477, "10000" 4); set colorbox
plot "walk.image" using 1:2:3 with image notitle
set ytics autofreq; unset colorbox
set title "Impacts a second on the way"; set logscale y; set format y "10^{%L}"; set yrange [10:1e5]; set ylabel ""
set xtics ("rub" 0, "scratch" 2, "roll" 4, "rub" 6, "centre" 8, "beyond" 10) ; set xlabel ""
plot "walk.density" with lines lw 2 notitle
set xtics autofreq; set xrange [*:*]; set yrange [*:*]; unset logscale; set format y "%g"
set title "Rub: power against 2 s^2/dT |Phi|^2"; set logscale x; set xrange [90:6e4]; set yrange [-78:-64]; set xlabel "Hz"; set ylabel "dB re N^2/Hz"; set key bottom left
plot "white-192000" using 1:2 with points pt 6 title "192 kHz", "white-48000" using 1:2 with points pt 1 title "48 kHz", "white-22050" using 1:2 with points pt 2 title "22.05 kHz", "white-192000" using 1:3 with lines lw 2 title "closed form"
unset logscale; set xrange [0:1]; set yrange [*:*]; set key top right
set title "Size: centroid of the force"; set xlabel "S"; set ylabel "Hz"; set logscale y
plot for [i=0:2] "size.dat" index i using 2:3 with linespoints title "V = ".word("0.1 0.5 1", i+1)
set title "Velocity: modulation found in the force"; set xlabel "V"; set ylabel "Hz"; set key bottom right
plot for [i=0:2] "velocity.dat" index i using 2:4 with linespoints title "S = ".word("0.1 0.3 0.5", i+1)
unset logscale
set title "Roughness: deviation over mean of the intervals"; set xlabel "rho"; set ylabel ""; set yrange [0:0.5]
plot for [i=0:2] "roughness.dat" index i using 2:5 with linespoints title "S = ".word("0.1 0.5 0.9", i+1)
set yrange [*:*]; set xrange [0:31]; set logscale y; set format y "10^{%L}"
set title "Thirty steps from scratching to rubbing"; set xlabel "step"; set ylabel ""; set key top center
plot "continuum.all" using 1:3 with points pt 7 title "impacts a second, counted", "" using 1:2 with lines title "asked", "" using 1:6 with points pt 6 title "excess kurtosis of the force"
unset logscale; set format y "%g"; set logscale x; set xrange [90:2e4]; set xlabel "Hz"; set ylabel "dB"; set key bottom left
set title "The same impacts, durations by amplitude or fixed"
plot "by_amplitude.bands" with lines lw 2 title "by amplitude", "fixed.bands" with lines lw 2 title "fixed"
unset logscale; set xrange [0:0.1]; set yrange [*:*]; set key top right; set xlabel "s"; set ylabel "N"
set title "Roll, rho = 0.5: force"
plot "roll.curve" with lines notitle
PLOT
}

# ------------------------------------------------------------------ the page

# Two at a time, each in a folder of its own; what is timed comes last, alone.
part() {
    local name
    for name; do
        mkdir "$name"
        ln -s ../judge ../series ../cover ../force.yaml ../metal.yaml ../walk.csv "$name"
        (cd "$name" && $name > ../"$name".txt)
    done
}
part coverage million scatter streams stimuli &
other=$!
part forces_flat forces_modulated space biases
wait $other
for name in stimuli space streams million; do
    find $name -type f \( -name '*.txt' -o -name '*.all' -o -name '*.image' -o -name '*.density' -o -name '*.bands' -o -name '*.end' -o -name '*.curve' -o -name 'white-*' \) -exec ln -sf {} . \;
done
picture
part costs memory

cat << MD > report.md
# Series of impacts

Made by \`evidence/impacts.sh\` with $(rasp --version) on $(uname -m), $(getconf _NPROCESSORS_ONLN) processors: rasp from the command line, its functions by \`evidence/impacts_coverage.c\` and
\`impacts_series.c\`, and beside it \`impacts_judge.c\`, which shares no line with rasp (GSL's generator and quadrature, FFTW). Prototype roll is papers/002's table I, linear in rho;
A without unit (N here), dT the time to the next impact.

![walk, rubbing, controls, continuum, durations](impacts.png)

## 1. Found again

**From series.** Share of seeds, in %, whose 95 % interval holds the truth, and in brackets the mean of (estimate - truth)/error; series by rasp, m = 0; 200 seeds, of n = 20000 100. Wanted is
95 +- 4; chance alone spreads 95 % of such cells over 92 to 98 (200 seeds) or 90.5 to 99 (100).

| from | n | rho | A: mean | deviation | a1 | b1 | dT: mean | deviation | a1 | b1 | draws floored, % | modulation found, % |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat coverage.txt)

$(awk -F'|' '$3 + 0 <= 5000 { for (i = 5; i <= 12; i++) { n++; sum += $i; if ($i + 0 < 91 || $i + 0 > 99) out = out sprintf(" %.1f (n = %d, rho = %g);", $i, $3, $4) } } END { printf "n of 2000 and 5000: %d cells, %.1f %% on average; outside 91 to 99:%s\n", n, sum / n, out == "" ? " none." : out }' coverage.txt)
The deviation of A comes out too small, as 0.8 to 1.1 % of its draws are floored: what is raised takes away from the scatter. That bias stays as n grows while errors shrink: a quarter of an error at n = 2000,
half of one at 5000, one and more at 20000, where its interval holds the truth too seldom. \`analyse\` warns of impacts at a floor where it reads a listing, modulated or not; in a force
impacts at the floor come close together and merge, and it says that it cannot tell. \`marginal: lognormal\` has no floor.

**What floors and modulation bring**, n = 5000, 60 seeds; the same columns, last m and its bias. "own" is a plain recursion by GSL's generator, of which only intervals are floored.

| from | n | rho | A: mean | deviation | a1 | b1 | dT: mean | deviation | a1 | b1 | draws floored, % | modulation found, % | m |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat biases.txt)

A modulation of m = 0.3 is found in every series, and dividing it out costs nothing that can be seen; where there is none one is found about once in a thousand, as its test promises. At rho = 1, where 3 %
of amplitudes and 2 % of intervals are floored, both deviations are too small by an error or more; the rest still holds.

**From forces**, 48 kHz, 15 s, $FORCES seeds: \`rasp analyse\` of the listing and of the force alone. Mean bias in % (of a1, b1 itself), in brackets over the standard error, and of how many seeds the interval holds the
truth. The seeds are the same in all rows: a mean of $FORCES scatters by 0.22 errors, and in the same way in every row. What merging brings is a force's row less its listing's.

| rho, m | from | found/laid | A: mean | deviation | a1 | b1 | dT: mean | deviation | a1 | b1 | zeta | theta (0.29) | modulation found: m, nu (3 Hz) |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
$(cat forces_flat.txt forces_modulated.txt)

Impacts merge where their intervals are shorter than they last: none at rho = 0, 0.8 % at 0.5, 3 % at 1, of which two thirds stand at the floor of 23 us and cannot be parted. The mean interval rises by as much,
the mean amplitude too, as two become one, and b1 of the intervals falls a little. zeta and theta are found to 0.2 % and 0.003. Floors show in the listing's rows at rho = 1: deviations 2 % too small.

## 2. A million impacts

Prototype roll; predicted, and in brackets rasp's difference over its standard error (batches of 10000 impacts, so that the series' memory counts). m = 0: the stationary Gaussian law censored
at the floor, means and shares in closed form, correlations by quadrature over the bivariate law; m = 0.3: mean, variance and share likewise, correlations from 1e7 impacts of a plain recursion.

| rho | m | of | mean | variance | floored, % | lag 1 | lag 2 | lag 3 | lag 4 | lag 5 |
|---|---|---|---|---|---|---|---|---|---|---|
$(cat million.txt)

Largest of all: $(sort -g most.txt | tail -n 1) standard errors. The same for 40 further seeds (rho = 1, m = 0): $(cat scatter.txt); were all predictions exact and all numbers independent, it would be 1.00 and 2.

**Sample rates.** The same 10 s at 22.05, 48 and 192 kHz: are the listings the same, byte for byte; largest difference between third octaves from 100 Hz to 9 kHz; largest power of the difference itself, sample by sample in
time, over a band's power. Last, at 48 kHz, the force's transform against the sum of its listing's raised cosines in closed form, 20 Hz to 18 kHz, over its rms, with the 8 sub-intervals a sample that are the
default, and with 32: what impacts of 23 us have beyond the sub-intervals' rate folds back.

| prototype | impacts | listings the same | 22.05 against 192 kHz | difference | 48 against 192 kHz | difference | force against listing | with 32 |
|---|---|---|---|---|---|---|---|---|
$(cat rates.txt)

**White force.** Third octaves of 10 s against 2 s^2/dT |Phi(f)|^2, Phi a raised cosine's transform, up to 0.45 of the rate: largest difference, and rms over what noise of that length must scatter by (of scratch, whose
impacts are few, with their shot noise).

| Hz | rub (bands) | scratch |
|---|---|---|
$(cat white.txt)

## 3. Round the disk and through its centre

10 s: 6 s once round the rim from rub by scratch and roll back to rub, then 4 s through the centre to the far side. **No click:** (1) the law moves in small steps: in 0.1 ms zeta, theta, means, rms amplitude and depth go
by $(cut -d' ' -f1-6 walk-steps.txt | tr ' ' '\n' | sort -g | tail -n 1) of their span at most, between $(cut -d' ' -f7 walk-steps.txt) and $(cut -d' ' -f8 walk-steps.txt) impacts a second. (2) The force is the impacts of its listing and nothing else: the largest difference of its transform from that of their sum is $(cat walk-exact.txt) of
the rms (32 sub-intervals a sample); $(cat walk-step.txt). (3) Through the response of a metal object the largest second difference of each half second is, over the
largest in 10 s each at three places that it passes, other seeds: $(cat bend.txt). Seeds differ by more than that themselves.

**The anchors**, 5 seeds of 10 s, mean (least to greatest); centroid of the power and excess kurtosis of the force alone, up to 21.6 kHz.

| place | impacts a second | centroid (Hz) | excess kurtosis | rms (N) |
|---|---|---|---|---|
$(cat anchors.txt)

Rub and scratch have the same impacts, hence the same spectrum; their densities are apart by a factor of 440, and the force's kurtosis, the measure of it that needs no listing, by 10^4. Roll is apart from both by its
centroid, a tenth of theirs, and from scratch by twice its density. No two ranges by which they are told apart touch. Halfway between scratch and roll impacts are fewer than at either: there 004's equations
lay roll's filter, whose gain at frequency 0 is well above 1, on scratch's exponential intervals. Scratch is 27 dB below both: single impacts of a few hundredths of a millisecond.

## 4. The controls of papers/002, section VI, and the continuum of papers/004

\`scenes/experiments/002_controls\`: five steps of a control, three sets each; 45 scenes, $([ -s problems.txt ] && echo "with warnings, silent, too loud or too soft: $(tr '\n' ' ' < problems.txt)" || echo 'none of which warns, is silent, clipped or below -30 dBFS rms').
Size: mean duration of the impacts and centroid of the force. Velocity: rate of modulation found in the envelope of the force (rms of 10 ms, over the envelope of the same scene with m = 0), in brackets 3 V/S; its depth in the rms
is 0.3 (1 - 0.29/2) = 0.26, as louder impacts are shorter, and less where 10 ms are no longer short. Roughness: deviation over mean of the intervals listed, in brackets as \`rasp analyse\` finds it in the force (the same seed: the same series in all three sets).

| control | set | 1 | 2 | 3 | 4 | 5 |
|---|---|---|---|---|---|---|
$(cat controls.txt)

$(cat monotonics.txt)

\`scenes/experiments/004_continuum\`: thirty steps from scratching to rubbing, 2 s each; the excess kurtosis is that of the force without gesture.

| step | impacts a second, asked | counted | at the floor of 1 us, % | rms of the sound, dBFS | excess kurtosis |
|---|---|---|---|---|---|
$(cat continuum.txt)

$(cat continuum.end)

\`scenes/experiments/004_durations\`: the same impacts with durations by amplitude and with one. Times, amplitudes and intervals listed: $(sed -n 1p durations.txt). Durations by amplitude
$(sed -n 1p durations.end), fixed $(sed -n 3p durations.end). Centroid $(sed -n 2p durations.end | cut -d' ' -f2) against $(sed -n 4p durations.end | cut -d' ' -f2) Hz. By amplitude less fixed, in third octaves:

$(sed -n 2p durations.txt)
|---|---|---|---|---|---|---|---|---|---|---|
$(sed -n 3p durations.txt)

So loud impacts, which are shorter, carry more above their common zeros, and the holes that one common duration tears at 2/t0, 3/t0 and so on (3.7 kHz, 5.6 kHz) are filled.

## 5. What it costs

48 kHz, 20 s, force alone, least of three; $(./judge hertz) million cycles a second. "of the stage" is the series and its impacts on the 8 sub-intervals of a sample; "an impact" what the stage takes beyond a silent one; "all" the
whole render.

| scene | impacts a second | cycles a sample, of the stage | cycles an impact | cycles a sample, all | times real time |
|---|---|---|---|---|---|
$(cat costs.txt)

An impact costs what its length in sub-intervals costs: some $(awk -F'|' '/1000 a second/ { long = $5 } /the same/ { if (!short) short = $5 } END { printf "%.0f", (long - short) / ((500 - 22.7) * 0.048 * 8) }' costs.txt) cycles for each, and a few hundred for its draws.

Memory at its greatest, force alone at 8 kHz (resident; bytes that the stage asks for):

| prototype | length | impacts | memory | stage, bytes |
|---|---|---|---|---|
$(cat memory.txt)
MD
mv report.md "$ROOT/evidence/impacts.md"

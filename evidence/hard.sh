#!/bin/bash
# Makes evidence/hard.md: hard cases with what came out and what must (tests/hard/list, all rows), on this machine; and evidence/hard.png of that table.
# `evidence/hard.sh picture` draws the picture alone.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/hard.md}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
new=$WORK/hard.md

# picture: evidence/hard.png from the table: what came out beside its bound, of solved contacts' energy and of errors
picture() {
    local key
    for key in energy error; do
        awk -F' *[|] *' -v key="$key" '
            $4 == "holds" && match($5, key " [^,]*") {
                measured = substr($5, RSTART + length(key) + 1, RLENGTH - length(key) - 1)
                match($6, key " < [^,]*")
                print ++n "\t" $2 "\t" measured "\t" substr($6, RSTART + length(key) + 3, RLENGTH - length(key) - 3)
            }' "$REPORT" > "$WORK/$key"
    done
    gnuplot << END
set terminal pngcairo size 1100,520 font 'sans,10'
set output '$WORK/hard.png'
set datafile separator '\t'
set multiplot
set grid xtics linewidth 0.5 linecolor rgb '#dddddd'
set ytics scale 0
set yrange [] reverse
set offsets 0, 0, 0.7, 0.7
set bmargin at screen 0.11
set tmargin at screen 0.92
set key outside center top horizontal samplen 1
set lmargin at screen 0.15
set rmargin at screen 0.43
set logscale x
unset mxtics
set xrange [1e-17:1e-2]
set xtics 1e-16, 1e4, 1e-4
set format x '10^{%L}'
set xlabel 'energy missing at the end, of the greatest'
plot '$WORK/energy' using 3:1:(\$4-\$3):(0):ytic(2) with vectors nohead linecolor rgb '#bbbbbb' notitle, \
    '' using 3:1 with points pointtype 7 linecolor rgb '#0072b2' title 'measured', \
    '' using 4:1 with points pointtype 2 linecolor rgb '#d55e00' title 'at most'
unset logscale x
set lmargin at screen 0.66
set rmargin at screen 0.97
set xrange [-150:-30]
set xtics -140, 20, -40
set format x '%g'
set xlabel 'error against every knob twice as fine, dB'
plot '$WORK/error' using 3:1:(\$4-\$3):(0):ytic(2) with vectors nohead linecolor rgb '#bbbbbb' notitle, \
    '' using 3:1 with points pointtype 7 linecolor rgb '#0072b2' title 'measured', \
    '' using 4:1 with points pointtype 2 linecolor rgb '#d55e00' title 'at most'
END
    mv "$WORK/hard.png" "$ROOT/evidence/hard.png"
}

if [ "${1-}" = picture ]; then
    picture
    exit
fi
{
    cat << 'END'
# Hard cases

Made by `evidence/hard.sh` from the rows of `tests/hard/list`; `tests/hard/run` prints the same, `tests/hard/run WORD` some of them. Every render is
with `--traps` (it would stop at an invalid operation and name the stage), and every sample is finite. Forces in N, sounds in the
scene's unit; error: dB, measured by `--verify`; like and level: dB, against the same scene with the setting that is named; energy: what a solved
contact's energy lacks, of the greatest. For a scene of one's own: `rasp render SCENE --traps --verify`.
That the rows notice what is wrong is shown by faults that are planted: [faults.md](faults.md). Random scenes: [torture.md](torture.md).

![what solved contacts lack of energy, and errors, each beside what it may be at most](hard.png)

END
    "$ROOT/tests/hard/run" --rasp "${BUILD:-$ROOT/build}/rasp" --markdown --long
} > "$new"
cp "$new" "$REPORT"
picture
tail -n 1 "$REPORT"

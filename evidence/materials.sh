#!/bin/bash
# Makes evidence/materials.md: materials fitted to recordings of solids whose material is known, what goes wrong when sizes, matches or recordings
# do, the search of papers/003 beside it, and transfers. The solids are solved on finer meshes than those of the fits.
#
#   KEEP=FOLDER   keeps tables, recordings and fits there, and takes those that it finds (truths take an hour of one processor)
#   STEPS="truths recordings extract fit paper measured report"   default: all      ONLY="plate bar"   of the solids; default: all
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export PATH=$BUILD:$PATH LC_ALL=C
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/materials.md}")
STEPS=${STEPS:-truths recordings extract fit paper measured report}
RECORDED=$(realpath -m "${RECORDED:-$ROOT/../shared/data/impacts}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
KEEP=$(realpath -m "${KEEP:-$WORK/files}")
mkdir -p "$KEEP"
cd "$KEEP"
[ -f "$BUILD/librasp.a" ] || make -s -C "$ROOT" BUILD="$BUILD" "$BUILD/librasp.a"
read -r -a libraries <<< "$(pkg-config --libs sndfile yaml-0.1 fftw3 gsl jansson libebur128 libcrypto libpng soxr)"
gcc -std=c11 -D_GNU_SOURCE -O2 -I"$ROOT/src" -I"$ROOT/evidence" -o "$WORK/judge" "$ROOT/evidence/material_judge.c" "$BUILD/librasp.a" \
    "${libraries[@]}" -lz -lsleef -lcholmod -llapacke -lopenblas -lm
gcc -std=c11 -D_GNU_SOURCE -O2 -I"$ROOT/src" -o "$WORK/transfer" "$ROOT/evidence/material_transfer.c" "$BUILD/librasp.a" "${libraries[@]}" -lz \
    -lsleef -lm
[ -f fit.msh ] || "$ROOT/evidence/material_body.py" 3 fit.msh
[ -f fine.msh ] || "$ROOT/evidence/material_body.py" 6 fine.msh

# name, fit's solid, its order, truth's solid, its order, its layers towards re-entrant edges, side, two places
OBJECTS='plate plate:length=24cm,width=16cm,thickness=6mm 3 plate:length=24cm,width=16cm,thickness=6mm,fineness=3 3 2 top 0.03,0.025;0.09,0.065
bar bar:length=30cm,width=3cm,thickness=12mm 3 bar:length=30cm,width=3cm,thickness=12mm,fineness=3 4 2 top 0.02,0.008;0.11,0.022
ring ring:diameter=14cm,width=2cm,thickness=12mm 3 ring:diameter=14cm,width=2cm,thickness=12mm,fineness=3 4 2 top 0.062,0.01;-0.02,0.056
bowl bowl:diameter=20cm,height=8cm,thickness=4mm 4 bowl:diameter=20cm,height=8cm,thickness=4mm,fineness=3 4 2 top 0.06,0.01;0.03,-0.07
mug mug:diameter=9cm,height=10cm,wall=5mm 4 mug:diameter=9cm,height=10cm,wall=5mm,fineness=3 4 2 around 0.02,0.08;-0.05,0.04
bracket fit.msh 4 fine.msh 4 3 top 0.14,0.025;0.048,0.122'
# name, Pa, nu, kg/m^3, 1/s, s
MATERIALS='steel 2.1e11 0.29 7850 5 3e-8
glass 7.2e10 0.22 2500 1 1e-7
porcelain 6e10 0.19 2350 6 1e-7
pvc 3e9 0.38 1400 20 4e-7
beech 1.2e10 0.33 700 60 2e-6'

[ -z "${ONLY:-}" ] || OBJECTS=$(grep -E "^(${ONLY// /|}) " <<< "$OBJECTS")

wanted() { [[ " $STEPS " == *" $1 "* ]]; }
both() { # both FUNCTION: calls it with the words of each object and material
    while read -r -a o; do
        while read -r -a m; do
            "$1" "${o[@]}" "${m[@]}" < /dev/null
        done <<< "$MATERIALS"
    done <<< "$OBJECTS"
}

truth() { # the same solid on a finer mesh: modes at both places; rasp-modes by itself takes the kernels of this processor
    local table=$1-$9.truth.csv line=${8//;/,} solid
    [ -f "$table" ] && return
    solid=(--shape "$4")
    [[ $4 == *:* ]] || solid=("$4")
    rasp-modes compute "${solid[@]}" --order "$5" --grade "$6" --face "$7" --line "$line" --places 2 --modes 80 --top 16kHz \
        --youngs-modulus "${10}" --poisson "${11}" --density "${12}" --alpha "${13}" --beta "${14}" -q -o "$table"
}

recording() {
    local snr place name
    for snr in 60 30; do
        for place in 1 2; do
            name=$1-$9-$snr-$place
            [ -f "$name.wav" ] || "$WORK/judge" make "$1-$9.truth.csv" $place $snr "$(printf '%s' "$name" | cksum | cut -d ' ' -f 1)" "$name.wav"
        done
    done
}

extracted() {
    local snr place name code
    for snr in 60 30; do
        for place in 1 2; do
            name=$1-$9-$snr-$place
            [ -f "$name.code" ] && continue
            code=0
            rasp modes extract "$name.wav" --force-channel 2 --quantity velocity -q -f -o "$name.csv" 2> "$name.err" || code=$?
            echo $code > "$name.code"
        done
    done
}

if wanted truths; then both truth; fi
if wanted recordings; then both recording; fi
if wanted extract; then both extracted; fi
if wanted fit; then
    while read -r -a o; do
        while read -r -a m; do
            for snr in 60 30; do
                for place in 1 2; do
                    name=${o[0]}-${m[0]}-$snr-$place
                    echo "$name $name.csv $place $(awk "BEGIN { printf \"%.10g\", ${m[1]} / ${m[3]} }") ${m[2]} ${m[4]} ${m[5]}"
                done
                name=${o[0]}-${m[0]}-$snr
                echo "$name-both $name 0 $(awk "BEGIN { printf \"%.10g\", ${m[1]} / ${m[3]} }") ${m[2]} ${m[4]} ${m[5]}"
            done
        done <<< "$MATERIALS" > "$WORK/lines"
        OPENBLAS_NUM_THREADS=1 "$WORK/judge" fit "${o[1]}" "${o[2]}" "${o[6]}" "${o[7]}" < "$WORK/lines" > "${o[0]}.fits"
    done <<< "$OBJECTS"
fi

if wanted paper; then # the search of the paper from ten starts, on twelve of them
    while read -r -a o; do
        case ${o[0]} in plate | bar | ring) ;; *) continue ;; esac
        while read -r -a m; do
            [ "${m[0]}" != beech ] || continue
            name=${o[0]}-${m[0]}-60-1
            gamma=$(awk "BEGIN { printf \"%.6g\", ${m[1]} / ${m[3]} }")
            [ -s "${name}_$gamma.paper" ] || rasp modes material "${o[1]}" "$name.csv@${o[7]%%;*}" --method paper --starts 10 --poisson "${m[2]}" \
                --modes 40 -f -o "$WORK/paper.yaml" --json > "$WORK/paper.json" && cp "$WORK/paper.json" "${name}_$gamma.paper"
        done <<< "$MATERIALS"
    done <<< "$OBJECTS"
fi
if wanted measured; then
    if [ -f "$RECORDED/ceramic.wav" ]; then
        "$ROOT/evidence/material_measured.py" "$RECORDED" ceramic polycarb wood steel > measured.txt
    else
        echo "skipped: no recordings of strikes in ../shared/data/impacts (or RECORDED)" | tee measured.txt
    fi
fi
if wanted report; then
    [ -s size.txt ] || for more in 0 1%; do
        rasp modes material plate:length=24.24cm,width=16.16cm,thickness=6.06mm plate-glass-60-1.csv@3cm,2.5cm --size-error $more -f \
            -o "$WORK/size.yaml" > "$WORK/size"
        echo "--size-error $more: $(sed -n '2s/^ *//p' "$WORK/size")"
    done > size.txt
    {
        cat << END
# Materials from recordings

Made by \`evidence/materials.sh\`, of revision $(rasp --version --verbose | awk '/^revision/ { print $2 }'). Six solids of five materials are solved on finer meshes than those of the fits; one strike (a half sine of
0.3 ms) at each of two places is made of the modes, with white noise 60 and 30 dB below the first second; \`rasp modes extract\` finds the modes,
and the fit of \`rasp modes material\` gets those and the place, nothing else. nu is Poisson's ratio. Wanted: E/density within 0.1 % at 60 dB
(0.5 % at 30 dB), nu within 0.01 (0.03), alpha and beta within 10 % (30 %). Errors and intervals are of the fits that gave intervals.

END
        "$ROOT/evidence/material_report.py" "$KEEP"
        cat << END

A wrong size: the plate of glass (60 dB, first place) fitted with all lengths 1 % too long.

\`\`\`
$(cat "$KEEP/size.txt")
\`\`\`

What limits E/density and nu is the fit's own mesh. Frequencies of solids with re-entrant edges (mug: handle on wall, wall on bottom; bracket: its
inner corner) converge with the cells' length to the power 1.09, whatever the order: that is what the grading of cells towards such edges
(\`src/fem/grade.c\`) mends; before it the mug's E/density was 0.32 % off in the median. The error that is left is alike in all modes of a solid, and
is counted in full in intervals. So these hold or miss together, and more often than 95 of 100 do: errors of nu are in the median two thirds of half
the interval in the plate (once all of it), a third in bracket and mug; what is narrow enough for the last two would be too narrow for the plate.

alpha is a small part of what most modes decay by (in the bracket of glass at most a tenth): noise of 1 % in those decays is 10 % of alpha there,
and its interval says so. Decays weigh by their errors from noise and by their scatter about the law, which is found. Intervals of alpha and beta
are the wider of two, and that of the bootstrap, which leaves the few exact modes out in some draws, is mostly several times the error.
How many modes are found limits the rest: the strike of 0.3 ms reaches 6 kHz, and a ring or a bar of steel has few modes below.

Too few modes, wrong matches, a hum and a clipped strike, with their warnings: [record.md](record.md).

## Transfers

By \`scripts/section_e.sh\`: five objects are struck, fitted, and carried over to other sizes (the bowl of 20 cm to 14 and 10 cm) and to an irregular body.
The size "same" is the recorded object itself, by the material fitted to it. Below the lowest mode and between modes the residual is most of the sound:
without it third octaves are up to 9 dB too weak. Of bodies alike, all frequencies of which move by one ratio, \`ratio\` is the right map; \`difference\` is the paper's, and
4 dB off below the lowest mode of a bowl of half the size. In the metal plate a fitted mode lies on the other side of a band's edge.

\`\`\`
$(cat "$ROOT/irs/fitted/table.txt")
\`\`\`

What is known of a transfer, of drawn residuals (\`evidence/material_transfer.c\`):

$("$WORK/transfer")

## Real objects

Hammer strikes on four objects, microphone and force, whose sizes and materials nobody gave: the residual, damping alone, and one half of the strikes
beside the other.

$(cat "$KEEP/measured.txt")

In two of the four a strike is explained better by the modes of the other half: which modes are found matters more there than whose strikes they are of.
Steel's decays differ most: it rings for 3 to 30 s in pairs of modes 1 to 4 Hz apart, and its strikes follow one another after 0.3 to 1.2 s, so that the recording
does not hold those decays; their errors between strikes, which the tables give, are a third to all of them.

By power (\`--residual-domain power\`), as the paper prints it, the residuals of the four are -16.3, -7.6, -14.6 and -13.7 dB. Of renders that are nothing but modes
-39 dB are left (of a strike) and -28 (with its force), where by time it is -79 and -56: beats and phases are no mode's power.
END
    } > "$REPORT"
fi

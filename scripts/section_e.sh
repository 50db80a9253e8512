#!/bin/bash
# Section E of papers/003: five objects are struck, their materials are fitted to that, and both materials and residuals go over to objects of other sizes
# and to an irregular mesh. Writes irs/fitted/ (or the folder given) and its table.txt: what was found beside the truth, what was carried over beside the
# same object rendered from the truth. Takes some seven minutes of one processor.
#     scripts/section_e.sh [FOLDER [OBJECT...]]       rasp from $BUILD (default: build/ of this tree)
#     KEEP=FOLDER   keeps recordings, truths and sounds there; tables that are current are not computed again
#
# The truth, scripts/section_e_truth.csv, is read by `strike` only, and all that it makes is called true.*, but for the recording and the weight. It is on finer
# meshes than the fits. What is no mode is 60 fast modes from a third above the lowest mode to 16 kHz that decay by 1000 to 2000/s: more than
# a mode of `rasp modes extract` may. Of an object S times as large they are S times as slow and S^3 times as soft, as of any elastic solid; of the bracket,
# which is not alike, there are none. The wood has oak's ratios of moduli, which the fit is told.
set -euo pipefail
export LC_ALL=C
unset CDPATH
here=$(realpath "$(dirname "$0")/..")
PATH=$(realpath "${BUILD:-$here/build}"):$PATH
to=$(realpath -m "${1:-$here/irs/fitted}")
shift $(($# > 0))
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
keep=$(realpath -m "${KEEP:-$scratch/kept}")
mkdir -p "$to" "$keep"
cd "$keep"

# name, kind, its sizes and where it is struck in mm, orders of truth and fit, wood
objects='wood_plate plate 240,160,8 31,25 3 3 oak
plastic_plate plate 200,140,5 28,22 3 3 -
metal_plate plate 180,120,3 23,17 3 3 -
porcelain_plate plate 200,160,6 29,23 3 3 -
glass_bowl bowl 200,75,5 90,14 4 4 -'

# solid KIND SIZES SCALE FINENESS: as --shape has it
solid() {
    awk -v kind="$1" -v sizes="$2" -v scale="$3" -v fineness="$4" 'BEGIN {
        split(kind == "bowl" ? "diameter,height,thickness" : "length,width,thickness", name, ",")
        split(sizes, size, ",")
        for (i = 1; i <= 3; i++) printf "%s%s=%gmm", i == 1 ? kind ":" : ",", name[i], size[i] * scale
        printf ",fineness=%d\n", fineness }'
}

# place AT SCALE
place() { awk -v at="$1" -v scale="$2" 'BEGIN { split(at, x, ","); printf "%gmm,%gmm\n", x[1] * scale, x[2] * scale }'; }

# strike OUT NAME OBJECT... -- SCALE PLACE: OUT.modes.csv, the true modes of an object of NAME's material; OUT.wav, a strike on it; with a SCALE, what is no mode besides
strike() {
    local out=$1 name=$2 young nu density alpha beta options=()
    shift 2
    IFS=, read -r young nu density alpha beta < <(sed -n "s/^$name,//p" "$here/scripts/section_e_truth.csv")
    while [ "$1" != -- ]; do
        options+=("$1")
        shift
    done
    options+=(${nu:+--poisson "$nu"})
    [ -n "$nu" ] || options+=(--loss 0) # a wood's own
    rasp modes compute -f -q "${options[@]}" --modes 30 --at "$3" --youngs-modulus "$young" --density "$density" --alpha "$alpha" --beta "$beta" -o "$out.modes.csv"
    awk -F, -v OFS=, -v scale="$2" '
        /^# (content|inputs)/ { next }
        { print }
        /^[0-9]/ { if (++modes == 1) lowest = $5; most = $7 > most ? $7 : most; split($0, row, ",") }
        END {
            lowest *= scale # as of the object that was recorded
            for (i = 0; scale > 0 && i < 60; i++) {
                seed = (7919 * (i + 1)) % 1009 / 1009
                f = lowest * 4 / 3 * exp((i + seed / 2) / 60 * log(16000 / (lowest * 4 / 3)))
                print row[1], row[2], row[3], ++modes, f / scale, (1000 + 1000 * i / 59) / scale, (i % 3 == 1 ? -0.1 : 0.1) * most, 1.5707963
            } }' "$out.modes.csv" > "$out.all.csv"
    sound "$PWD/$out.all.csv" "$out.wav" "$3"
}

# sound TABLE FILE.wav PLACE [OPTION...]: the same hammer on each
sound() {
    local table=$1 file=$2 at=$3
    shift 3
    cat > strike.yaml << END
rasp: 1
surface: {response: $table}
scraper: {mass: 5 g}
motion: {path: still, at: [$(echo "$at" | sed 's/mm/ mm/g; s/,/, /')], duration: 0.4 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 0.5 m/s, stiffness: 2e6, first: 0.3 s}}
output: {sample_rate: 44.1 kHz, stems: [force], encoding: float32, level: {full_scale: 100}, duration: 2 s, ramp: 0}
END
    rasp render -f -q strike.yaml "$@" -o "$file" 2>> warnings.txt
}

# recording NAME SECONDS FILE.wav: true.NAME.wav with noise 60 dB below it, and the hammer's force as its second channel
recording() {
    python3 - "true.$1.wav" "true.$1.force.wav" "$2" "$3" << 'END'
import random, struct, sys
def load(name):
    b = open(name, "rb").read()
    at = b.index(b"data")
    return struct.unpack("<%df" % (struct.unpack("<I", b[at + 4:at + 8])[0] // 4), b[at + 8:at + 8 + struct.unpack("<I", b[at + 4:at + 8])[0]])
x, force = load(sys.argv[1]), load(sys.argv[2])
noise = 1e-3 * (sum(v * v for v in x[13230:35280]) / 22050) ** 0.5
random.seed(3)
flat = [v for t in range(int(44100 * float(sys.argv[3]))) for v in (x[t] + random.gauss(0, noise), force[t])]
data = struct.pack("<%df" % len(flat), *flat)
head = b"fmt " + struct.pack("<IHHIIHH", 16, 3, 2, 44100, 352800, 8, 32) + b"data" + struct.pack("<I", len(data))
open(sys.argv[4], "wb").write(b"RIFF" + struct.pack("<I", 4 + len(head) + len(data)) + b"WAVE" + head + data)
END
}

# distance A B [OPTION...]: the third octave that differs most of those within 40 dB of the loudest
distance() {
    rasp compare --json --third-octave 0 --within 40 "$@" |
        python3 -c 'import json, sys; d = json.load(sys.stdin)["third_octave"]; print("%.1f dB at %g Hz" % (d["worst_db"], d["band_hz"]))'
}

# lowest TABLE: its three lowest frequencies
lowest() { awk -F, '/^[0-9]/ && n < 3 { printf "%s%.1f", n++ ? " " : "", $5 }' "$1"; }

# transferred NAME OBJECT FILE PLACE: by the fitted material FILE.csv, with the residual and without
transferred() {
    local name=$1 file=$3 at=$4 shift
    sound "$file.csv" "$name.$2.modal.wav" "$at"
    for shift in difference ratio; do
        sound "$file.csv" "$name.$2.$shift.wav" "$at" --set surface.residual="$to/${name}_residual/residual.yaml" --set surface.residual_shift=$shift
    done
    sound "$PWD/true.$name.$2.modes.csv" "true.$name.$2.modal.wav" "$at"
    printf '%-16s %-9s %-24s %-24s %-18s %-18s %-18s %s\n' "$name" "$2" "$(lowest "true.$name.$2.modes.csv")" "$(lowest "$file.csv")" \
        "$(distance "true.$name.$2.modal.wav" "$name.$2.modal.wav")" "$(distance "true.$name.$2.wav" "$name.$2.modal.wav")" \
        "$(distance "true.$name.$2.wav" "$name.$2.difference.wav")" "$(distance "true.$name.$2.wav" "$name.$2.ratio.wav")" >> transferred.txt
}

rm -f fitted.txt transferred.txt warnings.txt
while read -r name kind sizes at order fit wood; do
    [ $# = 0 ] || [[ " $* " == *" $name "* ]] || continue
    like=()
    [ "$wood" = - ] || like=(--material "$wood")
    # truth and recording
    strike "true.$name" "$name" --shape "$(solid "$kind" "$sizes" 1 2)" --order "$order" "${like[@]}" -- 1 "$(place "$at" 1)"
    recording "$name" 2 "$name.wav"
    recording "$name" 0.42 "$name.short.wav"
    mass=$(sed -n 's/^# object: .*, \([0-9.]* kg\)$/\1/p' "true.$name.modes.csv")
    # the fit
    heard=(--force-channel 2 --quantity velocity --scale 100 --force-scale 100)
    rasp modes extract -f -q "$name.wav" "${heard[@]}" -o "$name.csv"
    rasp modes material -f -q "$(solid "$kind" "$sizes" 1 1)" "$name.csv@$(place "$at" 1)" --order "$fit" "${like[@]}" --mass "$mass" -o "$to/$name.yaml"
    rasp modes compute -f -q --shape "$(solid "$kind" "$sizes" 1 1)" --order "$fit" --material "$to/$name.yaml" --modes 30 --at "$(place "$at" 1)" -o "$name.fit.csv"
    rasp modes residual -f -q "$name.short.wav" "$name.csv" --estimated "$name.fit.csv" "${heard[@]}" -o "$to/${name}_residual"
    # beside the truth
    { grep "^$name," "$here/scripts/section_e_truth.csv"; cat "$to/$name.yaml"; } | awk -v name="$name" '
        NR == 1 { split($0, t, ",") }
        /^# matched:/ { matched = $3 " of " $5 }
        / (youngs_modulus|density|poisson|alpha|beta):/ { sub(":", "", $1); found[$1] = $2 }
        END { printf "%-16s %-9s %-9.4g %-9.4g %-6s %-8s %-8.4g %-8.4g %-9.4g %-9.4g\n", name, matched, t[2] / t[4], found["youngs_modulus"] / found["density"],
              t[3] == "" ? "-" : t[3], "poisson" in found ? sprintf("%.4f", found["poisson"]) : "-", t[5], found["alpha"], t[6], found["beta"] }' >> fitted.txt
    # other sizes
    while read -r other scale; do
        table=$to/${name}_$other
        [ $other != same ] || table=$keep/${name}_same # only to be compared
        strike "true.$name.$other" "$name" --shape "$(solid "$kind" "$sizes" $scale 2)" --order "$order" "${like[@]}" -- $scale "$(place "$at" $scale)"
        rasp modes compute -f -q --shape "$(solid "$kind" "$sizes" $scale 1)" --order "$fit" --material "$to/$name.yaml" --modes 30 --at "$(place "$at" $scale)" \
            --title "${name/_/ }, $scale times as large, of the material fitted" -o "$table.csv"
        transferred "$name" $other "$table" "$(place "$at" $scale)"
    done << END
same 1
small 0.7
$([ "$kind" = bowl ] && echo half 0.5 || echo large 1.4)
END
    [ "$name" = porcelain_plate ] || continue
    # an irregular body
    "$here/evidence/material_body.py" 2 bracket.msh
    strike "true.$name.bracket" "$name" bracket.msh --order 4 -- 0 140mm,25mm
    rasp modes compute -f -q bracket.msh --order 3 --material "$to/$name.yaml" --modes 30 --at 140mm,25mm --title 'bracket of oblique arms, of the porcelain fitted' \
        -o "$to/porcelain_bracket.csv"
    transferred "$name" bracket "$to/porcelain_bracket" 140mm,25mm
done <<< "$objects"
{
    echo 'Materials: truth, found'
    printf '%-16s %-9s %-19s %-15s %-17s %s\n' object modes 'E/density, m^2/s^2' nu 'alpha, 1/s' 'beta, s'
    cat fitted.txt
    echo
    echo 'Carried over: lowest frequencies in Hz; the third octave, of those within 40 dB of the loudest, that is farthest from the truth:'
    echo 'modes from true modes, modes from all that truly sounds, and modes with the residual, moved by difference or by ratio (surface.residual_shift).'
    echo 'The bracket is unlike what was recorded and truly has nothing but modes.'
    printf '%-16s %-9s %-24s %-24s %-18s %-18s %-18s %s\n' object size truth 'by the fit' modes 'without residual' 'by difference' 'by ratio'
    cat transferred.txt
} | tee table.txt
[ $# != 0 ] || cp table.txt "$to"

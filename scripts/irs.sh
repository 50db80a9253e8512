#!/bin/sh
# Writes the mode tables and the impulse response of irs/ (or of the folder given) from the recipes there. Same bytes every time.
#     scripts/irs.sh [FOLDER]       rasp from $BUILD (default: build/ of this tree)
set -eu
export LC_ALL=C
unset CDPATH
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/irs}
rasp=$(cd "${BUILD:-$here/build}" && pwd)/rasp
mkdir -p "$to"

# table NAME OPTION...: NAME.csv of NAME.yaml
table() {
    name=$1
    shift
    "$rasp" modes object --force --quiet "$@" -o "$to/$name.csv" "$here/irs/$name.yaml"
}

# Planks: along the line y = 3.7 cm that scenes scrape, heard at one place of their own, off all low nodal lines.
table basswood_plank --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm
table poplar_plank --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm
table ceramic_tile --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,7.1cm

# Rods: struck and heard at an end. Balls: at a pole, and any place of a ball is one.
for object in pvc_rod poplar_rod glass_ball ceramic_ball wood_ball; do
    table $object --at 0,0
done

# A bar whose frequencies a weight lowers where it lies: poles that differ from place to place.
table pvc_bar_loaded --load 5g --line 0,1.5cm,40cm,1.5cm --places 33 --listen 3cm,1.5cm

# A tap on the tile at x = 0.15 m: 0.25 s at 48 kHz.
printf '%b' "$(awk -v place=13 -v rate=48000 -v samples=12000 -f "$here/scripts/ir_wav.awk" "$to/ceramic_tile.csv")" > "$to/ceramic_tile_tap.wav"

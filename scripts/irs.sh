#!/bin/sh
# Writes the mode tables, the impulse response and the residual of irs/ (or of the folder given) from the recipes there. Same bytes every time.
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

# Planks, each heard at one place of its own, off all low nodal lines. As of all that is scraped along x their tables begin at the scene's (0, 0)
# (origin of the recipes); here places are the object's own.
table basswood_plank --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm
table poplar_plank --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,2.9cm
table ceramic_tile --line 0,3.7cm,40cm,3.7cm --places 33 --listen 11.7cm,7.1cm

# Rods: struck and heard at an end. Balls: at a pole, and any place of a ball is one.
for object in pvc_rod poplar_rod glass_ball ceramic_ball wood_ball; do
    table $object --at 0,0
done

# A bar whose frequencies a weight lowers where it lies: poles that differ from place to place.
table pvc_bar_loaded --load 5g --line 0,1.5cm,40cm,1.5cm --listen 3cm,1.5cm

# A tap on the tile at x = 0.15 m: 0.25 s at 48 kHz.
printf '%b' "$(awk -v place=13 -v rate=48000 -v samples=12000 -f "$here/scripts/ir_wav.awk" "$to/ceramic_tile.csv")" > "$to/ceramic_tile_tap.wav"

# What such a tap sounds besides its modes, for scenes/residual_strike.yaml: a burst of noise comes with it, and is what the residual finds.
printf '%b' "$(awk -v place=13 -v rate=48000 -v samples=9600 -v burst=3 -f "$here/scripts/ir_wav.awk" "$to/ceramic_tile.csv")" > "$to/tap.wav"
(cd "$to" && "$rasp" modes residual tap.wav@15cm,0 ceramic_tile.csv --impulse --quantity velocity --scale 1 --force --quiet -o ceramic_tile_residual)
rm "$to/tap.wav"

# solid NAME TITLE SHAPE OPTION...: NAME.csv by finite elements. A table that is current is left as it is.
solid() {
    name=$1 title=$2 shape=$3
    shift 3
    "$rasp" modes compute --force --quiet --title "$title" --shape "$shape" --modes 80 "$@" -o "$to/$name.csv"
}

# Solids that are scraped from (0, 0) along x, each heard at a point of its own, off the nodal lines of its low modes.
solid oak_plank 'oak plank, free, scraped along the grain' plate:length=40cm,width=10cm,thickness=1cm --material oak \
    --line 0,3.7cm,40cm,3.7cm --places 29 --origin 0,-3.7cm --listen 31.3cm,2.9cm
solid stoneware_tile 'porcelain stoneware tile, free' plate:length=30cm,width=30cm,thickness=8mm --material ceramic \
    --line 0,9cm,30cm,9cm --places 25 --origin 0,-9cm --listen 23.1cm,17.3cm
solid glass_plate 'pane of glass, free' plate:length=30cm,width=20cm,thickness=4mm --material glass \
    --line 0,7cm,30cm,7cm --places 25 --origin 0,-7cm --listen 23.1cm,12.7cm
solid steel_bowl 'steel bowl, free, scraped inside across its foot' bowl:diameter=20cm,height=8cm,thickness=1.5mm --material steel \
    --line=-6cm,1cm,6cm,1cm --places 21 --origin 6cm,-1cm --listen 5.3cm,-4.1cm
solid ceramic_mug 'ceramic mug, free, scraped round its wall' mug:diameter=8cm,height=9cm,wall=4mm --material ceramic \
    --face around --line 4cm,5.5cm,14cm,5.5cm --places 17 --origin=-4cm,-5.5cm --listen 17.1cm,8cm
solid aluminium_rod 'aluminium rod, free, scraped along its back' rod:length=30cm,diameter=1cm --material aluminium \
    --line 0,0,30cm,0 --places 33 --listen 28.7cm,0
solid steel_sphere 'hollow steel ball, free' sphere:diameter=12cm,wall=2mm --material steel \
    --line=-4cm,1cm,4cm,1cm --places 17 --origin 4cm,-1cm --listen 1.1cm,3.7cm
solid glass_sphere 'hollow glass ball, free' sphere:diameter=16cm,wall=3mm --material glass \
    --line=-4cm,1cm,4cm,1cm --places 17 --origin 4cm,-1cm --listen 1.1cm,4.3cm
solid oak_sphere 'solid oak ball, free, its grain along the scrape' sphere:diameter=14cm --material oak \
    --line=-4cm,1cm,4cm,1cm --places 17 --origin 4cm,-1cm --listen 1.1cm,4.3cm
solid steel_ring 'steel ring, free, scraped round its outside' ring:diameter=14cm,width=1cm,thickness=1cm --material steel \
    --face around --line 0,6mm,14cm,6mm --places 17 --origin 0,-6mm --listen 26.3cm,5mm

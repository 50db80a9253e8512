#!/bin/sh
# Writes the short profiles of surfaces/ (or of the folder given) from the recipes there. Same bytes every time.
#     scripts/surfaces.sh [FOLDER]       rasp from $BUILD (default: build/ of this tree)
set -eu
unset CDPATH
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/surfaces}
rasp=$(cd "${BUILD:-$here/build}" && pwd)/rasp
mkdir -p "$to"

# profile NAME SIZE PITCH: four samples of the pitch to the recipe's shortest wavelength.
profile() {
    "$rasp" surface synth --quiet --force --along path --seed 1 --size "$2" --pitch "$3" "$here/surfaces/$1.yaml" "$to/$1.gsf"
}

profile basswood 100mm 6.25um
profile poplar 40mm 2.5um
profile ceramic 40mm 2.5um
profile acrylic 40mm 2.5um
profile pvc 240mm 15um
profile glass 20mm 1.25um
profile steel 20mm 1.25um
profile sandpaper 40mm 2.5um
profile ridged_plate 25mm 10um

#!/bin/sh
# Renders the short sounds that README.md links to, as FLAC of 16 bits, into sounds/ (or the folder given). Same samples every time.
#     scripts/sounds.sh [FOLDER]       rasp from $BUILD (default: build/ of this tree)
set -eu
export LC_ALL=C
unset CDPATH
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/sounds}
rasp=$(cd "${BUILD:-$here/build}" && pwd)/rasp
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$to"
cp -R "$here/scenes" "$here/irs" "$here/surfaces" "$work"

# sound NAME SCENE OPTION...
sound() {
    name=$1 scene=$2
    shift 2
    "$rasp" render --force --quiet "$scene" -o "$work/$name.flac" --set output.encoding=flac16 --set output.diagnostics=null "$@"
    mv "$work/$name".flac "$to/"
}
for starter in wood_on_sandpaper nail_on_glass marble_on_wood; do
    "$rasp" new $starter > "$work/$starter.yaml"
    sound $starter "$work/$starter.yaml"
done
sound basswood_scrape "$work/scenes/basswood_scrape.yaml" --set output.tail='0.3 s'
sound ceramic_stroke "$work/scenes/ceramic_stroke.yaml" --set output.tail='0.8 s'
sound strike "$work/scenes/strike.yaml" --set output.tail='1 s'
sound marble_drop "$work/scenes/marble_drop.yaml" --set output.tail='0.5 s'
sound action_space "$work/scenes/action_space.yaml" --set output.tail='0.5 s'

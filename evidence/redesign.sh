#!/bin/bash
# Makes evidence/redesign.md: every shipped scene by the program from before the redesign and by today's: how far apart their sounds
# are (about 5 minutes on two cores). BEFORE=COMMIT compares with another commit; that needs the history, so not a source archive.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
BEFORE=${BEFORE:-48e4832}
export LC_ALL=C
git -C "$ROOT" rev-parse -q --verify "$BEFORE^{commit}" > /dev/null || { echo "there is no commit $BEFORE here: skipped"; exit 0; }
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
mkdir "$WORK/before" "$WORK/a" "$WORK/b"
git -C "$ROOT" archive "$BEFORE" | tar -x -C "$WORK/before"
make -s -C "$WORK/before" -j"$(getconf _NPROCESSORS_ONLN)" all > /dev/null

render() { # PROGRAM FOLDER: each scene of the folder that FOLDER's program came with
    printf '%s\n' "$3"/scenes/*.yaml |
        xargs -P 2 -I{} "$1" render -q --set output.encoding=float64 -o "$2/" {} 2> "$2.log" || true
}
render "$WORK/before/build/rasp" "$WORK/a" "$WORK/before"
render "$BUILD/rasp" "$WORK/b" "$ROOT"

# reason SCENE: why its bytes are others.
reason() { awk -F' *[|] *' -v name="$1" '$2 == name { print $3 }' "$ROOT/evidence/redesign_reasons.txt"; }

{
    echo "# The redesign, scene by scene"
    echo
    echo "Made by \`evidence/redesign.sh\`: each shipped scene rendered by the program of $BEFORE, before the redesign, and by today's. Distance: the"
    echo "difference of the two sounds, sample by sample, relative to the first (rms). Third octaves: the largest difference of levels within 60 dB of the loudest."
    echo
    echo "| scene | distance, dB | third octaves, dB | why |"
    echo "|---|---|---|---|"
    for b in "$WORK"/b/*.wav; do
        name=$(basename "$b" .wav)
        [[ $name != *.force && $name != *.*.* ]] || continue
        a=$WORK/a/$name.wav
        if [ ! -e "$a" ]; then
            echo "| $name | - | - | new |"
        elif cmp -s "$a" "$b"; then
            echo "| $name | same bytes | 0 | |"
        else
            "$BUILD/rasp" compare --json --snr 0 "$a" "$b" > "$WORK/snr.json" || true
            "$BUILD/rasp" compare --json --third-octave 1000 "$a" "$b" > "$WORK/third.json" || true
            python3 - "$name" "$WORK/snr.json" "$WORK/third.json" "$(reason "$name")" << 'END'
import json, sys
name, snr, third, why = sys.argv[1:]
def measured(file, word):
    for criterion in json.load(open(file))["criteria"]:
        if word in criterion["name"]:
            return criterion["measured"]
snr, third = measured(snr, "snr"), measured(third, "third")
print(f"| {name} | {'-' if snr is None else f'{-snr:.0f}'} | {'-' if third is None else f'{third:.2g}'} | {why or '**no reason is written down**'} |")
END
        fi
    done
    for a in "$WORK"/a/*.wav; do
        [ -e "$WORK/b/$(basename "$a")" ] || [[ $(basename "$a") == *.*.* ]] || echo "| $(basename "$a" .wav) | - | - | not made any more |"
    done
} > "$WORK/redesign.md"
mv "$WORK/redesign.md" "$ROOT/evidence/redesign.md"

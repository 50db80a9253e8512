#!/bin/bash
# Makes evidence/hard.md: hard cases with what came out and what must (tests/hard/list, all rows), on this machine.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/hard.md}")
new=$(mktemp)
trap 'rm -f "$new"' EXIT
{
    cat << 'END'
# Hard cases

Made by `evidence/hard.sh` from the rows of `tests/hard/list`; `tests/hard/run` prints the same, `tests/hard/run WORD` some of them. Every render is
with `--traps` (it would stop at an invalid operation and name the stage), and every sample is finite. Forces in N, sounds in the
scene's unit; error: dB, measured by `--verify`; like and level: dB, against the same scene with the setting that is named; energy: what a solved
contact's energy lacks, of the greatest. For a scene of one's own: `rasp render SCENE --traps --verify`.

END
    "$ROOT/tests/hard/run" --rasp "${BUILD:-$ROOT/build}/rasp" --markdown --long
} > "$new"
cp "$new" "$REPORT"
tail -n 1 "$REPORT"

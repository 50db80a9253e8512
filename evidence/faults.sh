#!/bin/bash
# Makes evidence/faults.md: faults that are planted one at a time (tests/hard/faults), and what notices them: the rows of tests/hard/list, else the
# effects' test. Each is built in a copy of the tree; takes a quarter of an hour.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/faults.md}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
export LC_ALL=C
cp -a "$ROOT/src" "$ROOT/Makefile" "$ROOT/packages" "$ROOT/scripts" "$ROOT/tests" "$ROOT/scenes" "$ROOT/irs" "$ROOT/surfaces" "$ROOT/man" "$ROOT/README.md" "$WORK"
[ ! -d "$ROOT/build" ] || cp -a "$ROOT/build" "$WORK" # what is up to date is not compiled again
cd "$WORK"
make -s build/rasp # rows and effects need no other program
tests/hard/run > "$WORK/sound" || { echo "without a fault rows fail:"; grep -v '^ok' "$WORK/sound"; exit 1; }
found=0 all=0
while IFS= read -r line; do
    [[ -z $line || $line == '#'* ]] && continue
    file=$(awk -F ' [|] ' '{ print $2 }' <<< "$line") what=$(awk -F ' [|] ' '{ print $1 }' <<< "$line") by=
    cp "$file" kept.c
    python3 - "$line" << 'END'
import sys
what, file, old, new = (w.replace("\\n", "\n") for w in sys.argv[1].split(" | "))
text = open(file).read()
if old not in text:
    sys.exit(f"{file} has no longer: {old}")
open(file, "w").write(text.replace(old, new, 1))
END
    make -s build/rasp > built 2>&1 || { cat built; echo "does not compile: $what"; exit 1; }
    if ! tests/hard/run > said; then
        by=$(grep '^FAILED' said | sed 's/^FAILED \([^:]*\):.*/\1/' | head -n 3 | paste -sd';' | sed 's/;/; /g')
        [ "$(grep -c '^FAILED' said)" -le 3 ] || by="$by and $(($(grep -c '^FAILED' said) - 3)) more"
    elif ! tests/run.sh cli/effects > said; then
        by="the effects' test"
    fi
    all=$((all + 1))
    [ -z "$by" ] || found=$((found + 1))
    echo "| $what | $file | ${by:-**nothing**} |" >> rows
    echo "${by:+found }${by:-NOT FOUND}: $what"
    mv kept.c "$file"
    touch "$file" # newer than what was built of the fault
done < tests/hard/faults
{
    cat << END
# Planted faults

Made by \`evidence/faults.sh\` from \`tests/hard/faults\`: one fault at a time is built into the program, and the hard cases (\`tests/hard/list\`) are run, then,
if none of them notices it, the test of what each effect adds (\`tests/cli/effects.sh\`). $found of $all are noticed.

| fault | file | noticed by |
|---|---|---|
$(cat rows)
END
} > "$REPORT"
echo "$found of $all"

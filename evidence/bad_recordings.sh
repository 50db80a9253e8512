#!/bin/bash
# Makes evidence/bad_recordings.md: what rasp modes extract says of recordings that modes cannot be had from
# (tests/lib/bad_recordings.py). Needs python3; espeak-ng for one row. SEEDS: how many of each (5), each drawn anew;
# LIMIT: CPU s for each (120).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/bad_recordings.md}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"

# tried SEED NAME FORCE WANTED WHAT: one line of results.
tried() {
    local code=0 said=- words=()
    [ "$3" = 0 ] || words=(--force-channel 2)
    (ulimit -t "${LIMIT:-120}"; exec rasp modes extract "$2.wav" "${words[@]}" --json -f -o "$2.csv") \
        > report.json 2> err || code=$?
    [ "$code" = 0 ] || said=$(sed -n "s/^rasp modes: error: //; s/$2\.wav:\? \?//; s/|/\\\\|/g; p; q" err)
    if [ "$code" = 0 ]; then
        said=$(python3 "$ROOT/tests/lib/bad_recordings.py" "$1" "$2" report.json)
        rm "$2.csv"
    fi
    printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$2" "$5" "$3" "$4" "$code" "$said"
}

for seed in $(seq "${SEEDS:-5}"); do
    python3 "$ROOT/tests/lib/bad_recordings.py" "$seed" > list
    if command -v espeak-ng > /dev/null; then
        espeak-ng -s $((120 + 15 * seed)) -w spoken.wav "Nobody struck this, number $seed, but somebody spoke."
        printf 'spoken\t0\trefused\tspeech of a synthesiser\n' >> list
    fi
    while IFS=$'\t' read -r name force wanted what; do
        tried "$seed" "$name" "$force" "$wanted" "$what"
    done < list
done > results

cat > table.py << 'PY'
import re
rows = {}
for line in open("results"):
    name, what, force, wanted, code, said = line.rstrip("\n").split("\t")
    rows.setdefault((what, force, wanted), []).append((int(code), said))
print("| recording | force channel | wanted | refused (exit code 65) | a table | other exit codes | what is said, or "
      "the modes in the tables | as wanted |")
print("|---|---|---|---|---|---|---|---|")
for (what, force, wanted), runs in rows.items():
    tables = [said for code, said in runs if code == 0]
    refused = [said for code, said in runs if code == 65]
    counts = [[int(n) for n in re.findall(r"\d+", said)] for said in tables]
    fine = all(good > 0 and others == 0 for good, others in counts) if wanted == "unless right" else not tables
    other = len(runs) - len(refused) - len(tables)
    told = sorted({f"exit code {code}: {said}" for code, said in runs if code not in (0, 65)})
    told += sorted(set(re.sub(r"[\d.]+ (?=and|Hz|dB|ms|s)", "... ", s).strip() for s in refused)) + tables
    cells = [what, "yes" if force == "1" else "no", wanted.replace("unless right", "refused, or the modes right"),
             f"{len(refused)} of {len(runs)}", len(tables), other, "; ".join(told),
             "yes" if fine and not other else "NO"]
    print("| " + " | ".join(map(str, cells)) + " |")
PY

{
    cat << MD
# Recordings that modes cannot be had from

Made by \`evidence/bad_recordings.sh\` with $(rasp --version): ${SEEDS:-5} recordings of each kind, drawn anew
(\`tests/lib/bad_recordings.py\`; 1.6 s, 16 kHz, 16 bits, a strike makes eight modes of 300 Hz to 5.4 kHz ring). Wanted:
that they are refused in words, with exit code 65 and no table; of a strike in 8 bits, on a large offset or far below
what follows, a table may come instead if its modes are the strike's: *right* counts the eight that are in it (within
1 Hz or 0.1 %, and a fifth of the decay, or 4 standard errors where these are more), *others* what is none of them.

MD
    python3 table.py
} > report.md
mv report.md "$REPORT"

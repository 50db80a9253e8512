#!/bin/bash
# Makes evidence/sampled.md: a data set of drawn stimuli, and a table of cells. To be run on a machine that does nothing else.
#   STIMULI  of the data set (10000; 3 GB on the disk for some minutes)
#   ROWS     of the table of cells, which is planned only (100000)
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
PATH=$(realpath -m "${BUILD:-$ROOT/build}"):$PATH
STIMULI=${STIMULI:-10000} ROWS=${ROWS:-100000}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"

# measured WHAT COMMAND...: a row of wall clock (s), CPU time (s), greatest memory (MB).
measured() {
    python3 -c '
import resource, subprocess, sys, time
start = time.monotonic()
subprocess.run(sys.argv[2:], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
wall, r = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
print(f"| {sys.argv[1]} | {wall:.1f} | {r.ru_utime + r.ru_stime:.1f} | {r.ru_maxrss / 1024:.1f} |")' "$@"
}
megabytes() { find "$1" -name "*.$2" -printf '%s\n' | awk '{ n += $1 } END { printf "%.0f", n / 1e6 }'; }

sed "s|\.\./\.\./irs|$ROOT/irs|; s|\.\./basswood|$ROOT/scenes/basswood|; s/^samples.*/samples: $((STIMULI / 2))\nsplits: {train: 8, validation: 1, test: 1}/" \
    "$ROOT/scenes/designs/sampled_scrapes.yaml" > wav.yaml
sed 's/^set: {/set: {output.encoding: flac24, /' wav.yaml > flac.yaml
{
    echo 'motion.rate,scraper.mass,load.constant'
    awk -v n="$ROWS" 'function part(x) { return x - int(x) } BEGIN { for (i = 0; i < n; i++) printf "%.5f Hz,%.4f g,%.5f N\n", 1 + 3 * part(i * 0.6180339887), 5 + 45 * part(i * 0.7548776662), 0.1 + 9.9 * part(i * 0.5698402910) }'
} > rows.csv
cat > rows.yaml << END
rasp-design: 1
base: $ROOT/scenes/basswood_scrape.yaml
set: {motion.duration: 0.2 s, output.diagnostics: null, accuracy: draft, scraper.weight: 0, grip: null}
factors: {motion.rate: cells, scraper.mass: cells, load.constant: cells}
cells: rows.csv
name: "{cell}"
level: {each: {peak: -3 dB}}
length: 0.3 s
END
cat << END
# A data set of drawn stimuli

Made by evidence/sampled.sh, on $(nproc) cores; load before it: $(cut -d ' ' -f 1 /proc/loadavg). \`scenes/designs/sampled_scrapes.yaml\` with $STIMULI stimuli of 0.6 s, 24 bits, labels in \`manifest.csv\` and \`manifest.jsonl\`.

| | wall clock (s) | CPU time (s) | greatest memory (MB) |
|---|---|---|---|
$(measured "all checked, nothing rendered (--dry-run)" rasp batch wav.yaml -n)
$(measured "$STIMULI WAVs" rasp batch wav.yaml -o wav)
$(measured "once more, nothing to do" rasp batch wav.yaml -o wav)
$(measured "$STIMULI FLACs" rasp batch flac.yaml -o flac)
$(measured "$ROWS rows of a table, --dry-run" rasp batch rows.yaml -n)

Sounds: $(megabytes wav wav) MB as WAV, $(megabytes flac flac) MB as FLAC; $(cut -d , -f 1 wav/manifest.csv | wc -l) lines of manifest.csv, $(wc -l < wav/manifest.jsonl) of manifest.jsonl.
Samples of both are the same: $(python3 -c '
import csv
a, b = ([r["audio_sha256"] for r in csv.DictReader(open(f + "/manifest.csv"))] for f in ("wav", "flac"))
print(sum(x == y for x, y in zip(a, b)), "of", len(a))').
END

#!/bin/bash
# Makes evidence/ringing.md: modes found in recordings whose modes are known (evidence/extract_judge.c), against the
# Cramer-Rao bound. Needs python3 and GNU time.
#
#   SETS="A B C D E F G H I"  MODES_A_SET=1500  JOBS=2  LIMIT=600 (CPU s a recording)
#   SEED=NUMBER   default: the time in nanoseconds, so that nobody has picked it; the report names it
#   EXTRA=...     more options for rasp modes extract; default: --fastest 2205, as sets C and H hold decays up to 2000/s
#   KEEP=FOLDER   keeps recordings, truths and reports there; what is there already is not made again
#   LIST=1        lists what was missed, what is false and what is far off, on standard error
#   SPLIT=1       a row for each level of noise
#   REPORT=FILE   default: evidence/ringing.md with all sets, else standard output
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export PATH=$BUILD:$PATH
ALL="A B C D E F G H I"
SETS=${SETS:-$ALL}
MODES_A_SET=${MODES_A_SET:-1500}
export SEED=${SEED:-$(date +%s%N)} LIMIT=${LIMIT:-600} EXTRA=${EXTRA:---fastest 2205}
[ "$SETS" != "$ALL" ] || REPORT=${REPORT:-$ROOT/evidence/ringing.md}
[ -z "${REPORT:-}" ] || REPORT=$(realpath -m "$REPORT")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
KEEP=$(realpath -m "${KEEP:-$WORK/files}")
mkdir -p "$KEEP"
rasp --version > /dev/null
gcc -std=c11 -D_GNU_SOURCE -O3 -march=native -o "$WORK/judge" "$ROOT/evidence/extract_judge.c" -lm
export WORK

# one SET K: makes recording K of a set, and extracts its modes. The report is made last, so that a run may go on.
one() {
    local name code=0 words
    name=$(printf '%s-%s-%04d' "$1" "$SEED" "$2")
    [ ! -f "$name.code" ] || return 0
    "$WORK/judge" make "$1" "$SEED" "$2" "$name"
    mapfile -t words < "$name.options"
    # shellcheck disable=SC2086
    (ulimit -t "$LIMIT"; exec /usr/bin/time -q -o "$name.time" -f '%U %S' rasp modes extract "$name.wav" "${words[@]}" \
        --modes 160 --json $EXTRA -f -o "$name.csv") > "$name.json" 2> "$name.err" || code=$?
    awk 'END { print $1 + $2 }' "$name.time" > "$name.cpu"
    echo "$code" > "$name.code"
}
export -f one

cd "$KEEP"
for set in $SETS; do
    seq 0 $(($("$WORK/judge" cases "$set" "$MODES_A_SET") - 1)) | sed "s/^/$set /"
done | xargs -P "${JOBS:-2}" -L 1 bash -c 'one "$1" "$2"' one

[ -z "${LIST:-}" ] || python3 "$ROOT/evidence/extract_score.py" --list . $SETS >&2
{
    cat << MD
# Modes found in recordings whose modes are known

Made by \`evidence/ringing.sh\` with $(rasp --version), seed $SEED$([ -z "$EXTRA" ] || echo ", with $EXTRA"): recordings are made of modes that
are drawn, in white noise (\`evidence/extract_judge.c\`), given to \`rasp modes extract\`, and what it finds is held against
them (\`evidence/extract_score.py\`). Neither shares code with rasp.

| set | what |
|---|---|
| A | impulse responses, 1 s at 44.1 kHz: 5, 20, 50 or 80 modes, one in each of as many parts of the band from 100 Hz to 12 kHz, levels over 30 dB, T60 0.2 to 1.3 s, SNR 20 to 80 dB |
| B | 20 modes, five pairs of them 0.5, 1, 2 or 5 Hz apart, SNR 40 to 80 dB |
| C | 15 modes of fast decay, 50 to 300 or 200 to 2000 1/s, SNR 40 to 80 dB |
| D | 8 modes of two slopes, 1:8, the slow one 18 dB weaker, SNR 40 to 80 dB |
| E | recordings without a force: 1 s of lead, hum of 50, 100, 150, 250 Hz 60, 40 or 20 dB below the sound, 20 modes, SNR 40 and 60 dB |
| F | two strikes 0.6, 0.3 or 0.12 s apart, their force in a channel (half sines of 0.3 ms), 15 modes from 150 to 9600 Hz, SNR 40 to 80 dB, 24 kHz |
| G | 30 modes at 16, 24, 48 and 96 kHz, SNR 40 and 60 dB |
| H | as E, one strike, its force in a channel; half of the modes decay fast, 50 to 1000 1/s |
| I | as A, each mode anywhere in the band: several may lie on each other |

SNR: rms of the first 0.1 s of the sound without noise over the noise's. *Resolvable*: the nearest other mode is more
than 6 bounds of the frequency away (of two slopes: 6 of the decay), the gain is more than 6 of its bounds, the decay
more than 2; beside it those whose gain is more than 8. *False*: a component that is no true mode's, hum too; *blend*:
one that lies between two which overlap and are not both resolvable. *Error / bound*: median of the errors over the Cramer-Rao
bounds of the resolvable modes that were found, times 1.4826; 1 is the least that an unbiased estimate can have.
*In 95 % intervals*: how many of these errors are less than 1.96 of the standard errors that the report gives. Gains of
E, whose level and onset nobody knows, are compared but for one factor and one time a recording. *Clear*: of those that
are farther than 6 sums of their half-widths from every mode that is not resolvable. Such a mode is in the recording all
the same, and pulls at what overlaps it; no interval of a model that cannot hold it covers that. Wanted: all resolvable
ones found, none false, 0.9 to 1.1, 95 %.

MD
    python3 "$ROOT/evidence/extract_score.py" ${SPLIT:+--split} . $SETS
} > "$WORK/report.md"
if [ -n "${REPORT:-}" ]; then cat "$WORK/report.md" > "$REPORT"; else cat "$WORK/report.md"; fi

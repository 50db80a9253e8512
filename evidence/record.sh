#!/bin/bash
# Makes evidence/record.md: what carelessness costs when an object is recorded to find its material; man/rasp-record.7 has its figures.
# A plate and a bar of glass are struck by evidence/material_judge.c, which spoils the recording in one way at a time. Takes a quarter of an hour of
# one processor. KEEP=FOLDER keeps recordings, tables and fits there, and takes those that it finds.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
export PATH=$BUILD:$PATH LC_ALL=C OPENBLAS_NUM_THREADS=1
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/record.md}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
KEEP=$(realpath -m "${KEEP:-$WORK/files}")
mkdir -p "$KEEP"
cd "$KEEP"
[ -f "$BUILD/librasp.a" ] || make -s -C "$ROOT" BUILD="$BUILD" "$BUILD/librasp.a"
read -r -a libraries <<< "$(pkg-config --libs sndfile yaml-0.1 fftw3 gsl jansson libebur128 libcrypto libpng soxr)"
gcc -std=c11 -D_GNU_SOURCE -O2 -I"$ROOT/src" -I"$ROOT/evidence" -o "$WORK/judge" "$ROOT/evidence/material_judge.c" "$BUILD/librasp.a" \
    "${libraries[@]}" -lz -lsleef -lcholmod -llapacke -lopenblas -lm

plate=plate:length=24cm,width=16cm,thickness=6mm
bar=bar:length=30cm,width=3cm,thickness=12mm
GLASS=(--youngs-modulus 7.2e10 --poisson 0.22 --density 2500 --alpha 1 --beta 1e-7)
FORCE='--force-channel 2'

# The truths: elements of order 4; fits have order 3. The second place is the middle, a node of three modes in four.
printf '%s\n' x_m,y_m,z_m 0.03,0.025,0.006 0.12,0.08,0.006 > plate.places.csv
printf '%s\n' x_m,y_m,z_m 0.02,0.008,0.012 0.15,0.015,0.012 > bar.places.csv
for object in plate bar; do
    [ -f $object.truth.csv ] || rasp modes compute --shape ${!object} --order 4 --points $object.places.csv --modes 80 --top 16kHz \
        "${GLASS[@]}" -q -o $object.truth.csv
done

# tabled NAME OBJECT PLACE SNR WORDS [CARELESSNESS...]: a recording, and its table by rasp modes extract WORDS.
tabled() {
    local name=$1 object=$2 place=$3 snr=$4 words=$5
    shift 5
    [ ! -f "$name.err" ] || return 0
    "$WORK/judge" make "$object.truth.csv" "$place" "$snr" 7 "$name.wav" "$@"
    rasp modes extract "$name.wav" $words --quantity velocity -f -o "$name.csv" > "$name.out" 2> "$WORK/err" || true
    mv "$WORK/err" "$name.err"
}
for object in plate bar; do
    tabled $object-right $object 1 60 "$FORCE"
    tabled $object-unmeasured $object 1 60 ''
    tabled $object-snr-30 $object 1 30 "$FORCE"
    tabled $object-held $object 1 60 "$FORCE" hold=50
    tabled $object-room $object 1 60 "$FORCE" echo=1
    tabled $object-soft $object 1 60 "$FORCE" pulse=1e-3
    tabled $object-short $object 1 60 "$FORCE" seconds=0.3
    tabled $object-node $object 2 60 "$FORCE"
done
tabled plate-snr-40 plate 1 40 "$FORCE"
tabled plate-snr-20 plate 1 20 "$FORCE"
tabled plate-clipped plate 1 60 "$FORCE" peak=1.6
tabled plate-8-bits plate 1 60 "$FORCE" bits=8
tabled plate-fade plate 1 60 "$FORCE" fade=1 seconds=1
tabled plate-hum-40 plate 1 60 "$FORCE" hum=-40
tabled plate-hum-20 plate 1 60 "$FORCE" hum=-20
tabled plate-bounce plate 1 60 "$FORCE" bounce=0.06
tabled plate-bounce-unmeasured plate 1 60 '' bounce=0.06
tabled plate-room-unmeasured plate 1 60 '' echo=1

# fitted FITS SOLID PLACES MODES < LINES: tables against one family of so many computed modes.
fitted() {
    cat > "$WORK/lines"
    [ -f "$1" ] || { "$WORK/judge" fit "$2" 3 top "$3" "$4" < "$WORK/lines" > "$WORK/fits" && mv "$WORK/fits" "$1"; }
}
truth='28800000 0.22 1 1e-7'
lines() { # lines OBJECT: all its tables at the place that was struck, then those that are special
    local name
    for name in "$1"-*.csv; do
        echo "${name%.csv} $name $([[ $name = *-node.csv ]] && echo 2 || echo 1) $truth"
    done
    echo "$1-place $1-right.csv 3 $truth"
}
{ lines plate; echo "plate-other bar-right.csv 1 $truth"; } | fitted plate.fits $plate '0.03,0.025;0.12,0.08;0.05,0.025' 50
{ lines bar; echo "bar-other plate-right.csv 1 $truth"; } | fitted bar.fits $bar '0.02,0.008;0.15,0.015;0.04,0.008' 24
sized() { printf '%s\n' "$1-$2 $1-right.csv 1 $truth" "$1-$2-stated $1-right.csv 1 $truth $3" | fitted "$1-$2.fits" "$4" "$5" 24; }
sized bar length-1 0.01 bar:length=30.3cm,width=3cm,thickness=12mm 0.02,0.008
sized bar length-3 0.03 bar:length=30.9cm,width=3cm,thickness=12mm 0.02,0.008
sized bar thick-5 0.05 bar:length=30cm,width=3cm,thickness=12.6mm 0.02,0.008
[ -f bar-clamped.json ] || # what was free, computed as clamped
    rasp modes material $bar bar-right.csv@2cm,8mm --modes 24 --clamp x0 --json -f -o clamped.yaml > bar-clamped.json
# a bar of which ten modes are there, computed as clamped
if [ ! -f bar-clamped-more.json ]; then
    short=bar:length=25cm,width=3cm,thickness=1cm
    rasp modes compute --shape $short --order 4 --modes 40 --top 16kHz "${GLASS[@]}" --at 2cm,7mm -q -f -o bar-short.truth.csv
    "$WORK/judge" make bar-short.truth.csv 1 60 7 bar-short.wav
    rasp modes extract bar-short.wav $FORCE --quantity velocity -q -f -o bar-short.table.csv
    rasp modes material $short bar-short.table.csv@2cm,7mm --modes 24 --clamp x0 --json -f -o clamped.yaml > bar-clamped-more.json
fi

# a mass of a thousandth of a bar's at its end
printf '%s\n' 'material: glass' 'object: {shape: bar, length: 20 cm, width: 2 cm, thickness: 5 mm}' > "$WORK/bar.yaml"
lowest() { rasp modes object "$WORK/bar.yaml" --at 0,0 "$@" -q -f -o "$WORK/bar.csv" && awk -F, '$1 == 1 { print $5; exit }' "$WORK/bar.csv"; }
loaded=$(awk "BEGIN { printf \"%.2f\", 100 * (($(lowest --load 50mg) / $(lowest))^2 - 1) }")

python3 - "$(rasp --version)" "$loaded" > "$WORK/report.md" << 'END'
import glob, json, math, re, sys
TRUTH = [2.88e7, 0.22, 1.0, 1e-7]
CASES = """right|nothing
unmeasured|force not measured
snr-40|noise 40 dB below the first second
snr-30|noise 30 dB below
snr-20|noise 20 dB below
hum-40|hum of 50 Hz and harmonics, 40 dB below
hum-20|hum 20 dB below
clipped|clipped, 4 dB above full scale
8-bits|8 bits
short|recording ends 0.3 s after the strike
fade|faded out over the first second
soft|soft hammer, 1 ms
bounce|hammer hits again after 60 ms
bounce-unmeasured|the same, force not measured
room|room, echoes of -12 dB after 3, 7 and 15 ms
room-unmeasured|the same, force not measured
held|held: alpha 50 1/s more
node|struck in the middle, on nodes
place|place given wrong by 2 cm
length-1|length measured 1 % too long
length-1-stated|the same, `--size-error 1%`
length-3|length measured 3 % too long
length-3-stated|the same, `--size-error 3%`
thick-5|thickness measured 5 % too thick
thick-5-stated|the same, `--size-error 5%`
clamped|computed as clamped at one end
clamped-more|the same of a bar of 25 x 3 x 1 cm, with more modes
other|recording of the other object"""
fits = {}
for name in glob.glob("*.fits"):
    for line in open(name):
        head, _, warning = line.rstrip("\n").partition(" | ")
        word = head.split()
        if word[1] in ("no-table", "refused:"):
            fits[word[0]] = ("-", "-", "-", "-", [], line.rstrip("\n").split(" ", 1)[1])
            continue
        figures = [(float(word[6 + 3 * k]), float(word[19 + 2 * k]), float(word[20 + 2 * k])) for k in range(4)]
        fits[word[0]] = (word[1], word[2], word[3], "%.2g %%" % (100 * float(word[5])), figures, warning)
for name in glob.glob("*-clamped*.json"):
    r = json.load(open(name))
    law = [d for d in r["damping"] if d["law"] == "rayleigh"][0]
    get = lambda d: tuple(math.nan if d[k] is None else d[k] for k in ("value", "low", "high"))
    figures = [get(d) for d in (r["youngs_modulus_per_density"], r["poisson"], law["alpha"], law["beta"])]
    fits[name[:-5]] = (r["modes"], r["matched"], r["missing"], "%.2g %%" % (100 * r["scatter"]), figures, "; ".join(r.get("warnings") or []))

def cell(figure, truth):
    value, low, high = figure
    error = value / truth - 1
    text = "%+.*f %%" % (3 if abs(error) < 1e-3 else 2 if abs(error) < 0.01 else 1 if abs(error) < 1 else 0, 100 * error)
    if math.isnan(low): return text + ", no interval"
    return text + (", holds" if low <= truth <= high else ", **interval misses**") + " (%+.3g to %+.3g %%)" % (100 * (low / truth - 1), 100 * (high / truth - 1))

print(f"""# What carelessness costs when an object is recorded

Made by `evidence/record.sh` with {sys.argv[1]}. A free plate of glass (24 x 16 x 0.6 cm) and a bar (30 x 3 x 1.2 cm), of
E/density 2.88e7 m^2/s^2, Poisson's ratio 0.22, alpha 1 1/s and beta 1e-7 s, are computed with elements of order 4. One strike, a half
sine of 0.3 ms near a corner, is recorded with its force, noise 60 dB below the first second of the sound, and spoilt in one way.
`rasp modes extract` finds its modes, `rasp modes material` (order 3) the material. *Beside*: by how much matched modes lie beside
computed ones (rms). Figures are errors beside the truth; *holds* means that the interval of 95 %, in brackets as far as
its ends lie from the truth, has the truth in it. `man man/rasp-record.7` says what to do about each.
""")
found = []
for object in ("plate", "bar"):
    print(f"## The {object}\n\n| carelessness | modes | matched | missing | beside | E/density | Poisson's ratio | alpha | beta | what is said |\n|" + "---|" * 10)
    for case in CASES.split("\n"):
        key, text = case.split("|")
        label = f"{object}-{key}"
        try: said = open(label + ".err").read()
        except FileNotFoundError: said = ""
        extract = re.findall(r"^rasp modes: error: (.*)", said, re.M)
        try: out = open(label + ".out").read()
        except FileNotFoundError: out = ""
        warned = re.findall(r"(?s)^warnings?:\n(.*)", out, re.M)
        told = ["extract: " + re.sub(r"^\S*\.wav:? ?", "", s) for s in extract]
        told += ["extract: " + l.strip() for w in warned for l in w.splitlines() if "level is relative" not in l and l.startswith("  ")]
        if label not in fits:
            if told: print(f"| {text} | no table | - | - | - | - | - | - | - | " + "; ".join(told).replace("|", "\\|") + " |")
            continue
        modes, matched, missing, beside, figures, warning = fits[label]
        if warning: told.append("material: " + warning)
        cells = [cell(f, t) for f, t in zip(figures, TRUTH)] or ["-"] * 4
        print(f"| {text} | {modes} | {matched} | {missing} | {beside} | " + " | ".join(cells) + " | " + ("; ".join(told) or "nothing").replace("|", "\\|") + " |")
        found += [f"- {object}, {text}: {name}, {c}" for name, c in zip(("E/density", "Poisson's ratio", "alpha", "beta"), cells) if "misses" in c]
    print()
print(f"A mass of a thousandth of a bar's, fixed to its end, changes E/density by {sys.argv[2]} %.\n")
print("## Intervals that do not hold\n")
print("\n".join(found) if found else "None.")
END
mv "$WORK/report.md" "$REPORT"

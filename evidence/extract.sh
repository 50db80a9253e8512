#!/bin/bash
# Makes evidence/extract.md and evidence/extract.png: the modes of four real objects from recordings of a hammer's strikes on them (channel 1 a microphone, channel 2 the
# hammer's force), by both methods of rasp modes extract, and of a rendered recording whose modes are known. The recordings are looked for in ../shared/data/impacts (or
# RECORDED): steel.wav, ceramic.wav, polycarb.wav, wood.wav; without them nothing is done. Needs python3 and gnuplot. LIMIT: seconds for each of the fits.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
RECORDED=$(realpath -m "${RECORDED:-$ROOT/../shared/data/impacts}")
LIMIT=${LIMIT:-900}
OBJECTS=${OBJECTS:-steel ceramic polycarb wood}
METHODS="esprit spectrogram"
for object in $OBJECTS; do
    [ -f "$RECORDED/$object.wav" ] || { echo "skipped: no $object.wav in ../shared/data/impacts (or RECORDED)"; exit 0; }
done
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
for object in $OBJECTS; do
    ln -s "$RECORDED/$object.wav" "$object.wav"
done
export OBJECTS METHODS LIMIT

# ------------------------------------------------------------------ a recording whose modes are known

cat > plate.yaml << 'YAML'
rasp: 1
surface:
  material: pvc
  modes: 10
  object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 4 mm}
scraper: {mass: 2 g}
motion: {path: still, at: [7 cm, 6 cm], duration: 5 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 2e5, first: 0.5 s, count: 3, interval: 1 s}}
output: {stems: [force], level: {full_scale: 10 m/s}, sample_rate: 24 kHz, encoding: float32, quantity: velocity}
YAML
cat > known.py << 'PY'
import math, random, struct, subprocess, time

def read(name):
    b = open(name, "rb").read()
    at = b.index(b"data")
    n = struct.unpack("<I", b[at + 4:at + 8])[0] // 4
    return struct.unpack("<%df" % n, b[at + 8:at + 8 + 4 * n])

def write(name, x, f):
    data = struct.pack("<%df" % (2 * len(x)), *(v for pair in zip(x, f) for v in pair))
    open(name, "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 2, 24000, 192000, 8, 32) + b"data" + struct.pack("<I", len(data)) + data)

def table(name):
    return [[float(c) for c in line.split(",")[4:8]] for line in open(name) if line[0] not in "#p"]

def errors(name):
    """Standard errors: of frequency, decay, gain."""
    return [[float(word.split()[1]) for word in line.split(": ", 1)[1].split(" (")[0].split(", ")] for line in open(name) if line.startswith("# error")]

subprocess.run("rasp modes object plate.yaml --at 7cm,6cm --modes 10 -q -o true.csv", shell=True, check=True, stderr=subprocess.DEVNULL)
true = table("true.csv")
for count, interval, snr in ((1, 1, 60), (3, 1, 60), (8, 0.5, 60), (8, 0.12, 60), (3, 1, 40), (8, 0.5, 40), (8, 0.12, 40), (8, 0.5, 20)):
    random.seed(count)
    subprocess.run(f"rasp render -q plate.yaml -o p.wav --set contact.strike.count={count} --set 'contact.strike.interval={interval} s'", shell=True, check=True)
    x, f = read("p.wav"), read("p.force.wav")
    noise = max(abs(v) for v in x) / 10 ** (snr / 20)
    write("r.wav", [v + random.gauss(0, noise) for v in x], f)
    start = time.time()
    done = subprocess.run("rasp modes extract r.wav --force-channel 2 --scale 10 --force-scale 1 --quantity velocity -q -f -o r.csv", shell=True, capture_output=True, text=True)
    if done.returncode:
        print(f"| {count} | {interval} | {snr} | {done.stderr.strip()} | | | | | |")
        continue
    found, of = table("r.csv"), errors("r.csv")
    pairs = []
    for t in true:
        k = min(range(len(found)), key=lambda i: abs(found[i][0] - t[0]))
        if abs(found[k][0] - t[0]) < 2 and abs(found[k][1] / t[1] - 1) < 0.5:
            pairs.append((t, found[k], of[k]))
    rms = lambda values: math.sqrt(sum(v * v for v in values) / len(values))
    inside = [abs(f[j] - t[j]) < 2 * e[j] for t, f, e in pairs for j in (0, 1, 2)]
    print(f"| {count} | {interval} | {snr} | {len(pairs)} | {len(found) - len(pairs)} | {rms([f[0] - t[0] for t, f, _ in pairs]):.2g} | {100 * rms([f[1] / t[1] - 1 for t, f, _ in pairs]):.2g} | "
          f"{100 * rms([f[2] / t[2] - 1 for t, f, _ in pairs]):.2g} | {100 * sum(inside) / len(inside):.0f} |")
PY

# ------------------------------------------------------------------ the recordings

fits() {
    local object method words
    TIMEFORMAT=%U
    for object in $OBJECTS; do
        for method in $METHODS; do
            words="--force-channel 2 --method $method --json --response $object.$method.h.wav --resynthesis $object.$method.s.wav --residual $object.$method.r.wav"
            # shellcheck disable=SC2086
            { time timeout "$LIMIT" rasp modes extract "$object.wav" $words --plot "$object.$method.png" -o "$object.$method.csv" > "$object.$method.json" 2> "$object.$method.err" ||
                echo "exit code $?" >> "$object.$method.err"; } 2> "$object.$method.cpu"
        done
    done
}

cat > report.py << 'PY'
import json, math, os, struct, sys
objects, methods, limit = os.environ["OBJECTS"].split(), os.environ["METHODS"].split(), os.environ["LIMIT"]

def wav(name):
    b = open(name, "rb").read()
    at = b.index(b"data")
    n = struct.unpack("<I", b[at + 4:at + 8])[0] // 4
    return struct.unpack("<%df" % n, b[at + 8:at + 8 + 4 * n])

def load(object, method):
    try:
        return json.load(open(f"{object}.{method}.json"))
    except ValueError:
        return None

def median(v):
    v = sorted(v)
    return (v[(len(v) - 1) // 2] + v[len(v) // 2]) / 2 if v else math.nan

def strongest(report, n):
    return [m for m in report["modes"] if m["slope"] == 1][:n]

def strikes():
    print("| object | strikes | used | clipped | doubled | explained: median, least, most (%) | sound after force (ms) | band (Hz) | response (s) | median momentum over full scale (ms) |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for o in objects:
        r = next((r for r in (load(o, m) for m in methods) if r), None)
        if not r:
            continue
        p, s = r["places"][0], r["places"][0]["strikes"]
        e = [100 * k["explained"] for k in s if k["explained"] is not None]
        print(f"| {o} | {len(s)} | {len(e)} | {sum(k['clipped'] for k in s)} | {sum(k['doubled'] for k in s)} | {median(e):.0f}, {min(e):.0f}, {max(e):.0f} | {1e3 * p['delay_s']:.2f} | "
              f"{p['low_hz']:.0f} to {p['high_hz']:.0f} | {p['response_s']:.3f} | {1e3 * median([k['momentum'] for k in s]):.3f} |")

def modes():
    print("| object | method | modes | energy held (%) | the same from the WAVs, all frequencies (%) | third octaves: mean, worst (dB), at (Hz) | log-spectral distance (dB) | median decay, all (1/s) | "
          "10 strongest (1/s) | CPU (s) |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for o in objects:
        for m in methods:
            r, cpu = load(o, m), open(f"{o}.{m}.cpu").read().split()[-1]
            if not r:
                why = open(f"{o}.{m}.err").read().strip().replace("exit code 124", f"not within {limit} s")
                print(f"| {o} | {m} | {why} | | | | | | | {cpu} |")
                continue
            d, h, rest = r["places"][0]["distance"], wav(f"{o}.{m}.h.wav"), wav(f"{o}.{m}.r.wav")
            share = 1 - sum(v * v for v in rest) / sum(v * v for v in h)
            print(f"| {o} | {m} | {len({k['mode'] for k in r['modes']})} | {100 * r['places'][0]['explained']:.1f} | {100 * share:.1f} | {d['third_octave_mean_db']:.1f}, "
                  f"{d['third_octave_worst_db']:.1f}, {d['third_octave_worst_hz']:.0f} | {d['log_spectral_db']:.1f} | {r['median_decay_per_s']:.1f} | "
                  f"{median([k['decay_per_s'] for k in strongest(r, 10)]):.1f} | {cpu} |")

def energy(m):
    """Of a mode's response: gain^2/(4 decay)."""
    return m["places"][0]["gain"] ** 2 / (4 * m["decay_per_s"])

def order():
    """metal < ceramic < plastic and wood, of the median decay of the strongest."""
    print("| method | strongest modes | steel | ceramic | polycarbonate | wood | metal < ceramic < plastic and wood |")
    print("|---|---|---|---|---|---|---|")
    for m in methods:
        for n in ("all, by energy", 5, 10, 50):
            of = {o: r["median_decay_by_energy_per_s"] if n == "all, by energy" else median([k["decay_per_s"] for k in strongest(r, n)]) for o in objects for r in [load(o, m)] if r}
            cell = lambda o: f"{of[o]:.1f}" if o in of else ""
            whole = all(o in of for o in ("steel", "ceramic", "polycarb", "wood"))
            verdict = ("kept" if of["steel"] < of["ceramic"] < min(of["polycarb"], of["wood"]) else "NOT KEPT") if whole else ""
            print(f"| {m} | {n} | {cell('steel')} | {cell('ceramic')} | {cell('polycarb')} | {cell('wood')} | {verdict} |")

def brief():
    """How many modes decay fast, and what they hold."""
    for o in objects:
        r = load(o, "esprit")
        if r:
            of = strongest(r, None)
            fast = [m for m in of if m["decay_per_s"] > 300]
            print(f"- {o}: {len(fast)} of {len(of)} modes decay by more than 300/s, with {100 * sum(map(energy, fast)) / sum(map(energy, of)):.1f} % of the energy")

def lines():
    print("| object | the five strongest by " + " | by ".join(methods) + " |")
    print("|---|" + "---|" * len(methods))
    for o in objects:
        cells = []
        for m in methods:
            r = load(o, m)
            cells.append("; ".join(f"{k['frequency_hz']:.1f} ± {2 * k['frequency_error']:.1g} Hz, {k['decay_per_s']:.3g} ± {2 * k['decay_error']:.1g}/s" for k in strongest(r, 5)) if r else "")
        print(f"| {o} | " + " | ".join(cells) + " |")

def said():
    for o in objects:
        for m in methods:
            r = load(o, m)
            for text in r["warnings"] if r else []:
                if "level is relative" not in text:
                    print(f"- {o}, {m}: {text.split('/')[-1] if '.wav: ' in text else text}")

globals()[sys.argv[1]]()
PY

sheet() {
    echo "set terminal pngcairo size 2200,1800; set output 'sheet.png'; set multiplot layout 2,2 margins 0,1,0,1 spacing 0,0; unset key; unset tics; unset border; set autoscale noextend"
    local object
    for object in $OBJECTS; do
        [ ! -s "$object.esprit.png" ] || echo "plot '$object.esprit.png' binary filetype=png with rgbimage"
    done
    echo 'unset multiplot'
}

python3 known.py > known.md
fits
sheet | gnuplot
for part in strikes modes order brief lines said; do
    python3 report.py $part > $part.md
done
mv sheet.png "$ROOT/evidence/extract.png"

{
    cat << MD
# Modes of real objects

Made by \`evidence/extract.sh\` with $(rasp --version), from the command line. Synthetic responses are \`evidence/responses.sh\`'s and the unit tests' matter; here are recordings.

## A recording whose modes are known

A PVC plate, 30 x 20 cm, its 10 lowest modes of 105 to 3014 Hz, two of them 8 Hz apart and 25 dB of level, rendered under half sines of 0.3 ms; white noise in the sound,
SNR from its peak to the noise's rms. At every 0.12 s a strike falls into the ringing of the last. A mode is found within 2 Hz and half of its decay; the rest are rms errors of
those, and how many of their frequencies, decays and gains lie within two standard errors (wanted: 95).

| strikes | every (s) | SNR (dB) | found of 10 | others | frequency (Hz) | decay (%) | gain (%) | within 2 standard errors (%) |
|---|---|---|---|---|---|---|---|---|
$(< known.md)

## Strikes

Channel 1 a microphone, channel 2 the hammer's force, 16 bits, 44.1 kHz; no scales are known, so that levels are relative. *Explained*: share of a strike's sound that the one response
which all strikes have in common makes of its force. Steel's recording is two sets of strikes (1 to 5 and 6 to 11) that ring differently, as if the place or the microphone had been moved between them:
hence its low shares.

$(< strikes.md)

What the program says of them:

$(< said.md)

## Modes

Up to 50 of each. *Energy held*: of the response, in its band, noise taken off; beside it what the WAVs of \`--response\` and \`--residual\` say, summed here over all frequencies and from
the strike on, where the response is not sharp yet. Distances are from the response to what its modes make of it (\`--resynthesis\`), in the band.

$(< modes.md)

## Damping

Median decay: of all modes weighted by their energy, gain^2/(4 decay), the decay that half of the energy decays slower than; and plain of the strongest. ESPRIT finds
more than the spectrogram, and part of it are pieces that are gone within some ten milliseconds; probably the beginning of a strike rather than a ringing of the object (not tested). They hold
the share of the energy that follows, but count as any other in a plain median of many modes, which does not keep the order for the ten strongest and for all.

$(< brief.md)

The order metal < ceramic < plastic and wood holds by the energy-weighted median (which \`rasp modes extract\` reports as the median by energy) with both methods, and by the
spectrogram's plain medians; ESPRIT's plain medians of the 10 and 50 strongest fail:

$(< order.md)

## The strongest

With two standard errors.

$(< lines.md)

## Pictures

By \`--plot\`, method esprit: ![responses, modes and what is left](extract.png)
MD
} > report.md
mv report.md "$ROOT/evidence/extract.md"

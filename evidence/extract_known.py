"""A rendered plate whose modes are known, struck and extracted in many ways: rows of tables for evidence/extract.sh.

  python3 extract_known.py ways     numbers of strikes, distances between them, levels of noise
  python3 extract_known.py draws    the same strikes in 20 draws of noise, and of the first one with 40 samples flipped
                                    in their last bit, 8 times

plate.yaml is the scene; rasp is on PATH. Recordings are at 24 kHz: sound and force, in floating point.
"""
import json, math, random, struct, subprocess, sys

OPTIONS = "--force-channel 2 --scale 10 --force-scale 1 --quantity velocity"

def read(name):
    with open(name, "rb") as f:
        b = f.read()
    at = b.index(b"data")
    n = struct.unpack("<I", b[at + 4:at + 8])[0] // 4
    return struct.unpack(f"<{n}f", b[at + 8:at + 8 + 4 * n])

def write(name, sound, force, flips=0):
    """Flips: of that many samples of the sound the last bit."""
    data = bytearray(struct.pack(f"<{2 * len(sound)}f", *(v for pair in zip(sound, force) for v in pair)))
    for k in random.sample(range(len(sound)), flips):
        data[8 * k] ^= 1
    fmt = struct.pack("<IHHIIHH", 16, 3, 2, 24000, 192000, 8, 32)
    with open(name, "wb") as f:
        f.write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + fmt + b"data" +
                struct.pack("<I", len(data)) + data)

def rendered(count, interval, first=0.5, duration=5):
    sets = [f"contact.strike.count={count}", f"contact.strike.interval={interval} s",
            f"contact.strike.first={first} s", f"motion.duration={duration} s"]
    subprocess.run(["rasp", "render", "-q", "-f", "plate.yaml", "-o", "p.wav"] + [w for s in sets for w in ("--set", s)],
                   check=True)
    return read("p.wav"), read("p.force.wav")

def true_modes():
    subprocess.run("rasp modes object plate.yaml --at 7cm,6cm --modes 10 -q -f -o true.csv", shell=True, check=True,
                   stderr=subprocess.DEVNULL)
    with open("true.csv") as f:
        return [[float(c) for c in line.split(",")[4:7]] for line in f if line[0] not in "#p"]

def extracted():
    """Frequency, decay, gain of every mode, and their standard errors; or what is said instead."""
    done = subprocess.run(["rasp", "modes", "extract", "r.wav", *OPTIONS.split(), "--json", "-f", "-o", "r.csv"],
                          capture_output=True, text=True)
    if done.returncode:
        return done.stderr.strip().split("\n")[0], None
    modes = json.loads(done.stdout)["modes"]
    pick = lambda of, *names: next((of[n] for n in names if n in of), math.nan)
    found = [(m["frequency_hz"], m["decay_per_s"], abs(m["places"][0]["gain"])) for m in modes]
    return found, [(pick(m, "frequency_se", "frequency_error"), pick(m, "decay_se", "decay_error"),
                    pick(m["places"][0], "gain_se", "gain_error")) for m in modes]

def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan

def paired(true, found, errors):
    """Of every true mode the nearest found one within 2 Hz and half of its decay."""
    pairs = []
    for t in true:
        k = min(range(len(found)), key=lambda i: abs(found[i][0] - t[0]), default=None)
        if k is not None and abs(found[k][0] - t[0]) < 2 and abs(found[k][1] / t[1] - 1) < 0.5:
            pairs.append((t, found[k], errors[k]))
    return pairs

def ways():
    true = true_modes()
    cases = ((1, 1, 60), (3, 1, 60), (8, 0.5, 60), (8, 0.12, 60), (3, 1, 40), (8, 0.5, 40), (8, 0.12, 40), (8, 0.5, 20))
    for count, interval, snr in cases:
        random.seed(count)
        sound, force = rendered(count, interval)
        noise = max(map(abs, sound)) / 10 ** (snr / 20)
        write("r.wav", [v + random.gauss(0, noise) for v in sound], force)
        found, errors = extracted()
        if errors is None:
            print(f"| {count} | {interval} | {snr} | {found} | | | | | |")
            continue
        pairs = paired(true, found, errors)
        off = [rms([f[j] - abs(t[j]) if j == 0 else 100 * (f[j] / abs(t[j]) - 1) for t, f, _ in pairs])
               for j in range(3)]
        inside = [abs(f[j] - abs(t[j])) < 2 * e[j] for t, f, e in pairs for j in range(3)]
        print(f"| {count} | {interval} | {snr} | {len(pairs)} | {len(found) - len(pairs)} | {off[0]:.2g} | "
              f"{off[1]:.2g} | {off[2]:.2g} | {100 * sum(inside) / max(len(inside), 1):.0f} |")

def row(what, runs, reference, true):
    """Of runs (found, errors): how many modes, and how far frequencies are from the reference's in standard errors."""
    good = [r for r in runs if r[1] is not None]
    pairs = [p for found, errors in good for p in paired(reference, found, errors)]
    ten = [p for found, errors in good for p in paired(true, found, errors)]
    off = [(f[0] - t[0]) / e[0] for t, f, e in pairs]
    counts = [len(found) for found, _ in good]
    print(f"| {what} | {len(runs)} | {len(runs) - len(good)} | {sum(n == 10 for n in counts)} | "
          f"{min(counts, default=0)} to {max(counts, default=0)} | {len(ten)} of {10 * len(runs)} | {rms(off):.2g} | "
          f"{max(map(abs, off), default=math.nan):.2g} |")

def draws():
    sound, force = rendered(3, 0.6, 0.2, 2.4)
    runs, flipped = [], []
    for seed in range(1, 21):
        random.seed(seed)
        write("r.wav", [v + random.gauss(0, 1e-6) for v in sound], force)
        runs.append(extracted())
    for flip in range(8):
        random.seed(1)
        noisy = [v + random.gauss(0, 1e-6) for v in sound]
        random.seed(100 + flip)
        write("r.wav", noisy, force, 40)
        flipped.append(extracted())
    true = true_modes()
    row("noise of 20 seeds; errors", runs, true, true)
    if runs[0][1] is not None:
        row("8 times 40 last bits of seed 1; changes", flipped, runs[0][0], true)

globals()[sys.argv[1]]()

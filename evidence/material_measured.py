#!/usr/bin/env python3
"""Strikes on real objects, of which no truth is known: material_measured.py FOLDER OBJECT...

For each FOLDER/OBJECT.wav (channel 1 sound, channel 2 force) prints rows of evidence/materials.md: residual and represented sound,
their sum beside the recording (of the first strike, with its noise), the residual
through the recorded force beside what the strike left, and of a scene beside its modes, damping by two laws, and how modes of every other strike predict the rest."""
import cmath, json, math, os, struct, subprocess, sys


def rasp(*words):
    done = subprocess.run(["rasp", *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"rasp {' '.join(map(str, words))}: {done.stderr}")
    return json.loads(done.stdout)


def samples(name, channel):
    """Of a WAV of 16-bit integers or 32-bit floats, full scale 1."""
    b = open(name, "rb").read()
    at, kind, channels, bits, x = 12, None, None, None, None
    while at + 8 <= len(b):
        tag, size = b[at:at + 4], struct.unpack("<I", b[at + 4:at + 8])[0]
        if tag == b"fmt ":
            kind, channels, _, _, _, bits = struct.unpack("<HHIIHH", b[at + 8:at + 24])
        if tag == b"data":
            x = b[at + 8:at + 8 + size]
        at += 8 + size + size % 2
    v = struct.unpack(f"<{8 * len(x) // bits}{'h' if bits == 16 else 'f'}", x)
    return [w / 32768 if bits == 16 else w for w in v[channel::channels]]


def fft(v):
    if len(v) == 1:
        return v
    even, odd, n = fft(v[::2]), fft(v[1::2]), len(v) // 2
    turned = [cmath.exp(-1j * math.pi * k / n) * odd[k] for k in range(n)]
    return [e + t for e, t in zip(even, turned)] + [e - t for e, t in zip(even, turned)]


def octaves(x, n):
    """dB of the third octaves from 100 Hz to 16 kHz."""
    return bands([abs(v) ** 2 for v in fft(list(x) + [0.0] * (n - len(x)))[:n // 2]], n)


def bands(power, n):
    centres = [1000 * 2 ** (k / 3) for k in range(-10, 13)]
    return [10 * math.log10(sum(power[int(c * n / 44100 / 2 ** (1 / 6)):int(c * n / 44100 * 2 ** (1 / 6)) + 1]) + 1e-30) for c in centres]


def in_scene(name, facts, pulse):
    """The residual beside the modes, dB: in the strike, and of a scene with the table, the residual and the force of the strike."""
    with open("force.wav", "wb") as f:
        flat = struct.pack(f"<{len(pulse) + 1000}f", *([0.0] * 1000 + pulse))
        f.write(b"RIFF" + struct.pack("<I", 36 + len(flat)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 1, 44100, 44100 * 4, 4, 32) + b"data" + struct.pack("<I", len(flat)) + flat)
    with open("given.yaml", "w") as f:
        f.write(f"rasp: 1\nsurface: {{response: {name}.csv, residual: {name}_residual/residual.yaml}}\nmotion: {{path: still, duration: 0.5 s}}\n"
                "contact: {model: given, given: {file: force.wav, scale: 1 N}}\n"
                "output: {sample_rate: 44.1 kHz, quantity: acceleration, encoding: float32, level: {full_scale: 1000}, duration: 1 s, ramp: 0}\n")
    rasp("render", "given.yaml", "-f", "--json", "-o", "given.wav")
    rasp("render", "given.yaml", "-f", "--json", "--set", "surface.residual_gain=0", "-o", "modes.wav")
    both, modes = samples("given.wav", 0), samples("modes.wav", 0)
    strike = [samples(f"{name}_residual/strike.wav", k) for k in (0, 1)]
    energy = lambda v: sum(w * w for w in v)
    n = len(strike[0])
    return [10 * math.log10(energy(strike[1]) / energy(strike[0])),
            10 * math.log10(energy(a - b for a, b in zip(both[1000:1000 + n], modes[1000:1000 + n])) / energy(modes[1000:1000 + n]))]


def through(folder, facts, sound):
    """The residual through the force of its strike, beside what the strike left: dB of third octaves, and their number, in which the force
    is within 20 dB of its strongest."""
    at, pulse = round(facts["onset_s"] * 44100), samples(sound, 1)
    base = sum(pulse[at - 200:at]) / 200
    pulse = [v - base for v in pulse[at:at + 900]]
    if -min(pulse) > max(pulse):
        pulse = [-v for v in pulse]
    top = end = pulse.index(max(pulse))
    while end < len(pulse) and pulse[end] > 0.003 * pulse[top]:
        end += 1
    response, left = samples(folder + "/residual.wav", 0), samples(folder + "/strike.wav", 1)
    response[0] /= 2
    n = 2 << (len(left) - 1).bit_length()
    f, r, y = (fft(list(v) + [0.0] * (n - len(v))) for v in (pulse[:end], response, left))
    force = bands([abs(v) ** 2 / abs(f[0]) ** 2 * 1000 / max(1, k * 44100 / n) for k, v in enumerate(f[:n // 2])], n)
    again, whole = bands([abs(v * w / 44100) ** 2 for v, w in zip(r, f)][:n // 2], n), bands([abs(v) ** 2 for v in y][:n // 2], n)
    off = [abs(a - b) for a, b, s in zip(again, whole, force) if s > max(force) - 20]
    return max(off), len(off), pulse[:end]


def interval(law, key, unit):
    v = law[key]
    return f"{v['value']:.3g} {unit}" + ("" if v["low"] is None else f" ({v['low']:.3g} to {v['high']:.3g})")


folder = sys.argv[1]
rows = {"residual": [], "damping": [], "halves": []}
for name in sys.argv[2:]:
    sound = os.path.join(folder, name + ".wav")
    heard = ["--force-channel", 2, "--json", "-f"]
    whole = rasp("modes", "extract", sound, *heard, "-o", name + ".csv")
    left = rasp("modes", "residual", sound, name + ".csv", *heard, "-o", name + "_residual")
    kept = rasp("modes", "residual", sound, name + ".csv", *heard, "--keep-noise", "-o", name + "_kept")
    x = samples(sound, 0)
    start = round(kept["start_s"] * 44100)
    both = [samples(f"{name}_kept/strike.wav", k) for k in (0, 1)]
    both = [a + b for a, b in zip(*both)]
    back, count, pulse = through(name + "_residual", left, sound)
    beside = in_scene(name, left, pulse)
    n = 1 << (len(both) - 1).bit_length()
    recorded, again = octaves(x[start:start + len(both)], n), octaves(both, n)
    off = [abs(a - b) for a, b in zip(recorded, again) if a > max(recorded) - 40]
    rows["residual"].append(f"| {name} | {left['strike']} | {left['modes']} | {left['represented_db']:.1f} | {left['residual_db']:.1f} | {left['noise_db']:.1f} "
                            f"| {max(off):.2f} ({len(off)} bands) | {back:.2f} ({count} bands) | {beside[0]:.1f}, {beside[1]:.1f} |")
    d = rasp("modes", "material", name + ".csv", "--name", "found", "--json", "-f", "-o", "found.yaml")
    law = {one["law"]: one for one in d["damping"]}
    chosen = next(one for one in d["damping"] if one["chosen"])
    rows["damping"].append(f"| {name} | {d['modes']} | {interval(law['rayleigh'], 'alpha', '1/s')}, {interval(law['rayleigh'], 'beta', 's')} "
                           f"| {100 * law['rayleigh']['scatter']:.0f} % | {interval(law['loss'], 'loss', '')} | {100 * law['loss']['scatter']:.0f} % "
                           f"| {chosen['law']} | {'; '.join(d['warnings']) or 'none'} |")
    strikes = [k + 1 for k, s in enumerate(whole["places"][0]["strikes"]) if s["used"]]
    half = [rasp("modes", "extract", sound, *heard, "--strikes", ",".join(map(str, strikes[k::2])), "-o", f"{name}.{k}.csv") for k in (0, 1)]
    other = rasp("modes", "residual", sound, f"{name}.0.csv", *heard, "--strikes", ",".join(map(str, strikes[1::2])), "-o", name + "_other")
    own = rasp("modes", "residual", sound, f"{name}.1.csv", *heard, "--strikes", ",".join(map(str, strikes[1::2])), "-o", name + "_own")
    pairs = []
    strong = sorted(half[1]["modes"], key=lambda m: -m["share"])[:10]
    for m in strong:
        near = min(half[0]["modes"], key=lambda v: abs(math.log(v["frequency_hz"] / m["frequency_hz"])))
        if abs(math.log(near["frequency_hz"] / m["frequency_hz"])) < 0.01:
            pairs.append((abs(near["frequency_hz"] / m["frequency_hz"] - 1), abs(near["decay_per_s"] / m["decay_per_s"] - 1)))
    middle = [sorted(p[k] for p in pairs)[len(pairs) // 2] for k in (0, 1)]
    rows["halves"].append(f"| {name} | {len(strikes[::2])}, {len(strikes[1::2])} | {len(pairs)} of {len(strong)} | {100 * middle[0]:.2f} % | {100 * middle[1]:.0f} % "
                          f"| {other['left_db']:.1f} dB | {own['left_db']:.1f} dB |")
print("| object | strike | modes | represented, dB of the recording | residual | noise | both added beside the recording, noise kept, farthest third octave, dB | the residual through the recorded force beside what was left, dB, where the force is within 20 dB | the residual beside the modes, dB: of the strike, of a scene with its force |\n|---|---|---|---|---|---|---|---|---|")
print("\n".join(rows["residual"]))
print("\n| object | modes | Rayleigh (95 %) | scatter | loss factor (95 %) | scatter | likeliest law | warnings |\n|---|---|---|---|---|---|---|---|")
print("\n".join(rows["damping"]))
print("\n| object | strikes of the halves | of the ten strongest modes of the second half, in the first within 1 % | frequency, median difference | decay, median difference "
      "| a strike of the second half less the first half's modes | less its own half's |\n|---|---|---|---|---|---|---|")
print("\n".join(rows["halves"]))

"""Recordings that modes cannot be had from, or hardly.

  python3 bad_recordings.py SEED                 writes them here as NAME.wav, and prints one line each:
                                                 NAME, 1 with a channel of force (the second) or 0, what is wanted
                                                 (refused; or refused unless the modes are right), what it is
  python3 bad_recordings.py SEED NAME REPORT     how many modes of a report (--json) are the strike's, and how many are
                                                 not: within 1 Hz or 0.1 %, and a fifth of the decay, or 4 of the
                                                 standard errors where these are more
"""
import json, math, random, struct, sys

RATE = 16000
SECONDS = 1.6
N = int(RATE * SECONDS)
LEAD = int(0.4 * RATE)

def save(name, channels, bits=16):
    """Channels of numbers within -1 to 1."""
    top = 2 ** (bits - 1) - 1
    flat = [max(-top - 1, min(top, round(v * top))) for frame in zip(*channels) for v in frame]
    data = bytes(v + 128 for v in flat) if bits == 8 else struct.pack(f"<{len(flat)}h", *flat)
    size = len(channels) * bits // 8
    fmt = struct.pack("<HHIIHH", 1, len(channels), RATE, RATE * size, size, bits)
    with open(name + ".wav", "wb") as f:
        f.write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<I", 16) + fmt + b"data" +
                struct.pack("<I", len(data)) + data)

def resonated(x, frequency, decay, gain):
    """x through one mode, gain e^(-decay t) sin(2 pi frequency t)."""
    r = math.exp(-decay / RATE)
    a, b, c = 2 * r * math.cos(2 * math.pi * frequency / RATE), r * r, r * math.sin(2 * math.pi * frequency / RATE)
    out, y1, y2, before = [], 0.0, 0.0, 0.0
    for v in x:
        y1, y2, before = a * y1 - b * y2 + gain * c * before, y1, v
        out.append(y1)
    return out

def added(*sounds):
    return [sum(v) for v in zip(*sounds)]

def ringing(force, modes):
    return added(*(resonated(force, *m) for m in modes))

def scaled(x, peak):
    most = max(map(abs, x)) or 1
    return [peak * v / most for v in x]

def bell(count):
    return [(300 * 18 ** ((i + random.uniform(0.2, 0.8)) / count), 6.9 / random.uniform(0.3, 1), random.uniform(0.2, 1))
            for i in range(count)]

def pulses(*starts):
    """Half sines of 0.6 ms."""
    f = [0.0] * N
    for at in starts:
        for k in range(10):
            f[at + k] += 0.5 * math.sin(math.pi * (k + 0.5) / 10)
    return f

def white(rms):
    return [random.gauss(0, rms) for _ in range(N)]

def pink(rms):
    """Six poles an octave and a half apart (after Kellet)."""
    poles, state, out = (0.99886, 0.99332, 0.969, 0.8665, 0.55, -0.7616), [0.0] * 6, []
    gains = (0.0555179, 0.0750759, 0.153852, 0.3104856, 0.5329522, -0.016898)
    for _ in range(N):
        w = random.gauss(0, 1)
        state = [p * s + g * w for p, s, g in zip(poles, state, gains)]
        out.append(sum(state) + 0.5362 * w)
    size = math.sqrt(sum(v * v for v in out) / N)
    return [rms * v / size for v in out]

def speech():
    """Vowels of four formants over a gliding voice, with pauses, hisses and bursts between them."""
    vowels = [(730, 1090, 2440, 3400), (270, 2290, 3010, 3500), (300, 870, 2240, 3300), (530, 1840, 2480, 3500)]
    out, at = [0.0] * N, LEAD
    while at < N - RATE // 4:
        n, start, phase, formants = int(random.uniform(0.12, 0.24) * RATE), at, 0.0, random.choice(vowels)
        voice, pitch = [0.0] * N, random.uniform(100, 160)
        for k in range(int(0.012 * RATE)):           # a consonant's burst
            voice[start + k] += random.gauss(0, 0.4)
        for k in range(n):
            phase += pitch * (1 + 0.2 * k / n) / RATE
            voice[start + k] += 0.02 * random.gauss(0, 1) + (math.sin(math.pi * k / n) if phase >= 1 else 0)
            phase -= phase >= 1
        for frequency in formants:
            voice = resonated(voice, frequency, 150 + 0.03 * frequency, 1)
        voice = scaled(voice, random.uniform(0.4, 0.9))
        out = added(out, voice)
        at += n + int(random.uniform(0.03, 0.12) * RATE)
    return out

def bang(at):
    return [0.0] * at + [math.exp(-20 * k / RATE) * random.gauss(0, 1) for k in range(N - at)]

def recordings(seed):
    """Name, channels, bits, has force, wanted, what it is; and the strike's modes."""
    random.seed(seed)
    modes = bell(8)
    force = pulses(LEAD)
    ring = scaled(ringing(force, modes), 0.8)
    strike = added(ring, white(2e-4))
    clipped = [max(-1, min(1, 4 * v)) for v in strike]
    gap = LEAD + RATE // 10
    starts = [LEAD]
    while starts[-1] < N - RATE // 5:
        starts.append(starts[-1] + int(random.uniform(0.06, 0.15) * RATE))
    bells = scaled(added(*(ringing(pulses(s), [(f, d / 2, g) for f, d, g in bell(6)]) for s in starts)), 0.8)
    low = added(scaled(ring, 0.008), scaled(bang(N // 2), 0.8), white(2e-5))
    cases = [
        ("clipped", clipped, force, 16, "refused", "one strike, clipped at full scale"),
        ("clipped_below", [0.6 * v for v in clipped], force, 16, "refused", "one strike, clipped and then made softer"),
        ("quiet", low, force, 16, "refused", "a strike 40 dB below a bang of noise that follows"),
        ("white", white(0.1), force, 16, "refused", "white noise alone (of the force: one strike)"),
        ("pink", pink(0.1), force, 16, "refused", "pink noise alone (of the force: one strike)"),
        ("bells", added(bells, white(2e-4)), pulses(*starts), 16, "refused", "different bells every 60 to 150 ms"),
        ("speech", added(speech(), white(2e-4)), None, 16, "refused", "speech of four formants"),
        ("eight", strike, force, 8, "unless right", "a strike in 8 bits"),
        ("dc", [0.5] * N, force, 16, "refused", "nothing but an offset"),
        ("offset", [0.5 * v + 0.4 for v in strike], force, 16, "unless right", "a strike on an offset of 0.4"),
        ("gap", [0 if gap <= k < gap + RATE // 50 else v for k, v in enumerate(strike)], force, 16, "refused",
         "a strike, 20 ms of zeros in its ringing")]
    return cases, modes

def near(found, mode):
    frequency, decay, _ = mode
    errors = [found.get(x + "_se", found.get(x + "_error")) or 0 for x in ("frequency", "decay")]
    return (abs(found["frequency_hz"] - frequency) < max(1, 1e-3 * frequency, 4 * errors[0]) and
            abs(found["decay_per_s"] - decay) < max(0.2 * decay, 4 * errors[1]))

def right(report, modes):
    """How many true modes a report has, and how many of its own are none of them."""
    with open(report) as f:
        found = json.load(f)["modes"]
    return sum(any(near(f, m) for f in found) for m in modes), sum(not any(near(f, m) for m in modes) for f in found)

def main(words):
    cases, modes = recordings(int(words[0]))
    if len(words) == 3:
        name, report = words[1:]
        struck = name not in ("white", "pink", "bells", "speech", "spoken", "dc")
        print("{} right, {} others".format(*right(report, modes if struck else [])))
        return
    for name, sound, force, bits, wanted, what in cases:
        save(name, [sound] if force is None else [sound, force], bits)
        for channel in (0, 1) if force else (0,):
            print(name, channel, wanted, what, sep="\t")

if __name__ == "__main__":
    main(sys.argv[1:])

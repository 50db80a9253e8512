#!/bin/bash
# Makes evidence/objects.md and evidence/nodal_lines.png: what objects of simple shape, nodal lines and radiators are against published constants and
# textbook formulas, and what modes cost (about 2 minutes on two cores). Needs python3 and gnuplot.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
make -s -C "$ROOT" BUILD="$BUILD" "$BUILD"/bench/{resonators,launch,overlap_add} > "$WORK/log" 2>&1 || { cat "$WORK/log" >&2; exit 1; }
cd "$WORK"

# What all parts measure with: a sound's samples, a mode's complex amplitude in them, a scene's sound.
cat > judge.py << 'PY'
import array, cmath, csv, json, math, os, struct, subprocess

RATE = 48000

def rasp(*words):
    return subprocess.run(["rasp", *words], check=True, capture_output=True, text=True).stdout

def wav(name):
    """Channels of a float64 WAV."""
    data = open(name, "rb").read()
    at, channels = 12, 1
    while at < len(data):
        kind, size = struct.unpack("<4sI", data[at:at + 8])
        if kind == b"fmt ":
            channels = struct.unpack("<H", data[at + 10:at + 12])[0]
        if kind == b"data":
            y = array.array("d", data[at + 8:at + 8 + size])
            return [y[k::channels] for k in range(channels)]
        at += 8 + size + size % 2

def table(name):
    return list(csv.DictReader(line for line in open(name) if not line.startswith("#")))

def modes(recipe, *words):
    """(frequency, decay, gain) of each mode."""
    open("modes.yaml", "w").write(recipe)
    rasp("modes", "object", "modes.yaml", "-f", "-q", "-o", "modes.csv", *words)
    return [(float(r["frequency_hz"]), float(r["decay_per_s"]), float(r["gain"])) for r in table("modes.csv")]

def sound(scene, *words):
    open("scene.yaml", "w").write(scene)
    rasp("render", "scene.yaml", "-q", "-o", "scene.wav", *words)
    return wav("scene.wav")

def amplitude(y, frequency, decay, start, length):
    """a of y = Im a e^((j 2 pi f - d) t): Gaussian window, 7 standard deviations to either side."""
    total, weights, s = 0, 0.0, complex(-decay, 2 * math.pi * frequency)
    for n in range(round(start * RATE), round((start + length) * RATE)):
        u = (n / RATE - start) / length - 0.5
        w = math.exp(-98 * u * u)
        total += w * y[n] * cmath.exp(-s * (n / RATE))
        weights += w
    return 2j * total / weights

def db(x):
    return 20 * math.log10(abs(x)) if x else -math.inf

# Every strike here: half a sine of 0.1 ms that begins at 20 ms, 1 mN s in all.
STRIKE = f"contact: {{model: strike, strike: {{pulse: half_sine, speed: 0.5, stiffness: {1e-3 * (math.pi / 1e-4) ** 2!r}, first: 20 ms}}}}\nscraper: {{mass: 1 g}}"

def strike_at(frequency, decay):
    """The pulse's share in a mode: integral of f(t) e^(-s t), about e^(d t) times its spectrum."""
    p, T, w = 1e-3, 1e-4, 2 * math.pi * frequency
    return p * math.cos(w * T / 2) / (1 - (w * T / math.pi) ** 2) * math.exp(decay * (0.02 + T / 2))
PY

# ------------------------------------------------------------------ 1

closed_forms() {
    python3 << 'PY'
from judge import *
PI = math.pi
own = "alpha: 0, beta: 0, loss: 0, density: 1000, thickness: 1 mm"   # E h^2/(12 rho) = 1 m^4/s^2 where E = 12 GPa

def bar(edges): return f"object: {{shape: bar, edges: {edges}, length: 0.1, width: 0.01, youngs_modulus: 12e9, poisson: 0.3, {own}}}"
def plate(edges, nu): return f"object: {{shape: plate, edges: {edges}, length: 0.1, width: 0.1, youngs_modulus: {12e9 * (1 - nu * nu)!r}, poisson: {nu}, {own}}}"
def disk(edges, nu): return f"object: {{shape: disk, edges: {edges}, diameter: 0.2, youngs_modulus: {12e9 * (1 - nu * nu)!r}, poisson: {nu}, {own}}}"
fv12 = "object: {shape: plate, edges: free, length: 10, width: 10, thickness: 0.05, youngs_modulus: 200e9, poisson: 0.3, density: 8000, alpha: 0, beta: 0, loss: 0}"
string = "object: {shape: string, length: 0.5, diameter: 1 mm, tension: 100, youngs_modulus: 200e9, density: 8000, alpha: 0, beta: 0, loss: 0}"
membrane = f"object: {{shape: membrane, length: 0.1, width: 0.1, surface_tension: 10000, {own}}}"
drum = f"object: {{shape: drum, diameter: 0.2, surface_tension: 10000, {own}}}"
shell = "object: {shape: shell, diameter: 0.2001, thickness: 0.0001, youngs_modulus: 0.91e9, poisson: 0.3, density: 1000, alpha: 0, beta: 0, loss: 0}"

def lower(l):  # Baker's lower branch: O^2 - (L + 1 + 3 nu) O + (L - 2)(1 - nu^2) = 0
    L = l * (l + 1)
    return math.sqrt((L + 1.9 - math.sqrt((L + 1.9) ** 2 - 3.64 * (L - 2))) / 2)

stiff, f0 = PI ** 3 * 200e9 * 1e-12 / (64 * 100 * 0.25), math.sqrt(100 / (8000 * PI * 0.25e-6)) / 1.0
strings = [n * f0 * math.sqrt(1 + stiff * n * n) for n in (1, 2, 10)]
blevins, leissa = "Blevins 1979, table 8-1", "Leissa 1973"
sums = "converged Legendre sums of another program"
root, square, line = lambda f: math.sqrt(2 * PI * f / 100), lambda f: 2 * PI * f / 100, lambda f: 2 * PI * f / 1000
# object, quantity, source, recipe, from Hz to the constant, constants as printed; closed forms are numbers
rows = [
    ("bar, free", "beta L", blevins, bar("free"), lambda f: root(f), "4.730040745 7.853204624 10.995607838 14.137165491 17.278759657"),
    ("bar, clamped", "beta L", blevins, bar("clamped"), root, "4.730040745 7.853204624 10.995607838 14.137165491 17.278759657"),
    ("bar, cantilever", "beta L", blevins, bar("cantilever"), root, "1.875104 4.694091 7.854757"),
    ("bar, supported", "beta L", "i pi", bar("supported"), root, [PI, 2 * PI, 3 * PI]),
    ("square plate, free, nu 0.3", "w a^2 sqrt(rho h/D)", sums, plate("free", 0.3), square, "13.4682 19.5961 24.2702 34.8009 61.0932 63.6861 69.2654 77.1717"),
    ("square plate, free, nu 0.33", "the same", sums, plate("free", 0.33), square, "13.1962 19.2584 24.4095 34.2856"),
    ("square plate, free, nu 0.2", "the same", sums, plate("free", 0.2), square, "14.3225 20.6346 23.7343 36.3357"),
    ("square plate, free, 10 m", "Hz", "NAFEMS FV12", fv12, lambda f: f, "1.622 2.360 2.922"),
    ("square plate, clamped", "w a^2 sqrt(rho h/D)", leissa + ", later work", plate("clamped", 0.3), square, "35.985 73.394 108.22 131.58 132.20 165.00"),
    ("square plate, supported", "the same", "pi^2 (m^2 + n^2)", plate("supported", 0.3), square, [PI * PI * k for k in (2, 5, 8, 10)]),
    ("disk, clamped", "w a^2 sqrt(rho h/D)", "Leissa, NASA SP-160, table 2.1", disk("clamped", 0.3), square, "10.2158 21.26 34.88 39.771"),
    ("disk, supported, nu 0.3", "the same", "later tables", disk("supported", 0.3), square, "4.9351 13.898 25.613 29.720"),
    ("disk, free, nu 0.3", "the same", "later tables", disk("free", 0.3), square, "5.3583 9.0031 12.439 20.475"),
    ("disk, free, nu 0.33", "the same", "Leissa, NASA SP-160, table 2.5", disk("free", 0.33), square, "5.253 9.084 12.23 20.52"),
    ("drum", "zeros of J", "DLMF 10.75", drum, line, "2.404826 3.831706 5.135622 5.520078"),
    ("square membrane", "w a/c", "pi sqrt(m^2 + n^2)", membrane, line, [PI * math.sqrt(k) for k in (2, 5, 8, 10)]),
    ("string, steel, 1 mm", "Hz; partials 1, 2, 10", "n f0 sqrt(1 + B n^2)", string, lambda f: f, strings),
    ("shell, h/R = 1e-3, nu 0.3", "w R sqrt(rho (1 - nu^2)/E), l = 2, 3, 4", "Baker 1961 (membrane)", shell, lambda f: 2 * PI * f / 1e4, [lower(l) for l in (2, 3, 4)]),
    ("the same, l = 0, 1", "the same", "sqrt(2 (1 + nu)), sqrt(3 (1 + nu))", shell, lambda f: 2 * PI * f / 1e4, [math.sqrt(2.6), math.sqrt(3.9)]),
]
print("| object | constant | source | printed value | ours | difference | rounds to it |")
print("|---|---|---|---|---|---|---|")
for object, what, source, recipe, constant, printed in rows:
    # of the two of a pair one
    ours, found = [], [constant(f) for f, _, _ in modes(recipe)]
    for x in found:
        if not ours or x > ours[-1] * (1 + 1e-9):
            ours.append(x)
    closed = isinstance(printed, list)
    ordered = not closed or not object.startswith(("string", "the same"))
    for i, value in enumerate(printed if closed else printed.split()):
        x = ours[i] if ordered else min(ours, key=lambda y: abs(y - value))
        digits = 9 if closed else len(value.split(".")[1])
        same = "" if closed else "yes" if f"{x:.{digits}f}" == value else "no"
        shown = f"{value:.{digits}f}" if closed else value
        print(f"| {object if i == 0 else ''} | {what if i == 0 else ''} | {source if i == 0 else ''} | {shown} | {x:.{min(digits + 2, 10)}f} | {x / float(value) - 1:+.1e} | {same} |")
PY
}

# ------------------------------------------------------------------ 2

nodal_strikes() {
    python3 << 'PY'
from judge import *
L, W = 0.6, 0.42
body = f"object: {{shape: plate, edges: supported, length: {L}, width: {W}, thickness: 4 mm, youngs_modulus: 70e9, poisson: 0.22, density: 2500, alpha: 0, beta: 0, loss: 1e-6}}"
listed = modes(body, "--at", "0.1,0.1")
D = 70e9 * 0.004 ** 3 / 12 / (1 - 0.22 ** 2)

def mode(m, n):
    f = math.pi / 2 * math.sqrt(D / 10) * ((m / L) ** 2 + (n / W) ** 2)
    return min(listed, key=lambda x: abs(x[0] - f))[:2]

def struck(x, y, m, n):
    scene = f"rasp: 1\nsurface:\n  modes: 80\n  {body}\nmotion: {{path: still, at: [{x!r}, {y!r}], duration: 0.1}}\n{STRIKE}\n" \
            "output: {listen: {radiator: point, places: [[0.07, 0.05, 0]]}, encoding: float64, level: {full_scale: 1}, ramp: 0, tail: 2.1}\n"
    return amplitude(sound(scene)[0], *mode(m, n), 0.05, 2)

mm, worst = 1e-3, -math.inf
print("| mode (m, n) | Hz | line | on the line (dB) | 1 mm before, 1 mm after (dB) | sin there (dB) | phase across (degrees) |")
print("|---|---|---|---|---|---|---|")
for (m, n), line in [((2, 1), ("x", 0.3)), ((3, 1), ("x", 0.2)), ((3, 2), ("x", 0.4)), ((3, 2), ("y", 0.21)), ((1, 2), ("y", 0.21)), ((5, 3), ("y", 0.14)), ((8, 1), ("x", 0.3))]:
    along_x = line[0] == "x"
    top = (L / 2 / m, W / 2 / n)
    place = lambda d: (line[1] + d, top[1]) if along_x else (top[0], line[1] + d)
    best, on, before, after = (struck(*p, m, n) for p in (top, place(0), place(-mm), place(mm)))
    worst = max(worst, db(on / best))
    expected = db(math.sin((m * math.pi / L if along_x else n * math.pi / W) * mm))
    print(f"| ({m}, {n}) | {mode(m, n)[0]:.1f} | {line[0]} = {100 * line[1]:g} cm | {db(on / best):.0f} | {db(before / best):.3f}, {db(after / best):.3f} | {expected:.3f} | {math.degrees(cmath.phase(-after / before)) + 180:.4f} |")
print(f"\nOn the lines at most {worst:.0f} dB; limit -100 dB, {'kept' if worst < -100 else 'NOT KEPT'}.")
PY
}

# ------------------------------------------------------------------ 3

pulsating() {
    python3 << 'PY'
from judge import *
rho, c, a, r = 1.204, 343.2, 0.1, 1.0
print("| f (Hz) | ka | velocity: closed form, ours (dB re 1 m/s) | pressure: formula, ours (dB re 1 Pa) | difference (dB) | phase of p before v: atan 1/ka, ours (degrees) |")
print("|---|---|---|---|---|---|")
for f in (200, 1000, 4000):
    d = 0.01
    open("one.csv", "w").write("# poles: shared\n# quantity: velocity\n# radius_m: 0.1\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n"
                               f"1,0,0,1,{f},{d},1,{math.pi / 2!r}\n")
    scene = f"rasp: 1\nsurface: {{response: one.csv}}\nmotion: {{path: still, duration: 0.1}}\n{STRIKE}\n"
    v = amplitude(sound(scene + "output: {encoding: float64, level: {full_scale: 1}, ramp: 0, tail: 1}\n")[0], f, d, 0.04, 1)
    p = amplitude(sound(scene + f"output: {{listen: {{places: [[0, 0, {r}]], density: {rho}, sound_speed: {c}}}, encoding: float64, level: {{dbfs_at_1_pa: 0}}, ramp: 0, tail: 1}}\n")[0], f, d, 0.04, 1)
    ka = 2 * math.pi * f / c * a
    u = strike_at(f, d)
    want = rho * c * u * a / r * ka / math.sqrt(1 + ka * ka)
    print(f"| {f} | {ka:.3f} | {db(u):.3f}, {db(v):.3f} | {db(want):.3f}, {db(p):.3f} | {db(p) - db(want):+.4f} | {math.degrees(math.atan(1 / ka)):.3f}, {math.degrees(cmath.phase(p / v)):.3f} |")
PY
}

baffled() {
    python3 << 'PY'
from judge import *
rho, c, L, W, r, X, Y = 1.204, 343.2, 0.5, 0.38, 500.0, 0.07, 0.06
body = f"object: {{shape: plate, edges: supported, length: {L}, width: {W}, thickness: 3 mm, youngs_modulus: 70e9, poisson: 0.22, density: 2500, alpha: 0, beta: 0, loss: 1e-6, origin: [{-L / 2}, {-W / 2}]}}"
listed = modes(body, "--at", f"{X},{Y}")
D, mass = 70e9 * 0.003 ** 3 / 12 / (1 - 0.22 ** 2), 7.5
angles = [(theta, phi) for phi in (0, 50) for theta in (0, 10, 20, 30, 45, 60, 75, 85)]
places = [[r * math.sin(math.radians(t)) * math.cos(math.radians(q)), r * math.sin(math.radians(t)) * math.sin(math.radians(q)), r * math.cos(math.radians(t))] for t, q in angles]
channels = sound(f"rasp: 1\nsurface:\n  modes: 80\n  {body}\nmotion: {{path: still, at: [{X - L / 2}, {Y - W / 2}], duration: 0.1}}\n{STRIKE}\n"
                 f"output: {{listen: {{radiator: plate, places: {json.dumps(places)}, density: {rho}, sound_speed: {c}}}, encoding: float64, level: {{dbfs_at_1_pa: 0}}, ramp: 0, tail: 2.1}}\n")

def factor(order, phase):  # ((-1)^m e^(j x) - 1)/((x/(m pi))^2 - 1)
    return ((-1) ** order * cmath.exp(1j * phase) - 1) / ((phase / order / math.pi) ** 2 - 1)

print("| mode (m, n) | f (Hz) | k/k_mode | phi | 0 degrees | 10 | 20 | 30 | 45 | 60 | 75 | 85 | worst of what is within 40 dB |")
print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
worst = 0
for m, n in ((1, 1), (3, 2), (7, 5)):
    f0 = math.pi / 2 * math.sqrt(D / mass) * ((m / L) ** 2 + (n / W) ** 2)
    f, d, _ = min(listed, key=lambda x: abs(x[0] - f0))
    if min(abs(g - f) for g, _, _ in listed if g != f) < 8:
        raise SystemExit(f"mode ({m}, {n}) stands too near another one")
    k, bend = 2 * math.pi * f / c, math.pi * math.hypot(m / L, n / W)
    u = 4 / (mass * L * W) * math.sin(m * math.pi * X / L) * math.sin(n * math.pi * Y / W) * strike_at(f, d)
    ours, want = [], []
    for (theta, phi), y in zip(angles, channels):
        s = k * math.sin(math.radians(theta))
        want.append(abs(rho * c * k * u / (2 * math.pi * r) * L * W / (m * n * math.pi ** 2) * factor(m, s * L * math.cos(math.radians(phi))) * factor(n, s * W * math.sin(math.radians(phi)))))
        ours.append(abs(amplitude(y, f, d, 0.05, 2)))
    top = max(want)
    for part in range(2):
        half = range(8 * part, 8 * part + 8)
        far = [db(ours[i] / want[i]) for i in half if want[i] > 0.01 * top]
        most = max(far, key=abs, default=None)
        worst = max(worst, abs(most or 0))
        cells = " | ".join(f"{db(want[i]):.2f}, {db(ours[i]):.2f}" if want[i] > 1e-9 * top else f"0, {db(ours[i]):.0f}" for i in half)
        print(f"| ({m}, {n}) | {f:.1f} | {k / bend:.3f} | {angles[8 * part][1]} | {cells} | {'' if most is None else format(most, '+.4f')} |")
print(f"\nWorst: {worst:.4f} dB; tolerance 0.05 dB, {'kept' if worst <= 0.05 else 'NOT KEPT'}.")
PY
}

# ------------------------------------------------------------------ 4

RUNS=3
speed() {
    local bench i
    for bench in resonators launch overlap_add; do
        for ((i = 0; i < RUNS; i++)); do
            "$BUILD/bench/$bench" > "$bench.$i"
        done
    done
    RUNS=$RUNS python3 << 'PY'
import csv, os
runs = range(int(os.environ["RUNS"]))
def least(bench, column, where):
    return min(float(row[column]) for i in runs for row in csv.DictReader(open(f"{bench}.{i}")) if where(row))
print("| what | cycles per sample | times real time | prototype |")
print("|---|---|---|---|")
for n, fixed, glide in ((50, "25 cycles", "31 to 34 (fixed and 6 to 9)"), (200, "76 cycles", ""), (1000, "374 cycles", "")):
    for kind, rate, was in (("fixed", 48000, fixed), ("glide", 48000, glide)):
        most = max(float(r[kind + "_times_real_time"]) for i in runs for r in csv.DictReader(open(f"resonators.{i}")) if r["modes"] == str(n))
        print(f"| resonators, {kind}, {n} modes | {least('resonators', kind + '_cycles', lambda r: r['modes'] == str(n)):.0f} | {most:.0f} | {was} |")
pick = lambda r: r["movement"] == "0.02" and r["hop"] == "128"
most = max(float(r["times_real_time"]) for i in runs for r in csv.DictReader(open(f"launch.{i}")) if pick(r))
print(f"| launch, 50 modes, nodes every 128 samples | {least('launch', 'cycles_per_sample', pick):.0f} | {most:.0f} | 20 times real time (overlap-add by FFT) |")
for what, keys, was in (("one that gets all", "1", "4.3 to 5.7 ms per 10 s (whole signal), 12 (blocks of 1024)"), ("passed one after the other", "2", "9.9 ms"), ("passed one after the other", "8", "8.5 ms"),
                        ("passed one after the other", "32", "13.8 ms"), ("passed one after the other", "128", "22.9 ms")):
    ms = least("overlap_add", "ms_per_10_s", lambda r: r["what"] == what and r["responses"] == keys)
    print(f"| FFT convolution, responses of 1 s: {what}, {keys} | {ms:.1f} ms per 10 s | {1e4 / ms:.0f} | {was} |")
PY
}

# ------------------------------------------------------------------ 5

SEEDS=24
nodal_scene() {
    rasp render "$ROOT/scenes/nodal_lines.yaml" -q -o drawn.wav 2> log || { cat log >&2; return 1; }
    rasp plot drawn.wav -o drawn.png > /dev/null
    mv drawn.png "$ROOT/evidence/nodal_lines.png"
    local seed
    for ((seed = 0; seed < SEEDS; seed++)); do
        rasp render "$ROOT/scenes/nodal_lines.yaml" -q -o "n$seed.wav" --seed=$seed \
            --set 'output={encoding: float64, ramp: 0, level: {full_scale: 1}, diagnostics: {rate: 1 kHz, columns: [x_m]}}' 2> log || { cat log >&2; return 1; }
    done
    rasp modes object "$ROOT/scenes/nodal_lines.yaml" -f -q --at 0.11,0.02 --listen 0.007,0.02 -o modes.csv # (-q: what it warns of stands in the table)
    SEEDS=$SEEDS python3 << 'PY'
from judge import *
L = 0.4
place = [float(r["x_m"]) for r in csv.DictReader(open("n0.csv"))]
listed = [(float(r["frequency_hz"]), float(r["decay_per_s"])) for r in table("modes.csv")]
first = min(f for f, _ in listed)
sigma = 0.015
sounds = [wav(f"n{k}.wav")[0] for k in range(int(os.environ["SEEDS"]))]
times = [0.05 + 0.02 * i for i in range(96)]

def at(t):
    return place[round(t * 1000)]

def level(y, f, t):
    total, step = 0, complex(0, -2 * math.pi * f / RATE)
    for n in range(max(0, round((t - 3.5 * sigma) * RATE)), min(len(y), round((t + 3.5 * sigma) * RATE))):
        u = (n / RATE - t) / sigma
        total += math.exp(-u * u / 2) * y[n] * cmath.exp(step * n)
    return abs(total)

def correlation(a, b):
    n = len(a)
    ma, mb = sum(a) / n, sum(b) / n
    return sum((x - ma) * (y - mb) for x, y in zip(a, b)) / math.sqrt(sum((x - ma) ** 2 for x in a) * sum((y - mb) ** 2 for y in b))

def rung(m, d, t):
    """rms of a mode under white force that passes its shape, in the window: what it still rings of earlier places too."""
    dt, total, past = 0.001, 0, 0.0
    for i in range(round((t + 3.5 * sigma) / dt)):
        u = i * dt
        past = past * math.exp(-2 * d * dt) + (math.sin(m * math.pi * place[i] / L) ** 2 * dt if i < len(place) and u < 2 else 0)
        total += past * math.exp(-((u - t) / sigma) ** 2 / 2)
    return math.sqrt(total)

columns, names, corr = [], [], []
for m in (5, 8, 11):
    f, d = min(listed, key=lambda x: abs(x[0] - m * m * first))
    each = [[level(y, f, t) for t in times] for y in sounds]
    mean = [math.sqrt(sum(e[i] ** 2 for e in each) / len(each)) for i in range(len(times))]
    shape = [abs(math.sin(m * math.pi * at(t) / L)) for t in times]
    ring = [rung(m, d, t) for t in times]
    columns.append(([x / max(mean) for x in mean], shape))
    names.append(str(m))
    gap = min(abs(g - f) for g, _ in listed if g != f)
    corr.append((m, f, 1 / d, gap, correlation(each[0], shape), correlation(mean, shape), correlation(mean, ring)))
print("| mode n | Hz | rings for 1/decay (ms) | nearest other mode (Hz) | correlation with the shape, the scene's own seed | rms of seeds | rms of seeds, with what still rings |")
print("|---|---|---|---|---|---|---|")
for name, f, tau, gap, one, many, ring in corr:
    print(f"| {name} | {f:.1f} | {1e3 * tau:.0f} | {gap:.0f} | {one:.3f} | {many:.3f} | {ring:.3f} |")
print("\n| time (s) | x (cm) | " + " | ".join(f"n = {x}: measured, shape" for x in names) + " |")
print("|---|---|" + "---|" * len(names))
for i in range(0, len(times), 3):
    print(f"| {times[i]:.2f} | {100 * at(times[i]):.1f} | " + " | ".join(f"{a[i]:.2f}, {b[i]:.2f}" for a, b in columns) + " |")
PY
}

for part in closed_forms nodal_strikes pulsating baffled speed nodal_scene; do
    $part > $part.md
done

{
    cat << MD
# Objects, nodal lines, radiators

Made by \`evidence/objects.sh\` with $(rasp --version), from the command line: recipes by \`rasp modes object\`, scenes by \`rasp render\` in 64-bit floats.

## Modes against published constants

Recipes whose \`E h^2/(12 rho)\` is 1 and whose damping is 0, so that the constants come out; of the two modes of a pair one is shown. Closed forms
(pi, square roots) are computed; all else is as printed. *Difference* is ours over the printed value, less 1.
Two sources are themselves coarser than they look: Leissa's table 2.5 of free disks, 0.2 % off (the later tables for nu = 0.3 agree in all digits), and the
targets of NAFEMS, rounded by half a digit too far (the same plate is the free square one above: 19.5961 makes 2.3595 Hz).

$(< closed_forms.md)

## Nodal lines

A supported plate, 60 x 42 cm, is struck (half a sine of 0.1 ms) on a nodal line of a mode, 1 mm to either side of it, and where that mode moves most, and is
heard at [7 cm, 5 cm]. Levels of the mode's line (Gaussian window of 2 s) are relative to the strike where it moves most; beside it what the sine of the
mode shape says; then how far the phase turns across the line: 180 degrees is the change of sign.

$(< nodal_strikes.md)

## Radiation

The strike of 0.1 ms and 1 mN s on one mode of 1 m/s per N s, its table with \`# radius_m: 0.1\`, heard at 1 m; pulsating sphere
p = rho c v (a/r) ka/sqrt(1 + (ka)^2). Tolerance 0.05 dB and 0.1 degrees.

$(< pulsating.md)

A supported plate in a baffle, 50 x 38 cm, struck off its centre, heard at 500 m under theta from its axis, phi from x: Wallace's far field (J. Acoust. Soc.
Am. 51, 1972, 946) of each mode, with the mode's velocity in closed form, and ours; dB re 1 Pa. \`k/k_mode\` is the sound's wave number over
the mode's: below 1 a mode short-circuits itself, above it it has a lobe. Where the formula says 0, ours is what rounding leaves.

$(< baffled.md)

## Cost

Least of $RUNS runs of the programs in tests/bench (each itself the least of 3 to 15), on a machine that is shared and under load; cycles of the time stamp
counter. The prototypes' figures (bit-exact forms; AVX-512) were measured on another kind of processor (Zen 5); only ratios within one column mean much.

$(< speed.md)

## A stroke across nodal lines

\`scenes/nodal_lines.yaml\` as it is: ![nodal lines](nodal_lines.png)

To be seen: the bar's partials as level lines, n^2 apart, which fade out and come back n - 1 times on the way, where the contact crosses their nodal
lines; of the low ones, which ring for longer than a crossing takes, the gaps are filled. The dark slanted curves that join the gaps are the
sum's zeros between its partials: each moves with the contact and passes a partial exactly at one of its nodal lines. Above 13 kHz the floor drops:
the roughness has no waves shorter than 15 um, and at 0.195 m/s that is 13 kHz.

Level of three modes (Gaussian window, standard deviation 15 ms, at the mode's frequency) against |sin(n pi x/L)| at that place; in the large table rms of
$SEEDS seeds, relative to its largest. What a mode still rings of where the contact was a moment ago keeps the zeros from being reached:
the last column of the small table adds up the shape's square with that decay.

$(< nodal_scene.md)
MD
} > report.md
mv report.md "$ROOT/evidence/objects.md"

"""The same job by what one would use instead: 10 s of noise at 44.1 kHz as a force on 50 modes, to a 24-bit WAV (float where a program writes no other). Whole
processes on one core, in turns, the least of REPEATS rounds. Only the work is comparable: the resonators of csound and scsynth have other zeros and phases, and
scsynth's are single precision. What is not installed is left out with a word."""
from runs import *
import math, shutil, tempfile

SECONDS = float(os.environ.get("SECONDS_OF_NOISE", "10"))
N = int(SECONDS * RATE)
FOLDER = tempfile.TemporaryDirectory(prefix="rasp-peers-")
os.chdir(FOLDER.name)
MODES = [(100 * 150 ** (k / 49), 0.9 * (150 ** (k / 49)) ** -0.3, 1 / (1 + k)) for k in range(50)]  # Hz, T60 s, gain


def rasp_job(moving):
    motion = "{path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 1 cm], rate: 1 Hz, duration: D s}" if moving else "{path: still, at: [10 cm, 0 cm], duration: D s}"
    name = "moving" if moving else "still"
    with open(name + ".yaml", "w") as out:
        out.write("rasp: 1\nsurface: {material: glass, object: {shape: plate, length: 40 cm, width: 20 cm, thickness: 3 mm, edges: supported}}\n"
                  f"motion: {motion.replace('D s', f'{SECONDS:g} s')}\ncontact: {{model: given, given: {{file: noise.npy, rate: {RATE}}}}}\n"
                  f"output: {{sample_rate: {RATE}, level: {{full_scale: 0.2}}, tail: 0}}\n")
    return [BUILD + "/rasp", "render", "-q", name + ".yaml", "-o", name + ".wav"], name + ".wav"


def csound_job(moving):
    name = "csound_moving" if moving else "csound_still"
    with open(name + ".csd", "w") as out:
        out.write(f"<CsoundSynthesizer>\n<CsOptions>\n-d -m0 -W -3 -o {name}.wav\n</CsOptions>\n<CsInstruments>\nsr = {RATE}\nksmps = 64\nnchnls = 1\n0dbfs = 1\ninstr 1\nain diskin2 \"noise.wav\", 1\nasum = 0\n")
        if moving:
            out.write("kg oscili 0.5, 2\nkg = kg + 0.6\n")
        for f, t60, gain in MODES:
            out.write(f"am mode ain, {f:.4f}, {math.pi * f * t60 / math.log(1000):.4f}\nasum = asum + am * {1e-6 * gain:.6g}{' * kg' if moving else ''}\n")
        out.write(f"out asum\nendin\n</CsInstruments>\n<CsScore>\ni 1 0 {SECONDS:g}\n</CsScore>\n</CsoundSynthesizer>\n")
    return ["csound", name + ".csd"], name + ".wav"


def synthdef():
    """A definition in the server's binary format, version 2: In, 50 x (Ringz, *), sum, Out."""
    text = lambda s: bytes([len(s)]) + s.encode()
    constants, units = [], []

    def constant(x):
        x = struct.unpack(">f", struct.pack(">f", x))[0]
        if x not in constants:
            constants.append(x)
        return -1, constants.index(x)

    def unit(name, inputs, outputs=1, special=0):
        units.append(text(name) + struct.pack(">bIIH", 2, len(inputs), outputs, special) + b"".join(struct.pack(">ii", *i) for i in inputs) + b"\x02" * outputs)
        return len(units) - 1, 0

    source, total = unit("In", [constant(1)]), None
    for f, t60, gain in MODES:
        mode = unit("BinaryOpUGen", [unit("Ringz", [source, constant(f), constant(t60)]), constant(1e-3 * gain)], special=2)
        total = mode if total is None else unit("BinaryOpUGen", [total, mode], special=0)
    unit("Out", [constant(0), total], outputs=0)
    body = text("modes") + struct.pack(">I", len(constants)) + b"".join(struct.pack(">f", c) for c in constants)
    body += struct.pack(">II", 0, 0) + struct.pack(">I", len(units)) + b"".join(units) + struct.pack(">H", 0)
    return b"SCgf" + struct.pack(">IH", 2, 1) + body


def scsynth_job():
    pad = lambda b: b + b"\0" * (4 - len(b) % 4)
    blob = synthdef()

    def bundle(seconds, *messages):
        data = b"#bundle\0" + struct.pack(">II", int(seconds), int(seconds % 1 * 2 ** 32)) + b"".join(struct.pack(">I", len(m)) + m for m in messages)
        return struct.pack(">I", len(data)) + data

    receive = pad(b"/d_recv") + pad(b",b") + struct.pack(">I", len(blob)) + blob + b"\0" * (-len(blob) % 4)
    new = pad(b"/s_new") + pad(b",siii") + pad(b"modes") + struct.pack(">iii", 1000, 0, 0)
    with open("score.osc", "wb") as out:
        out.write(bundle(0, receive, new) + bundle(SECONDS, pad(b"/c_set") + pad(b",ii") + struct.pack(">ii", 0, 0)))
    return ["scsynth", "-N", "score.osc", "noise.wav", "scsynth.wav", RATE, "WAV", "int24", "-o", 1, "-i", 1, "-m", 65536], "scsynth.wav"


def sox_job():
    """Convolution with the modes' response of 1 s."""
    response = [0.0] * RATE
    for f, t60, gain in MODES:
        z, pole = 1 + 0j, 10 ** (-3 / (t60 * RATE)) * complex(math.cos(2 * math.pi * f / RATE), math.sin(2 * math.pi * f / RATE))
        for i in range(RATE):
            response[i] += 1e-4 * gain * z.imag
            z *= pole
    with open("fir.txt", "w") as out:
        out.write("\n".join(f"{x:.12g}" for x in response))
    return ["sox", "noise.wav", "-b", 24, "sox.wav", "fir", "fir.txt"], "sox.wav"


SCIPY = """
import numpy, scipy.io.wavfile, scipy.signal
rate, x = scipy.io.wavfile.read("noise.wav")
x = x.astype(float)
y = numpy.zeros_like(x)
for line in open("modes.txt"):
    f, t60, gain = map(float, line.split())
    r, w = 10 ** (-3 / (t60 * rate)), 2 * numpy.pi * f / rate
    y += scipy.signal.lfilter([0, gain * r * numpy.sin(w)], [1, -2 * r * numpy.cos(w), r * r], x)
scipy.io.wavfile.write("scipy.wav", rate, (y / abs(y).max() * 0.5 * 2 ** 31).astype("int32"))
"""


def scipy_job():
    with open("modes.txt", "w") as out:
        out.writelines(f"{f} {t60} {gain}\n" for f, t60, gain in MODES)
    with open("lfilter.py", "w") as out:
        out.write(SCIPY)
    return [scipy_python(), "lfilter.py"], "scipy.wav"


def scipy_python():
    """Debian's own Python has Debian's SciPy; another one on the PATH may have none."""
    for python in ("/usr/bin/python3", "python3"):
        if shutil.which(python) and subprocess.run([python, "-c", "import scipy.signal"], stderr=QUIET).returncode == 0:
            return python
    return None


x = noise(N)
write_npy("noise.npy", x)
write_wav("noise.wav", x)
JOBS = {"rasp, object at rest": rasp_job(False), "rasp, moving contact": rasp_job(True)}
GOALS = {}
for present, name, make, goal in ((shutil.which("csound"), "csound `mode`, at rest", lambda: csound_job(False), 5), (shutil.which("csound"), "csound `mode`, gains move", lambda: csound_job(True), 5),
                                  (shutil.which("scsynth"), "scsynth -N, `Ringz`", scsynth_job, 4), (shutil.which("sox"), "sox fir, 1 s", sox_job, None), (scipy_python(), "SciPy `lfilter`", scipy_job, 25)):
    if present:
        JOBS[name], GOALS[name] = make(), goal
    else:
        print(f"{name}: not installed, left out\n")
least, failed = {}, {}
for _ in range(REPEATS):
    for name, (command, _) in JOBS.items():
        try:
            used = run(command, QUIET)
            least[name] = min(used, least.get(name, used))
        except RuntimeError as e:
            failed[name] = str(e)
def heard(file):
    """A sound of the whole length was written, which is not silence."""
    with open(file, "rb") as f:
        data = f.read()
    return len(data) >= 2.9 * N and len(set(data[len(data) // 2:len(data) // 2 + 3000])) > 100


for name in least:
    if name not in failed and not heard(JOBS[name][1]):
        failed[name] = "wrote no sound of the whole length"
print("| program | CPU time (ms) | times real time | rasp is faster by (at rest / moving) | goal | |\n|---|---|---|---|---|---|")
rest, moving = least["rasp, object at rest"][0], least["rasp, moving contact"][0]
for name, (cpu, wall) in least.items():
    goal, ours = GOALS.get(name), moving if "move" in name else rest
    verdict = "" if not goal else "met" if cpu / ours >= goal else "not met"
    print(f"| {name} | {1e3 * cpu:.1f} | {SECONDS / cpu:.0f} | {'' if name.startswith('rasp') else f'{cpu / rest:.1f} / {cpu / moving:.1f}'} | {goal or ''} | {verdict} |")
for name, why in failed.items():
    print(f"\n{name}: {why}")

"""The files that a scene names: height maps, responses, motions, forces, densities; each a function of the generator's
random numbers."""
import hashlib
import math
import struct
import subprocess
import zlib


def text(scene, name, lines):
    (scene.folder / name).write_text("\n".join(lines) + "\n")
    return name


def table(scene, kind, header, rows, before=()):
    """CSV."""
    return text(scene, scene.name(kind, ".csv"),
        [*before, ",".join(header), *(",".join(map(cell, row)) for row in rows)])


def cell(value):
    return f"{value:.9g}" if isinstance(value, float) else str(value)


# ------------------------------------------------------------------ heights

def heights(rng, columns, rows, rms):
    """Smooth noise, rough enough to be heard: a random walk that forgets, along both axes."""
    out, above = [], [0.0] * columns
    for _ in range(rows):
        row, h = [], 0.0
        for c in range(columns):
            h = 0.8 * h + rng.gauss(0, 1)
            row.append(0.5 * above[c] + h if rows > 1 else h)
        above = row
        out.append(row)
    return [[h * rms / 1.7 for h in row] for row in out]


def npy(path, array, kind, fortran=False):
    """array: rows of numbers, or one list; kind: f4, f8, i2 or i4."""
    flat = array if not isinstance(array[0], list) else [x for row in (zip(*array) if fortran else array) for x in row]
    shape = f"({len(array)},)" if not isinstance(array[0], list) else f"({len(array)}, {len(array[0])})"
    header = f"{{'descr': '<{kind}', 'fortran_order': {fortran}, 'shape': {shape}, }}"
    header += " " * (-(len(header) + 11) % 64) + "\n"
    if kind[0] == "i":
        flat = [round(x) for x in flat]
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
        + struct.pack(f"<{len(flat)}{dict(f4='f', f8='d', i2='h', i4='i')[kind]}", *flat))


def png(path, array):
    """Grey of 16 bits: array holds whole numbers from 0 to 65535."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in array)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR",
        struct.pack(">IIBBBBB", len(array[0]), len(array), 16, 0, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(lines))
        + chunk(b"IEND", b""))


def gsf(path, array, pitch):
    columns, rows = len(array[0]), len(array)
    header = (f"Gwyddion Simple Field 1.0\nXRes = {columns}\nYRes = {rows}\nXReal = {columns * pitch!r}\n"
              f"YReal = {rows * pitch!r}\nXYUnits = m\nZUnits = m\n").encode()
    flat = [x for row in array for x in row]
    path.write_bytes(header + b"\0" * (4 - len(header) % 4) + struct.pack(f"<{len(flat)}f", *flat))


class Map:
    """A height map in one of the formats: its file's name, and what the scene must say beside it."""

    def __init__(self, scene, holes=False, formats=("gsf", "gwy", "sdf", "npy", "png", "csv"), metres=False):
        rng = scene.rng
        self.rows = rng.choice([1, 1, rng.randint(4, 40)])
        self.columns = rng.randint(64, 2000 if self.rows == 1 else 100)
        self.pitch = float(f"{math.exp(rng.uniform(math.log(2e-6), math.log(1e-4))):.3g}")
        rms = math.exp(rng.uniform(math.log(1e-7), math.log(1e-5)))
        h = heights(rng, self.columns, self.rows, rms)
        self.format = rng.choice(formats)
        self.scale = self.range = None
        name = scene.name("map", "." + self.format)
        path = scene.folder / name
        if holes:
            self.format, name = "csv", scene.name("map", ".csv")
            path = scene.folder / name
            h[0][self.columns // 2] = None
        if self.format == "gsf":
            gsf(path, h, self.pitch)
        elif self.format in ("gwy", "sdf"):
            gsf(scene.folder / "map.gsf", h, self.pitch)
            subprocess.run([scene.rasp, "surface", "convert", "-q",
                *(["--text"] if self.format == "sdf" and rng.random() < 0.5 else []), "map.gsf", name],
                cwd=scene.folder, check=True, capture_output=True)
            (scene.folder / "map.gsf").unlink()
        elif self.format == "npy":
            kind = rng.choice(["f4", "f8"] if metres else ["f4", "f8", "i2", "i4"])
            self.scale = 1.0 if kind[0] == "f" else float(f"{rms / 1000:.3g}")
            h = [[x / self.scale for x in row] for row in h]
            if kind == "i2":
                h = [[min(32767, max(-32768, x)) for x in row] for row in h]
            npy(path, h if self.rows > 1 or rng.random() < 0.5 else h[0], kind, fortran=self.rows > 1
                and rng.random() < 0.3)
        elif self.format == "png":
            least, most = min(map(min, h)), max(map(max, h))
            self.range = float(f"{max(most - least, 1e-9):.4g}")
            png(path, [[min(65535, round((x - least) / self.range * 65535)) for x in row] for row in h])
        else:
            self.scale = 1.0 if metres else rng.choice([1.0, 1e-6])
            separator = rng.choice([",", ";", " ", "\t"] if not holes else [",", ";"])
            text(scene, name, [separator.join("" if x is None else f"{x / self.scale:.6g}" for x in row) for row in h])
        self.name = name
        self.holds_pitch = self.format in ("gsf", "gwy", "sdf")
        self.field = (0, 0, (self.columns - 1) * self.pitch, max(self.rows - 1, 1) * self.pitch)
        scene.note(f"height map: {self.format}{', a profile' if self.rows == 1 else ''}")


# ------------------------------------------------------------------ sound files

def wav(path, channels, rate, encoding):
    """channels: lists of numbers from -1 to 1; encoding: pcm16, pcm24, float32, float64."""
    frames = list(zip(*channels))
    if encoding in ("float32", "float64"):
        data = b"".join(struct.pack(f"<{len(f)}{'f' if encoding == 'float32' else 'd'}", *f) for f in frames)
    elif encoding == "pcm16":
        data = b"".join(struct.pack("<h", round(max(-1, min(1, x)) * 32767)) for f in frames for x in f)
    else:
        data = b"".join(round(max(-1, min(1, x)) * 8388607).to_bytes(3, "little", signed=True) for f in frames
            for x in f)
    size = {"pcm16": 2, "pcm24": 3, "float32": 4, "float64": 8}[encoding] * len(channels)
    tag = 3 if encoding.startswith("float") else 1
    head = struct.pack("<HHIIHH", tag, len(channels), rate, rate * size, size, size // len(channels) * 8)
    path.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<I", 16) + head + b"data"
        + struct.pack("<I", len(data)) + data)


ENCODINGS = ["pcm16", "pcm24", "float32", "float64"]


def ringing(rng, rate, seconds):
    """An impulse response: decaying sines."""
    modes = [(rng.uniform(100, rate * 0.4), math.exp(rng.uniform(math.log(10), math.log(300))), rng.uniform(-0.3, 0.3))
        for _ in range(rng.randint(1, 4))]
    return [sum(g * math.exp(-d * n / rate) * math.sin(2 * math.pi * f * n / rate) for f, d, g in modes)
        for n in range(int(rate * seconds))]


def impulse_response(scene):
    rng = scene.rng
    name, rate = scene.name("response", ".wav"), rng.choice([16000, 22050, 44100, 48000])
    wav(scene.folder / name, [ringing(rng, rate, rng.uniform(0.005, 0.05))], rate, rng.choice(ENCODINGS))
    return name


def folder_of_responses(scene, field):
    """WAVs at places, and their index."""
    rng, name = scene.rng, scene.name("responses", "")
    (scene.folder / name).mkdir()
    gains = rng.random() < 0.5
    rows = []
    for i, (x, y) in enumerate(places(rng, field, rng.choice(["one", "line", "plane"]))):
        wav(scene.folder / name / f"{i}.wav", [ringing(rng, 16000, 0.01)], 16000, "float32")
        rows.append([f"{i}.wav", x, y, *([rng.uniform(-6, 6)] if gains else [])])
    text(scene, name + "/index.csv", [",".join(["file_name", "x_m", "y_m", *(["gain_db"] if gains else [])]),
        *(",".join(map(cell, row)) for row in rows)])
    return name


def places(rng, field, kind):
    """Where a response is known: at one place, on a line across the field, or a grid over it whose places are a little
    off."""
    x0, y0, x1, y1 = field
    if kind == "one":
        return [((x0 + x1) / 2, (y0 + y1) / 2)]
    if kind == "line":
        n = rng.randint(2, 6)
        return [(x0 + (x1 - x0) * i / (n - 1), (y0 + y1) / 2) for i in range(n)]
    nx, ny, off = rng.randint(2, 5), rng.randint(2, 4), rng.choice([0, 0.1])
    grid = [(x0 + (x1 - x0) * (i + off * rng.uniform(-1, 1) * (0 < i < nx - 1)) / (nx - 1), y0
        + (y1 - y0) * (j + off * rng.uniform(-1, 1) * (0 < j < ny - 1)) / (ny - 1))
            for j in range(ny) for i in range(nx)]
    if rng.random() < 0.5:
        rng.shuffle(grid)
    return grid


# ------------------------------------------------------------------ mode tables

def mode_table(scene, field, kind, drives=False):
    """Modes at places: one, a line, the plane. drives: such that a ball may press on them (what is heard is what is
    touched)."""
    rng = scene.rng
    shared = drives or rng.random() < 0.6
    form = "plain" if drives else rng.choices(["plain", "slopes", "envelope"], [6, 1, 1])[0]
    modes = sorted(math.exp(rng.uniform(math.log(80), math.log(9000))) for _ in range(rng.randint(1, 12)))
    decays = [math.exp(rng.uniform(math.log(3), math.log(300))) for _ in modes]
    before = [f"# poles: {'shared' if shared else 'separate'}",
        f"# quantity: {'velocity' if drives else scene.quantity}"]
    before += ["# pairing: " + ("ids" if shared or rng.random() < 0.5 else "frequency")] * (rng.random() < 0.4) + [
        f"# radius_m: {rng.uniform(0.01, 0.3):.3g}"]
    header = ["place", "x_m", "y_m", "mode", "frequency_hz",
        *(["time_s", "amplitude"] if form == "envelope" else ["decay_per_s", "gain"]), "phase_rad",
        *(["slope"] if form == "slopes" else [])]
    rows = []
    for p, (x, y) in enumerate(places(rng, field, kind), 1):
        for m, (f, d) in enumerate(zip(modes, decays), 1):
            if not shared:
                f, d = f * rng.uniform(0.97, 1.03), d * rng.uniform(0.8, 1.2)
                if len(modes) > 2 and rng.random() < 0.05:
                    continue
            gain, phase = (rng.uniform(0, 1), math.pi / 2) if drives else (rng.uniform(-1, 1),
                rng.choice([0, rng.uniform(-3, 3)]))
            if form == "envelope":
                rows += [[p, x, y, m, f, t, abs(gain) * math.exp(-d * t), phase]
                    for t in (i * 0.5 / d for i in range(12))]
            else:
                rows.append([p, x, y, m, f, d, gain, phase, *([1] if form == "slopes" else [])])
                if form == "slopes":
                    rows.append([p, x, y, m, f, d * 4, gain / 2, phase, 2])
    where = {"one": "one place", "line": "a line", "plane": "the plane"}[kind]
    scene.note(f"mode table: {form}, {'shared' if shared else 'separate'} poles, {where}")
    return table(scene, "modes", header, rows, before), shared


def residual(scene):
    """A folder as rasp modes residual writes it; the name of its residual.yaml."""
    rng, name = scene.rng, scene.name("residual", "")
    (scene.folder / name).mkdir()
    rate = rng.choice([16000, 44100, 48000])
    burst = [math.exp(-rng.uniform(50, 500) * n / rate) * rng.gauss(0, 1) for n in range(int(rate * rng.uniform(0.005, 0.2)))]
    wav(scene.folder / name / "residual.wav", [burst], rate, "float32")
    wav(scene.folder / name / "strike.wav", [burst, burst], rate, "float32")
    rows = sorted([math.exp(rng.uniform(math.log(80), math.log(9000))), math.exp(rng.uniform(math.log(3), math.log(300))), rng.uniform(0, 1), 1.57,
        rng.choice([0, rng.random(), 1]), rng.random()] for _ in range(rng.randint(1, 12)))
    text(scene, name + "/modes.csv", ["frequency_hz,decay_per_s,gain,phase_rad,match_ratio,strike_energy", *(",".join(map(cell, row)) for row in rows)])
    files = [f'  - {{file: {f}, sha256: "{hashlib.sha256((scene.folder / name / f).read_bytes()).hexdigest()}"}}' for f in ("residual.wav", "modes.csv", "strike.wav")]
    text(scene, name + "/residual.yaml", ["rasp_residual: 3", f"sample_rate: {rate}", "files:", *files])
    return name + "/residual.yaml"


# ------------------------------------------------------------------ what goes over time

def rising(rng, seconds, every):
    """Times from 0, a little uneven, to just beyond `seconds`."""
    times, t = [], 0.0
    while t < seconds * 1.05 + 2 * every:
        times.append(t)
        t += every * rng.uniform(0.7, 1.3)
    return times


def wave(rng, low, high, seconds):
    """A smooth function of time between two values."""
    waves = [(rng.uniform(0.2, 2) / seconds, rng.uniform(0, 7)) for _ in range(3)]
    return lambda t: low + (high - low) * (0.5 + sum(math.sin(2 * math.pi * f * t + p) for f, p in waves) / 6)

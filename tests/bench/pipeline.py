"""What whole renders cost: one Markdown table of jobs beside their goals, one of the share of each stage, memory, growth with duration and modes, start-up.

A job is rendered for a short and a long duration, and what it costs a sample is the difference over the samples between, so that start-up is not in. Cycles are
of the core clock, which is measured before each render, as is a scalar loop over 50 modes (yardstick.c), the unit of the last column. Each number is the least
of REPEATS rounds, in which all jobs take turns. Times real time is what the cycles make of a core of 3.6 GHz at 44.1 kHz; goals are stated so."""
from runs import *
import tempfile

LONG = float(os.environ.get("LONG", "600"))
ONLY = os.environ.get("ONLY", "")
SHORT, STEADY = (float(s) for s in os.environ.get("DURATIONS", "2 12").split())
FOLDER = tempfile.TemporaryDirectory(prefix="rasp-bench-")
os.chdir(FOLDER.name)

PLATE = "material: glass, object: {shape: plate, length: 40 cm, width: 20 cm, thickness: 3 mm, edges: supported}"
STROKES = "motion: {path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 1 cm], rate: 1 Hz, duration: D s}"
TABLE = "diagnostics: {rate: 1 kHz}"
GIVEN = "contact: {model: given, given: {file: force_D.npy, rate: 44100}}"
SCRAPER = "scraper: {mass: 20 g}\nload: {constant: 1 N}"
BALL = "ball: {radius: 1 cm, material: steel, patch: 0}"


def scene(surface, body, output="", accuracy="standard"):
    return f"rasp: 1\nseed: 7\nsurface: {{{surface}}}\n{body}\naccuracy: {accuracy}\noutput: {{sample_rate: 44.1 kHz, level: {{full_scale: 10}}, ramp: 0, tail: 0, {output}}}\n"


def moving(surface, **more):
    return scene(f"{surface}, {PLATE}", f"{STROKES}\n{SCRAPER}", **more)


def coupled(integrator, sub, steps):
    return scene(f"fractal: {{exponent: -0.5, maximum: 0.1 um, pitch: 0.1 mm}}, {PLATE}",
                 f"{BALL}\n{STROKES}\ncontact: {{model: roll_coupled, roll: {{kappa: 5e7 N/(m^1.5 kg), integrator: {integrator}, ground: elastic}}}}",
                 accuracy=f"{{oversampling: {sub}, contact_steps: {steps}}}")


PROFILE, MAP = f"height_map: {ROOT}/surfaces/ridged_plate.gsf", "height_map: map.npy, pitch: 50 um, off_map: mirror"
ROUGH, ROUGH_PLANE = "roughness: {rms: 5 um}, along: path", "roughness: {rms: 5 um}, along: plane"
# name: (scene, accuracy, goal in times real time or None)
JOBS = {
    "object at rest, 50 modes, given force": (scene(PLATE, f"motion: {{path: still, at: [10 cm, 0 cm], duration: D s}}\n{GIVEN}"), "standard", 1800),
    "the same, moving contact, fixed": (scene(PLATE, f"{STROKES}\n{GIVEN}"), "standard", 1800),
    "the same, moving contact, glide": (scene(PLATE + ", moving: glide", f"{STROKES}\n{GIVEN}"), "standard", 1800),
    "bar whose poles move, glide": (scene(f"response: {ROOT}/irs/pvc_bar_loaded.csv, moving: glide", f"{STROKES.replace('1 cm', '0 cm')}\n{GIVEN}"), "standard", None),
}
for accuracy in ("draft", "standard"):
    JOBS |= {
        f"scrape, profile, {accuracy}": (moving(PROFILE, accuracy=accuracy), accuracy, 900),
        f"scrape, profile, CSV 1 kHz, {accuracy}": (moving(PROFILE, accuracy=accuracy, output=TABLE), accuracy, 700),
        f"scrape, roughness on a line, {accuracy}": (moving(ROUGH, accuracy=accuracy), accuracy, 900),
        f"scrape, 2-D map, CSV 1 kHz, {accuracy}": (moving(MAP, accuracy=accuracy, output=TABLE), accuracy, 480),
        f"scrape, 2-D roughness, CSV 1 kHz, {accuracy}": (moving(ROUGH_PLANE, accuracy=accuracy, output=TABLE), accuracy, 480),
    }
JOBS |= {
    "coupled ball, 50 modes, implicit, 1 step a sample": (coupled("discrete_gradient", 1, 1), "1 step", 300),
    "coupled ball, 50 modes, implicit, 8 steps a sample": (coupled("discrete_gradient", 8, 1), "8 steps", 38),
    # rk4 at one step a sample is refused: its own damping would drown that of the modes.
    "coupled ball, 50 modes, explicit (rk4), 8 steps a sample": (coupled("rk4", 8, 12), "8 steps", 125),
    "32 recorded responses of 1 s": (scene("response: set, extrapolate: nearest", f"{STROKES.replace('rate: 1 Hz', 'rate: 0.05 Hz')}\n{GIVEN}"), "standard", 600),
}
JOBS = {name: job for name, job in JOBS.items() if ONLY in name}


def prepare():
    for seconds in {SHORT, STEADY}:
        write_npy(f"force_{seconds:g}.npy", noise(int(seconds * RATE)))
    write_npy("map.npy", array.array("d", (1e-6 * z for z in noise(200 * 1000, 99))), 200)
    os.mkdir("set")
    with open("set/index.csv", "w") as index:
        index.write("file_name,x_m,y_m\n")
        for k in range(32):
            x = noise(RATE, k + 2)
            for i in range(RATE):
                x[i] *= 0.5 * 10 ** (-3 * i / RATE)
            write_wav(f"set/{k}.wav", x)
            index.write(f"{k}.wav,{0.1 + 0.1 * k / 31:.6f},{0.01 * k / 31:.6f}\n")


def write(text, seconds, name):
    with open(name + ".yaml", "w") as out:
        out.write(text.replace("D s}", f"{seconds:g} s}}").replace("force_D", f"force_{seconds:g}"))
    return [BUILD + "/rasp", "render", "-q", name + ".yaml", "-o", name + ".wav"]


def render(text, seconds, name="job"):
    return run(write(text, seconds, name))


def memory_of(text, seconds):
    """Largest resident memory in MB, looked at while it runs (what wait reports counts the Python that started it)."""
    child, most = subprocess.Popen(write(text, seconds, "job")), 0
    while child.poll() is None:
        try:
            with open(f"/proc/{child.pid}/status") as f:
                most = max([most] + [int(line.split()[1]) for line in f if line.startswith("VmHWM") and os.readlink(f"/proc/{child.pid}/exe").endswith("rasp")])
        except OSError:
            pass
        time.sleep(0.002)
    return most / 1024


def stages(name):
    with open(name + ".json") as f:
        summary = json.load(f)
    rows = [(s["stage"], s["cpu_s"]) for c in summary["contacts"] for s in c["stages"]]
    return summary["cpu_s"], rows, sum(s["bytes"] for c in summary["contacts"] for s in c["stages"])


class Least:
    """The least of what is measured, each by itself."""
    def __init__(self):
        self.kept = {}

    def take(self, key, value):
        self.kept[key] = min(value, self.kept.get(key, float("inf")))


def jobs():
    seen, shares = {name: Least() for name in JOBS}, {}
    for _ in range(REPEATS):
        for k, (name, (text, _, _)) in enumerate(JOBS.items()):
            for seconds in (SHORT, STEADY):
                clock, scalar = yardstick()
                cpu, _ = render(text, seconds, f"job{k}")
                seen[name].take(("cycles", seconds), cpu * clock)
                seen[name].take(("scalar", seconds), cpu / scalar)
            total, rows, size = stages(f"job{k}")
            if total < shares.get(name, (float("inf"),))[0]:
                shares[name] = total, rows, size
    print("| job | accuracy | cycles a sample | times real time at 3.6 GHz | goal | | over the scalar loop of 50 modes |\n|---|---|---|---|---|---|---|")
    cost = {}
    for name, (_, accuracy, goal) in JOBS.items():
        kept, samples = seen[name].kept, (STEADY - SHORT) * RATE
        cycles = (kept["cycles", STEADY] - kept["cycles", SHORT]) / samples
        ratio = (kept["scalar", STEADY] - kept["scalar", SHORT]) / samples
        if cycles <= 0:
            print(f"| {name} | {accuracy} | the difference of durations drowns in the noise | | {goal or ''} | | |")
            continue
        cost[name] = cycles
        speed = 3.6e9 / (RATE * cycles)
        print(f"| {name.removesuffix(', ' + accuracy)} | {accuracy} | {cycles:.0f} | {speed:.0f} | {goal or ''} | {'' if not goal else 'met' if speed >= goal else 'not met'} | {ratio:.2f} |")
    glide, fixed = "the same, moving contact, glide", "the same, moving contact, fixed"
    if glide in cost and fixed in cost:
        more = cost[glide] - cost[fixed]
        print(f"| what glide adds to fixed (moving poles and gains) | standard | {more:.0f} | | +10 cycles | {'met' if more <= 10 else 'not met'} | |")
    print(f"\n| job | cycles a sample by stage, of a render of {STEADY:g} s, reading and choosing with it | stages hold (kB) |\n|---|---|---|")
    for name, (total, rows, size) in shares.items():
        cycles = seen[name].kept["cycles", STEADY] / (STEADY * RATE)
        rows.append(("summing, writing, reading", total - sum(cpu for _, cpu in rows)))
        told = ", ".join(f"{stage} {cycles * cpu / total:.0f} ({100 * cpu / total:.0f} %)" for stage, cpu in sorted(rows, key=lambda row: -row[1]) if cpu >= 0.01 * total)
        print(f"| {name} | {told} | {size / 1000:.0f} |")


def row(what, value, goal, met):
    print(f"| {what} | {value} | {goal} | {'met' if met else 'not met'} |", flush=True)


TEN = "columns: [time_s, x_m, y_m, vx_m_per_s, vy_m_per_s, stroke_m, speed_m_per_s, normal_force_n, force_mean_n, force_peak_n]"


def tables():
    """What a row a sample costs, of 10 columns and of all that a scrape has: the bytes of CSV over what it adds to the render without (columns, text, checksum, file); renders with .npy over the same
    without. As in the jobs, what begins and ends a render is not in."""
    for accuracy in ("draft", "standard"):
        outputs = {("none",): ""} | {(form, n): f"diagnostics: {{rate: 44.1 kHz, format: {form}{columns}}}" for form in ("csv", "npy") for n, columns in (("10", ", " + TEN), ("all", ""))}
        kept, size = Least(), {}
        for _ in range(REPEATS):
            for key, output in outputs.items():
                for seconds in (SHORT, STEADY):
                    clock, _ = yardstick()
                    name = f"table_{'_'.join(key)}"
                    kept.take((key, seconds), clock * render(moving(PROFILE, output=output, accuracy=accuracy), seconds, name)[0])
                    size[key, seconds] = os.path.getsize(f"{name}.csv") if key[0] == "csv" else 0
        with open("table_csv_all.csv") as table:
            count = len(next(line for line in table if not line.startswith("#")).split(","))
        cost = {key: kept.kept[key, STEADY] - kept.kept[key, SHORT] for key in outputs}
        for n in ("10", "all"):
            named = f"{count if n == 'all' else n} columns at 44.1 kHz, profile, {accuracy}"
            rate = (size[("csv", n), STEADY] - size[("csv", n), SHORT]) / (cost["csv", n] - cost["none",]) * 3.6e9 / 1e6
            row(f"CSV, MB/s at 3.6 GHz: its bytes over what it adds, {named}", f"{rate:.0f}", "500", rate >= 500)
            ratio = cost["npy", n] / cost["none",]
            row(f".npy, a sample over that of the render without, {named}", f"{ratio:.1f}", "2.5", ratio <= 2.5)


def batches():
    """Stimuli of 2 s in one command, all of one core."""
    count = 20
    for output, what, goal in ((TABLE, "CSV at 1 kHz", 300), (f"diagnostics: {{rate: 44.1 kHz, {TEN}}}", "CSV of 10 columns at 44.1 kHz", 38)):
        for accuracy in ("draft", "standard"):
            for k in range(count):
                with open(f"stimulus{k}.yaml", "w") as out:
                    out.write(moving(PROFILE, output=output, accuracy=accuracy).replace("D s}", "2 s}").replace("seed: 7", f"seed: {k}"))
            cycles = min(clock * run([BUILD + "/rasp", "render", "-q", *(f"stimulus{k}.yaml" for k in range(count)), "-o", "batch/"])[0] for clock, _ in (yardstick() for _ in range(REPEATS)))
            rate = 3.6e9 * count / cycles
            row(f"stimuli of 2 s a second on one core at 3.6 GHz, profile, WAV and {what}, {accuracy}", f"{rate:.0f}", f"{goal}", rate >= goal)


def start_up():
    text = scene(f"response: {ROOT}/irs/pvc_rod.csv", "motion: {path: still, duration: 10 ms}\nscraper: {mass: 5 g}\ncontact: {model: strike, strike: {speed: 1 m/s, stiffness: 1e6 N/m, pulse: half_sine, first: 0 s}}", accuracy="draft")
    wall = cpu = float("inf")
    for _ in range(10 * REPEATS):
        used = render(text, 1)
        cpu, wall = min(cpu, used[0]), min(wall, used[1])
    row("rasp on a tiny scene, whole process", f"{1e3 * wall:.1f} ms ({1e3 * cpu:.1f} ms CPU)", "3 ms", wall <= 3e-3)


def growth():
    text = moving(PROFILE, accuracy="draft")
    memory = {seconds: memory_of(text, seconds) for seconds in (10, LONG)}
    row(f"memory of {LONG:g} s over that of 10 s", f"{memory[LONG]:.1f} MB / {memory[10]:.1f} MB = {memory[LONG] / memory[10]:.3f}", "within 10 %", memory[LONG] <= 1.1 * memory[10])
    costs = {seconds: min(clock * render(text, seconds)[0] for clock, _ in (yardstick() for _ in range(REPEATS))) / 1e6 for seconds in (5, 10, 20, 40)}
    slopes = [(costs[2 * s] - costs[s]) / s / RATE * 1e6 for s in (5, 10, 20)]
    row("cycles a sample from 5 to 10, 10 to 20, 20 to 40 s", ", ".join(f"{s:.0f}" for s in slopes), "the same within 15 %", max(slopes) <= 1.15 * min(slopes))
    slopes, last = [], None
    for modes in (50, 100, 150):
        best = min(clock * (render(scene(PLATE.replace("material", f"modes: {modes}, material"), f"{STROKES}\n{GIVEN}"), STEADY)[0] - render(scene(PLATE.replace("material", f"modes: {modes}, material"), f"{STROKES}\n{GIVEN}"), SHORT)[0])
                   for clock, _ in (yardstick() for _ in range(REPEATS))) / (STEADY - SHORT) / RATE
        slopes += [best - last] if last is not None else []
        last = best
    row("cycles a sample that 50 more modes cost, from 50 to 100, 100 to 150", ", ".join(f"{s:.0f}" for s in slopes), "the same within 30 %", max(slopes) <= 1.3 * min(slopes))


if __name__ == "__main__":
    prepare()
    if JOBS:
        jobs()
    if not ONLY:
        print("\n| | measured | goal | |\n|---|---|---|---|")
        start_up()
        tables()
        batches()
        growth()

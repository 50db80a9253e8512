"""Where the instructions of a steady audio sample go: six jobs of pipeline.py under callgrind, by part of the program; and their time, as cycles and over the yardstick.

Counted are two renders of SHORT and LONG seconds, and their difference over the samples between, so that reading, choosing and opening are not in. Instructions are those a function
has itself, added up by its source file (PARTS); valgrind's CPU has AVX2 and no AVX-512. Two counts of one render are the same to a few, whatever else the machine does."""
from pipeline import *
import re, sys

SHORT, LONG = 2.0, 4.0
SCENES = {"1-D profile, draft": "scrape, profile, draft", "1-D profile, standard": "scrape, profile, standard", "2-D map, CSV 1 kHz, draft": "scrape, 2-D map, CSV 1 kHz, draft",
          "object at rest, given force": "object at rest, 50 modes, given force", "coupled ball, 1 step a sample": "coupled ball, 50 modes, implicit, 1 step a sample",
          "coupled ball, 8 steps a sample": "coupled ball, 50 modes, implicit, 8 steps a sample"}
SCENES = {name: job for name, job in SCENES.items() if job in JOBS}
# part: what the names of file:function match, the first that does
PARTS = {
    "motion": r"src/trajectory/|vecmath_sincospi|:(stroke_|at_inside)",
    "cutting the way at knots": r"src/force/path_cells|:(knots_first|cut_)",
    "the curve the ball rolls on": r"src/surface/rolling_envelope|src/convolution/roll_curve|lanes\.h:(begin|look|move|rest)$",
    "coupled steps: modes": r"coupled_modal_sum|coupled\.c:(feel|yield)$",
    "coupled steps: force": r"coupled_pinch|hertz_mean",
    "coupled steps: ball and ledger; shapes at a run's start": r"coupled_gradient|coupled_parts",
    "coupled runs: state, balance, shapes": r"src/convolution/(coupled|roll_)",
    "limiter: means of tanh": r"src/surface/limiter|vecmath_tanh|:(cells_|points_)",
    "surface: second derivatives": r"src/surface/|:(batch_|bicubic_|sum_)",
    "slope along the way": r"src/force/path_integral|:slope_",
    "force": r"src/force/(scrape|smooth)|:scrape_",
    "decimation": r"src/force/decimate",
    "force from a file": r"src/(force/(given|onset)|file/bytes|file/npy|file/heightfile)",
    "modes": r"src/convolution/|src/response/",
    "table of diagnostics": r"src/output/force_table|src/num/decimal|src/file/csv",
    "sound, WAV": r"src/(output|file)/|sndfile",
    "checksum of inputs and tables": r"(?i)sha\d|crypto|src/base/hash",
    "runner": r"src/pipeline/|src/base/|clock_gettime",
    "copying and clearing memory": r"mem(set|cpy|move)",
}
CLONE = re.compile(r"\.arch_x86_64_v\d|'\d+$")
# Without, valgrind counts each byte that `rep stosb` writes as an instruction.
PLAIN = "glibc.cpu.x86_rep_movsb_threshold=1000000000:glibc.cpu.x86_rep_stosb_threshold=1000000000"


def counted(rasp, text, seconds):
    """Instructions by (file, function)."""
    command = [rasp] + write(text, seconds, "counted")[1:]
    subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=callgrind.out", *command], check=True, stdout=QUIET, stderr=QUIET, env=os.environ | {"GLIBC_TUNABLES": PLAIN})
    told = subprocess.run(["callgrind_annotate", "--threshold=100", "--show-percs=no", "callgrind.out"], capture_output=True, text=True, check=True).stdout
    found = {}
    for line in told.splitlines():
        match = re.match(r"\s*([\d,]+)\s+(\S+?):(\S+)(?: \[(\S+)\])?$", line)
        if match:
            key = f"{match[2]}:{CLONE.sub('', match[3])} {match[4] or ''}"
            found[key] = found.get(key, 0) + int(match[1].replace(",", ""))
    return found


def part_of(key):
    words = key.split()
    library = words[1].rsplit("/", 1)[-1] if len(words) > 1 else ""
    return next((part for part, pattern in PARTS.items() if re.search(pattern, words[0]) or re.search(pattern, library)), "other")


def profile(rasp, name):
    """Instructions a sample by part, and by function."""
    text = JOBS[SCENES[name]][0]
    short, long = counted(rasp, text, SHORT), counted(rasp, text, LONG)
    functions, parts = {}, {}
    for key, n in long.items():
        each = (n - short.get(key, 0)) / ((LONG - SHORT) * RATE)
        function = key.split()[0].rsplit(":", 1)[1]
        functions[function] = functions.get(function, 0) + each
        parts[part_of(key)] = parts.get(part_of(key), 0) + each
    return parts, functions


def times(rasps):
    """Least cycles and yardsticks a sample of interleaved runs."""
    kept = Least()
    for _ in range(REPEATS):
        for name, job in SCENES.items():
            for rasp in rasps:
                for seconds in (2.0, 22.0):
                    clock, scalar = yardstick()
                    cpu, _ = run([rasp] + write(JOBS[job][0], seconds, "timed")[1:])
                    kept.take((name, rasp, seconds, "cycles"), cpu * clock)
                    kept.take((name, rasp, seconds, "scalar"), cpu / scalar)
    return {(name, rasp, unit): (kept.kept[name, rasp, 22.0, unit] - kept.kept[name, rasp, 2.0, unit]) / (20 * RATE) for name in SCENES for rasp in rasps for unit in ("cycles", "scalar")}


def fixed(path):
    """What the file of an earlier commit's figures says: {scene: {part: instructions}}, and its cycles as part `cycles`."""
    rows = {}
    with open(path) as f:
        for line in f:
            if not line.startswith("#"):
                name, part, value = line.rstrip("\n").split("|")
                rows.setdefault(name, {})[part] = float(value)
    return rows


def since(name):
    """The commit whose figures stand beside a job's."""
    return "1968b6b" if name.startswith("coupled") else "18f57f9"


def tell(name, parts, functions, before, took):
    total, was = sum(parts.values()), sum(v for k, v in before.items() if k not in ("cycles", "scalar"))
    print(f"\n## {name}\n\n| part | instructions a sample | share | at {since(name)} |\n|---|---|---|---|")
    for part in sorted(parts, key=lambda part: -parts[part]):
        if parts[part] >= 0.5 or before.get(part, 0) >= 0.5:
            print(f"| {part} | {parts[part]:.0f} | {100 * parts[part] / total:.0f} % | {before.get(part, 0):.0f} |")
    print(f"| all | {total:.0f} | | {was:.0f} |")
    print(f"| cycles, core clock | {took['cycles']:.0f} | | {before['cycles']:.0f} |\n| over the scalar loop of 50 modes | {took['scalar']:.2f} | | {before['scalar']:.2f} |")
    most = sorted(functions.items(), key=lambda item: -item[1])[:12]
    print(f"\nFunctions: {', '.join(f'`{function}` {n:.0f}' for function, n in most)}.")


def silence(rasp):
    """What modes without gain, and a sound whose motion is over, still cost."""
    given, scrape = JOBS["object at rest, 50 modes, given force"][0], JOBS["scrape, profile, draft"][0]
    tails = [(f"the tail of a profile's draft, {a} to {a + 2} s after the motion", [(scrape.replace("tail: 0", f"tail: {a + b} s"), 2.0) for b in (0, 2)]) for a in (2, 28)]
    corner = given.replace("10 cm, 0 cm", "0 cm, 0 cm")
    rows = [("given force, 50 modes that move", [(given, SHORT), (given, LONG)]), ("the same in the corner, where none moves", [(corner, SHORT), (corner, LONG)])]
    print("\n## Silent modes and finished tails\n\n| job | instructions a sample | of these the modes' recursion |\n|---|---|---|")
    for what, pair in rows + tails:
        short, long = (counted(rasp, text, seconds) for text, seconds in pair)
        each = {key: (n - short.get(key, 0)) / (2 * RATE) for key, n in long.items()}
        print(f"| {what} | {sum(each.values()):.0f} | {sum(n for key, n in each.items() if re.search(r':ring(_steady|_gliding)?( |$)', key)):.0f} |")


if __name__ == "__main__":
    for seconds in (SHORT, LONG, 22.0):
        write_npy(f"force_{seconds:g}.npy", noise(int(seconds * RATE)))
    write_npy("map.npy", array.array("d", (1e-6 * z for z in noise(200 * 1000, 99))), 200)
    rasp = os.environ.get("RASP", BUILD + "/rasp")
    took = times([rasp])
    before = {} if "RAW" in os.environ else fixed(sys.argv[1])
    for name in SCENES:
        parts, functions = profile(rasp, name)
        one = {unit: took[name, rasp, unit] for unit in ("cycles", "scalar")}
        if "RAW" in os.environ:
            for part, n in (parts | one).items():
                print(f"{name}|{part}|{n:.2f}")
        else:
            tell(name, parts, functions, before[name], one)
    if "RAW" not in os.environ and not ONLY:
        silence(rasp)

"""Signals at random moments (tests/faults/signals.sh). SIGNALS_ROUNDS: how many for each command and signal (1), SIGNALS_SEED: of the moments, SIGNALS_ONLY: names of commands, or unread.

Half a second is asked of the quickest of TRIES, for a machine that runs other tests meanwhile may not run us for longer than that; no try may take LONGEST."""
import fcntl, glob, os, random, shutil, signal, struct, subprocess, sys, time

ROOT, ROUNDS, ONLY = os.environ["ROOT"], int(os.environ.get("SIGNALS_ROUNDS", 1)), os.environ.get("SIGNALS_ONLY", "").split()
SEED = int(os.environ.get("SIGNALS_SEED", random.randrange(10**6)))
WITHIN, LONGEST, TRIES, LATEST = 0.5, 5.0, 5, 0.7  # s; s; -; s: the latest moment
HERE = os.getcwd()
IN = HERE + "/in"

SCENES = {
    # as found: seconds went by while a ball in the plane was opened, and within a block of a round tip
    "ball": """surface: {roughness: {exponent: -4.1, rms: 7.8 um, longest: 0.17 mm, shortest: 11.6 um}, along: plane}
ball: {radius: 3.74 mm, material: ceramic, mass: 0.36 mg}
motion: {path: scribble, size: [17 mm, 17 mm], rate: 5.7 Hz, duration: 0.078 s}
contact: {model: roll, roll: {stiffness: 1.07e7}, limiter: {alpha_min: 1.3 cm, alpha_max: 12 cm}}
output: {sample_rate: 16000, quantity: force}""",
    "tip": """surface: {roughness: {rms: 2 um, longest: 2 mm, shortest: 11 um}, along: plane}
scraper: {mass: 10 g, radius: 0.7 mm}
motion: {path: line, to: [10 m, 1 m], speed: 10 m/s}
output: {quantity: force}""",
    "plate": """surface: {roughness: {}, material: steel, object: {shape: plate, length: 30 cm, width: 20 cm, thickness: 3 mm}}
scraper: {mass: 10 g}
motion: {path: back_and_forth, from: [5 cm, 5 cm], to: [20 cm, 12 cm], rate: 3 Hz, duration: 40 s}
output: {diagnostics: {rate: 10 kHz}, stems: [force, surface]}""",
}
DESIGN = """rasp-design: 1
base: BASE.yaml
seed: 1
factors: {motion.rate: [1 Hz, 2 Hz, 3 Hz, 4 Hz, 5 Hz, 6 Hz]}
level: {common: {peak: -3 dB}}
trials: {task: choose, answers: [x, y]}
"""
PLATE = ["out.wav", "out.csv", "out.force.wav", "out.surface.wav", "out.scene.yaml", "out.json"]


def run(*words, **more):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more)


def prepare():
    os.makedirs(IN + "/sounds")
    for name, text in SCENES.items():
        open(f"{IN}/{name}.yaml", "w").write("rasp: 1\n" + text + "\n")
    open(f"{IN}/short.yaml", "w").write("rasp: 1\n" + SCENES["plate"].replace("40 s", "12 s"))
    for name, base in (("design", "plate"), ("balls", "ball"), ("shorts", "short")):
        open(f"{IN}/{name}.yaml", "w").write(DESIGN.replace("BASE", base))
    os.mkfifo(f"{IN}/fifo")
    run("rasp", "render", "-q", "plate.yaml", "-o", "sound.wav", cwd=IN)
    run("rasp", "render", "-q", "plate.yaml", "-o", "other.wav", "--set", "seed=2", cwd=IN)
    for i in range(8):
        os.link(f"{IN}/sound.wav", f"{IN}/sounds/{i}.wav")
    with open(f"{IN}/answers.csv", "w") as f:
        f.write("participant,condition,played,chosen\n")
        f.writelines(f"{p},{c},{k},{'xy'[p % 3 == 0]}\n" for p in range(60) for c in "ab" for k in "xy")
    for shard in "12":
        run("rasp", "batch", "-q", "shorts.yaml", "-o", "shards", "--shard", f"{shard}/2", cwd=IN)
    shutil.copytree(f"{IN}/shards", f"{IN}/ready")
    run("rasp", "batch", "-q", "shorts.yaml", "-o", "ready", cwd=IN)
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': (4000, 4000), }}".ljust(117) + "\n"
    with open(f"{IN}/map.npy", "wb") as f:
        f.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        f.truncate(10 + len(header) + 8 * 4000 * 4000)


# name: words; files that are all there or none of them
COMMANDS = {
    "render, opening": (["render", "../in/ball.yaml", "-o", "out.wav"], ["out.wav", "out.scene.yaml", "out.json"]),
    "render, a block": (["render", "../in/tip.yaml", "-o", "out.wav"], ["out.wav", "out.scene.yaml", "out.json"]),
    "render": (["render", "../in/plate.yaml", "-o", "out.wav"], PLATE),
    "render, a promise": (["render", "../in/tip.yaml", "-o", "out.wav", "--set", "accuracy.error=-80 dB"], ["out.wav", "out.scene.yaml", "out.json"]),
    "render, verified": (["render", "../in/plate.yaml", "-o", "out.wav", "--set", "motion.duration=2 s", "--verify"], PLATE),
    "render, a pipe": (["render", "../in/fifo", "-o", "out.wav"], []),
    "plan as JSON": (["plan", "--diagnostics=json", "--json", "../in/tip.yaml", "--set", "accuracy.error=-80 dB"], []),
    "plan, a promise": (["plan", "../in/tip.yaml", "--set", "accuracy.error=-80 dB"], []),
    "check": (["check", "../in/tip.yaml", "--set", "accuracy.error=-80 dB"], []),
    "check, a pipe": (["check", "../in/fifo"], []),
    "explain, a pipe": (["explain", "../in/fifo"], []),
    "accuracy": (["accuracy", "../in/plate.yaml", "--csv", "out.csv", "--plot", "out.png"], ["out.csv", "out.png"]),
    "batch": (["batch", "../in/design.yaml", "-o", "set", "-j", "3"], None),
    "batch, one at a time": (["batch", "../in/design.yaml", "-o", "set", "-j", "1"], None),
    "batch, opening": (["batch", "../in/balls.yaml", "-o", "set", "-j", "2"], None),
    "batch, joining shards": (["batch", "../in/shorts.yaml", "-o", "set", "--no-render"], None),
    "export": (["export", "../in/shorts.yaml", "../in/ready", "--for", "page", "--participants", "10000", "-o", "data"], ["data/" + f for f in ("SHA256SUMS", "index.html", "lists/p00001.js", "lists/p10000.js", "stimuli/6Hz.wav")]),
    "golden check": (["golden", "check", "../in/plate.yaml", "--kept", "kept", "-j", "2"], []),
    "golden update": (["golden", "update", "../in/plate.yaml", "--kept", "kept", "-j", "2"], None),
    "surface synth": (["surface", "synth", "--size", "3cmx2cm", "--pitch", "5um", ROOT + "/surfaces/sandpaper.yaml", "out.gsf"], ["out.gsf"]),
    "surface convert": (["surface", "convert", "--pitch", "5um", "../in/map.npy", "out.csv"], ["out.csv"]),
    "surface info": (["surface", "info", "--pitch", "5um", "../in/map.npy"], []),
    "modes object": (["modes", "object", ROOT + "/irs/basswood_plank.yaml", "--line", "0,3.7cm,40cm,3.7cm", "--places", "30000", "-o", "out.csv"], ["out.csv"]),
    "modes compute": (["modes", "compute", "--shape", "mug:diameter=8cm,height=9cm,wall=4mm", "--material", "ceramic", "-o", "out.csv"], ["out.csv"]),
    "modes extract": (["modes", "extract", "../in/sound.wav", "--impulse", "-o", "out.csv", "--plot", "out.png", "--residual", "rest.wav"], ["out.csv", "out.png", "rest.wav"]),
    "modes list, a pipe": (["modes", "list", "../in/fifo"], []),
    "analyse": (["analyse", "../in/sound.csv", "--plot", "out.png", "-o", "out.yaml"], ["out.png", "out.yaml"]),
    "compare": (["compare", "../in/sound.csv", "../in/other.csv"], []),
    "judge": (["judge", "choices", "../in/answers.csv", "--reference", "a", "--draws", "10000000", "-o", "out.csv"], ["out.csv"]),
    "plot": (["plot", "../in/sound.wav", "-o", "out.png"], ["out.png"]),
    "plot, a gallery": (["plot", "--gallery", "../in/sounds", "-o", "page.html"], None),
}
WITHOUT = [] if shutil.which("gnuplot") else ["plot"]


def blocked(pid):
    """Has it got so far that it waits for signals?"""
    try:
        text = open(f"/proc/{pid}/status").read()
    except OSError:
        return True
    mask = int(text.split("SigBlk:")[1].split()[0], 16)
    return mask & 1 << signal.SIGTERM - 1 or "\nState:\tZ" in text


def alive(group):
    """The processes of a group that are more than a name."""
    left = []
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            name, rest = open(path).read().rsplit(")", 1)
        except OSError:
            continue
        if int(rest.split()[2]) == group and rest.split()[0] not in "ZX":
            left.append(name.split("(", 1)[1])
    return left


def torn(path):
    """A WAV that is not as long as its header says."""
    with open(path, "rb") as f:
        head = f.read(8)
    return len(head) < 8 or struct.unpack("<I", head[4:])[0] + 8 != os.path.getsize(path)


def one(words, together, number, moment):
    """What is wrong, the time it took, and whether it had not ended before."""
    shutil.rmtree(HERE + "/try", ignore_errors=True)
    os.makedirs(HERE + "/try/scratch")
    os.chdir(HERE + "/try")
    os.mkdir("kept")
    if "--no-render" in words:
        shutil.copytree(IN + "/shards", "set")
    p = subprocess.Popen(["rasp", *words], env=dict(os.environ, TMPDIR=HERE + "/try/scratch"), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=open("../said", "w"),
                         start_new_session=True)
    begun = time.monotonic()
    while not blocked(p.pid) and time.monotonic() < begun + 1:
        time.sleep(0.001)
    time.sleep(moment)
    start = time.monotonic()
    p.send_signal(number)
    try:
        code = p.wait(LONGEST)
    except subprocess.TimeoutExpired:
        os.killpg(p.pid, signal.SIGKILL)
        p.wait()
        return [f"had not ended after {LONGEST} s"], LONGEST, True
    took, said, wrong = time.monotonic() - start, open("../said").read(), []
    if code not in (0, 1, 75):
        wrong.append(f"exit code {code}: {said}")
    if code == 75 and said.count("interrupted") != 1:
        wrong.append(f"says {said!r}")
    wrong += [f"process left: {name}" for name in alive(p.pid)]
    files = [os.path.join(folder, name) for folder, _, names in os.walk(".") for name in names]
    wrong += [f"left behind: {f}" for f in files if "/.rasp-" in f]
    wrong += [f"left behind: scratch/{f}" for f in os.listdir("scratch")]
    wrong += [f"torn: {f}" for f in files if f.endswith(".wav") and torn(f)]
    there = [] if together is None else [f for f in files if not f.startswith("./scratch/")]
    if together is not None and there and sorted(f[2:] for f in there) != sorted(together):
        wrong.append(f"of {together}: {there}")
    return wrong, took, code == 75


def unread():
    """golden update, while nobody reads the pipe into which it lists what it writes: it must be ended there, too, and leave nothing."""
    os.makedirs(HERE + "/unread/scratch")
    os.chdir(HERE + "/unread")
    scenes = [f"{i:02}{'x' * 200}.yaml" for i in range(60)]
    for name in scenes:
        open(name, "w").write("rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 10 g}\nmotion: {path: line, to: [1 cm, 0], speed: 20 cm/s}\noutput: {quantity: force, tail: 0}\n")
    ends = os.pipe()
    fcntl.fcntl(ends[1], 1031, 4096)  # F_SETPIPE_SZ
    p = subprocess.Popen(["rasp", "golden", "update", "--kept", "kept", *scenes], stdout=ends[1], stderr=subprocess.DEVNULL, env=dict(os.environ, TMPDIR=HERE + "/unread/scratch"))
    begun, wrong = time.monotonic(), []
    while len(glob.glob("kept/*/.rasp-*")) < 30 and p.poll() is None and time.monotonic() < begun + 30:
        time.sleep(0.05)
    time.sleep(0.5)  # some more, and the pipe is full
    p.terminate()
    try:
        if p.wait(LONGEST) != 75:
            wrong.append(f"exit code {p.returncode}")
    except subprocess.TimeoutExpired:
        p.kill()
        p.wait()
        wrong.append(f"had not ended after {LONGEST} s")
    wrong += [f"left behind: {f}" for f in glob.glob("kept") + os.listdir("scratch")]
    for what in wrong:
        print(f"golden update, its output unread: {what}")
    return len(wrong)


def main():
    prepare()
    moments, bad, slowest = random.Random(SEED), 0, 0.0
    for name, (words, together) in COMMANDS.items():
        if (ONLY and name not in ONLY) or name in WITHOUT:
            continue
        for number in (signal.SIGINT, signal.SIGTERM):
            for _ in range(ROUNDS):
                least, met = LONGEST, False
                for k in range(TRIES):
                    moment = moments.uniform(0, LATEST / (k + 1))  # what has ended before is tried sooner
                    wrong, took, interrupted = one(words, together, number, moment)
                    for what in wrong:
                        bad += 1
                        print(f"{name}, {number.name} after {moment:.3f} s (seed {SEED}): {what}")
                    least, met = min(least, took) if interrupted else least, met or interrupted
                    if wrong or (met and least < WITHIN):
                        break
                if not wrong and not (met and least < WITHIN):
                    bad += 1
                    print(f"{name}, {number.name}: " + (f"took {least:.2f} s at least" if met else "had always ended before"))
                slowest = max(slowest, least)
                if os.environ.get("SIGNALS_SHOW"):
                    print(f"{name}, {number.name}: {least:.3f} s")
    if not ONLY or "unread" in ONLY:
        bad += unread()
    print(f"slowest: {slowest:.3f} s")
    return bad > 0


sys.exit(main())

"""Sets of stimuli: kills at random moments, renames that fail, shards copied together, runs at once, edits in random order.

Whatever befell a folder, one more run leaves what a fresh folder has: the same files, and but for timings.csv the same bytes, those of .rasp included. With no argument all is tried; else the
parts that are named. The random numbers are those of SETS_SEED, or are told at the end.
"""
import filecmp, json, os, random, shutil, signal, subprocess, sys, time

SEED = int(os.environ.get("SETS_SEED") or time.time_ns() % 1000000)
CHANCE = random.Random(SEED)
HERE = os.getcwd()
wrong = []

BASE = """rasp: 1
title: a tap
surface: {roughness: {rms: 5 um}, response: %s.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], duration: 0.05 s}
accuracy: draft
output: {tail: 0 s, sample_rate: 8 kHz, ramp: 1 ms}
"""
MODES = """# poles: shared
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
a,0,0,1,%d,60,1,0
"""
RULES = {"common": "{common: {peak: -3 dB}}", "each": "{each: {rms: -30 dB}}"}


def write(name, text):
    with open(name, "w") as f:
        f.write(text)


def design(to, rule="common", **more):
    """Six stimuli, or what the lines in `more` make of them."""
    keys = {"rasp-design": "1", "base": "base.yaml", "seed": "3", "level": RULES[rule],
            "factors": "{scraper.mass: [10 g, 20 g, 30 g], surface.response: [low.csv, high.csv]}"} | {k: v for k, v in more.items() if v}
    write(to, "".join(f"{key}: {value}\n" for key, value in keys.items()))


def start():
    write("base.yaml", BASE % "low")
    write("low.csv", MODES % 400)
    write("high.csv", MODES % 1000)


def rasp(*words, code=0, env=None):
    """Its standard output."""
    done = subprocess.run(["rasp", *words], capture_output=True, text=True, env=dict(os.environ, **(env or {})))
    if code is not None and done.returncode not in (code if isinstance(code, tuple) else (code,)):
        wrong.append(f"exit code {done.returncode} in place of {code}: {' '.join(words)}: {done.stderr.strip()}")
    return done.stdout


def batch(d, folder, *more, **how):
    return rasp("batch", d, "-o", folder, *more, **how)


def files(folder):
    return sorted(os.path.relpath(os.path.join(at, name), folder) for at, _, names in os.walk(folder) for name in names)


def same(folder, fresh, what):
    """Is it what the fresh one is?"""
    a, b = files(folder), files(fresh)
    if a != b:
        wrong.append(f"{what}: files {sorted(set(a) ^ set(b))}")
    differ = [f for f in a if f in b and f != "timings.csv" and not filecmp.cmp(f"{folder}/{f}", f"{fresh}/{f}", shallow=False)]
    if differ:
        wrong.append(f"{what}: other bytes in {differ[:5]}")


def rendered(output):
    """How many a report says were."""
    return int(output.split(": ")[1].split()[0])


def two_states(rule):
    """A and B differ in stimuli, in what these write and in their sounds; fresh folders of both."""
    design("a.yaml", rule, set="{output.stems: [force], output.diagnostics.rate: 1 kHz}")
    design("b.yaml", rule, seed="4", factors="{scraper.mass: [10 g, 20 g], surface.response: [low.csv, high.csv], motion.duration: [40 ms]}", name='"{scraper.mass}_{surface.response}"')
    for state in "ab":
        shutil.copy(f"{state}.yaml", "d.yaml")
        batch("d.yaml", f"fresh_{state}", "-q")


def part_kills(n=100):
    """Killed at random, the design changing in between."""
    longest = 0.22
    for rule in RULES:
        two_states(rule)
        for threads in "1", "2":
            left = n // 4
            while left > 0:
                for _ in range(CHANCE.randint(1, 5)):
                    shutil.copy(f"{CHANCE.choice('ab')}.yaml", "d.yaml")
                    p = subprocess.Popen(["rasp", "batch", "d.yaml", "-o", "set", "-q", "-j", threads], stderr=subprocess.DEVNULL)
                    time.sleep(CHANCE.uniform(0, longest))
                    p.send_signal(CHANCE.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGKILL, signal.SIGINT]))
                    p.wait()
                    left -= 1
                state = CHANCE.choice("ab")
                shutil.copy(f"{state}.yaml", "d.yaml")
                batch("d.yaml", "set", "-q", "--prune")
                same("set", f"fresh_{state}", f"killed, {rule}, -j {threads}")
        for folder in "set", "fresh_a", "fresh_b":
            shutil.rmtree(folder, ignore_errors=True)


def part_renames():
    """Each rename fails in turn, on the way from one state to the other; then to either."""
    for rule in RULES:
        two_states(rule)
        n, failed = 1, True
        while failed:
            shutil.copytree("fresh_b", "set", symlinks=True)
            shutil.copy("a.yaml", "d.yaml")
            done = subprocess.run(["rasp", "batch", "d.yaml", "-o", "set", "-q", "-j", "1"], capture_output=True, text=True,
                                  env=dict(os.environ, LD_PRELOAD=HERE + "/calls.so", CALLS_RENAME=str(n)))
            failed = done.returncode != 0
            if failed and done.returncode != 74:
                wrong.append(f"rename {n}, {rule}: exit code {done.returncode}: {done.stderr}")
            state = CHANCE.choice("ab")
            shutil.copy(f"{state}.yaml", "d.yaml")
            batch("d.yaml", "set", "-q", "--prune")
            same("set", f"fresh_{state}", f"rename {n}, {rule}, then {state}")
            shutil.rmtree("set")
            n += CHANCE.randint(1, 4)
        if n < 20:
            wrong.append(f"only {n} renames")
        for folder in "fresh_a", "fresh_b":
            shutil.rmtree(folder)


def copies():
    """Ways in which what was made elsewhere comes into one folder."""
    ways = {"cp -r": lambda a, b: subprocess.run(["cp", "-r", a + "/.", b], check=True)}
    if shutil.which("rsync"):
        ways["rsync"] = lambda a, b: subprocess.run(["rsync", "-a", a + "/", b + "/"], check=True)
    if shutil.which("zip") and shutil.which("unzip"):
        ways["zip"] = lambda a, b: (subprocess.run(["zip", "-q", "-r", "../x.zip", "."], cwd=a, check=True), subprocess.run(["unzip", "-q", "-o", "../x.zip"], cwd=b, check=True), os.unlink("x.zip"))
    return ways


def missing(n, folder="set"):
    text = rasp("batch", "d.yaml", "-o", folder, "--missing", str(n)).strip()
    return [int(x) for x in text.split(",")] if text else []


def other_build():
    """The program as another revision, which renders the same."""
    batch("d.yaml", "probe", "-q")
    program = json.load(open("probe/" + [f for f in files("probe") if f.endswith(".json") and f != "manifest.json"][0]))["program"]
    revision = program.split()[2].split("-")[0]
    binary = open(shutil.which("rasp"), "rb").read()
    os.mkdir("other")
    with open("other/rasp", "wb") as f:
        f.write(binary.replace(revision.encode(), bytes(reversed(revision.encode()))) + b"other")
    os.chmod("other/rasp", 0o755)
    shutil.rmtree("probe")


def part_shards():
    """In one folder and in several; what is missing is named, and not rendered unasked."""
    ways = copies()
    for rule in RULES:
        design("d.yaml", rule, replicates="2", set="{output.stems: [force]}")
        batch("d.yaml", "fresh", "-q")
        for n in 1, 3, 7:
            for i in CHANCE.sample(range(1, n + 1), n):
                batch("d.yaml", "set", "-q", "--shard", f"{i}/{n}")
            if missing(n):
                wrong.append(f"{n} shards, {rule}: {missing(n)} are missing")
            batch("d.yaml", "set", "-q", *(["--no-render"] if n > 1 else []))
            same("set", "fresh", f"{n} shards, {rule}")
            shutil.rmtree("set")
        for way, copy in ways.items():
            os.mkdir("set")
            left = list(range(1, 4))
            for i in CHANCE.sample(left, 3):
                batch("d.yaml", f"part{i}", "-q", "--shard", f"{i}/3")
                copy(f"part{i}", "set")
                left.remove(i)
                if missing(3) != left:
                    wrong.append(f"{way}, {rule}: {missing(3)} are missing in place of {left}")
                batch("d.yaml", "set", "-q", "--no-render", code=66 if left else 0)
            same("set", "fresh", f"{way}, {rule}")
            for folder in "set", "part1", "part2", "part3":
                shutil.rmtree(folder)
        shutil.rmtree("fresh")
    design("d.yaml")
    batch("d.yaml", "fresh", "-q")
    design("old.yaml", seed="4")
    other_build()
    for i in 1, 2, 3:
        if i == 2:
            os.rename("d.yaml", "kept.yaml")
            shutil.copy("old.yaml", "d.yaml")
        batch("d.yaml", "set", "-q", "--shard", f"{i}/3")
        if i == 2:
            os.rename("kept.yaml", "d.yaml")
    if missing(3) != [2]:
        wrong.append(f"of an older state: {missing(3)} are missing")
    batch("d.yaml", "set", "-q", "--no-render", code=66)
    subprocess.run(["other/rasp", "batch", "d.yaml", "-o", "set", "-q", "--shard", "3/3"], check=True)
    if missing(3) != [2, 3]:
        wrong.append(f"of another build: {missing(3)} are missing")
    if rendered(batch("d.yaml", "set")) != 4:
        wrong.append("of another state and another build: not four of six were rendered")
    same("set", "fresh", "of another state, of another build")
    for folder in "set", "fresh", "other":
        shutil.rmtree(folder)


def begin(*words, env=None):
    return subprocess.Popen(["rasp", "batch", "d.yaml", "-o", "set", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=dict(os.environ, **(env or {})))


def part_together():
    """Two runs at once: with locks the second is sent away; without, one more run is right."""
    design("d.yaml", replicates="20")
    batch("d.yaml", "fresh", "-q")
    for first, second in ([], []), (["--shard", "1/2"], []), ([], ["--shard", "1/2"]), (["--shard", "1/2"], ["--shard", "2/2"]):
        p = begin("-q", "-j", "1", *first)
        while not os.path.exists("set/.rasp/owner") or "process" not in open("set/.rasp/owner").read():
            time.sleep(0.001)
        time.sleep(0.02)
        p.send_signal(signal.SIGSTOP)
        q, begun = begin("-q", *second), time.monotonic()
        said, took = q.communicate()[1], time.monotonic() - begun
        alike = bool(first and second)
        if q.returncode != (0 if alike else 75) or (not alike and f"process {p.pid}" not in said) or took > 10:
            wrong.append(f"{first} and {second} at once: exit code {q.returncode} after {took:.1f} s: {said}")
        p.send_signal(signal.SIGCONT)
        if p.wait() != 0:
            wrong.append(f"{first} beside {second}: exit code {p.returncode}: {p.stderr.read()}")
        batch("d.yaml", "set", "-q")
        same("set", "fresh", f"{first} and {second} at once")
        shutil.rmtree("set")
    shutil.rmtree("fresh")
    two_states("common")
    env = {"LD_PRELOAD": HERE + "/calls.so", "CALLS_NO_LOCKS": "1"}
    for _ in range(8):
        runs = []
        for _ in range(2):
            shutil.copy(f"{CHANCE.choice('ab')}.yaml", "d.yaml")
            runs.append(begin("-q", "-j", "2", env=env))
            time.sleep(CHANCE.uniform(0.02, 0.15))
        for p in runs:
            p.wait()
        state = CHANCE.choice("ab")
        shutil.copy(f"{state}.yaml", "d.yaml")
        batch("d.yaml", "set", "-q", "--prune", env=env)
        same("set", f"fresh_{state}", "two states without locks")
    for folder in "set", "fresh_a", "fresh_b":
        shutil.rmtree(folder)


class Edits:
    """A design under edits; each says how many of its stimuli are made again, of n before and n now."""

    def __init__(self, rule):
        self.rule, self.loads, self.rate, self.more = rule, [10, 20, 30], 400, {}
        self.level, self.remarks, self.tail = 3, 0, 0
        self.put()

    def put(self):
        masses = "[" + ", ".join(f"{x} g" for x in self.loads) + "]"
        design("d.yaml", self.rule, factors=f"{{scraper.mass: {masses}, surface.response: [low.csv, high.csv]}}", **self.more)
        text = open("d.yaml").read().replace("-3 dB", f"-{self.level} dB").replace("-30 dB", f"-{self.level * 10} dB")
        write("d.yaml", text + "# a remark\n" * self.remarks)
        write("base.yaml", (BASE % "low").replace("ramp: 1 ms", f"ramp: {1 + self.tail / 10:.1f} ms") + "# a remark\n" * self.remarks)
        write("low.csv", MODES % self.rate)

    def n(self):
        return 2 * len(self.loads)

    def title(self):
        self.more["title"] = f"title {CHANCE.random()}"
        return 0

    def text(self):
        self.more["text"] = '"' + f"a {CHANCE.random()} " + '{scraper.mass}"'
        return 0

    def order(self):
        self.more["order"] = f"{{seed: {CHANCE.randrange(10 ** 6)}}}"
        return 0

    def remark(self):
        self.remarks += 1
        return 0

    def value(self):
        """A level becomes another: its cells; a common gain that moves, all."""
        self.loads[1] = 20 + self.loads[1] % 9 + 0.5
        return 2

    def label(self):
        self.more["name"] = '"' + f"x{CHANCE.randrange(10 ** 6)}_" + '{scraper.mass}_{surface.response}"'
        return self.n()

    def base(self):
        self.tail += 1
        return self.n()

    def table(self):
        """Of one of the two levels."""
        self.rate = 400 + self.rate % 97 + 1
        return self.n() // 2

    def number(self):
        self.level = 3 + self.level % 7
        return self.n()

    def seed(self):
        self.more["seed"] = str(CHANCE.randrange(10 ** 6))
        return self.n()

    def stimuli(self):
        self.loads.append(max(self.loads) + 1)
        return 2

    def length(self):
        self.more["length"] = f"{50 + CHANCE.randrange(50)} ms"
        return self.n()

    def stem(self):
        self.more["set"] = None if self.more.get("set") else "{output.stems: [force]}"
        return self.n()


def part_edits():
    """In random order, each against a fresh folder; what is made again is what the edit is about."""
    names = ["title", "text", "order", "remark", "value", "label", "base", "table", "number", "seed", "stimuli", "length", "stem"]
    for rule in RULES:
        e = Edits(rule)
        batch("d.yaml", "set", "-q")
        full_scale = None
        for name in CHANCE.sample(names, len(names)):
            before = full_scale
            want = getattr(e, name)()
            e.put()
            shutil.rmtree("fresh", ignore_errors=True)
            full_scale = json.loads(rasp("batch", "d.yaml", "-o", "fresh", "--json"))["full_scale"]
            dry = json.loads(rasp("batch", "d.yaml", "-o", "set", "-n", "--json"))["list"]
            got = json.loads(rasp("batch", "d.yaml", "-o", "set", "--prune", "--json"))["rendered"]
            moved = rule == "common" and before is not None and full_scale != before
            if got != (e.n() if moved and want else want) and not (rule == "common" and before is None):
                wrong.append(f"{name}, {rule}: {got} were rendered in place of {want}")
            if rule == "each" and sum(r["state"] != "there" for r in dry) != want:
                wrong.append(f"{name}, {rule}: a dry run says {[r['state'] for r in dry]}")
            if name == "seed" and {r["state"] for r in dry} != {"key"} or name == "label" and {r["state"] for r in dry} != {"new"}:
                wrong.append(f"{name}, {rule}: a dry run says {[r['state'] for r in dry]}")
            same("set", "fresh", f"{name}, {rule}")
        for folder in "set", "fresh":
            shutil.rmtree(folder)
        start()


def peak_memory(*words):
    """Of one run, in kB."""
    p = subprocess.Popen(["rasp", *words], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(p.pid, 0)
    if status:
        wrong.append(f"{' '.join(words)}: {status}")
    return used.ru_maxrss


def part_many():
    """Many stimuli: memory stays flat, and a run with nothing to do is quick; a damaged one is found all the same."""
    common = {"rule": "each", "set": "{motion.duration: 11 ms}", "factors": "{scraper.mass: [10 g]}"}
    design("few.yaml", replicates="20", **common)
    design("d.yaml", replicates="600", **common)
    peak_memory("batch", "few.yaml", "-o", "few", "-q")
    peak_memory("batch", "d.yaml", "-o", "set", "-q")
    few, many, begun = peak_memory("batch", "few.yaml", "-o", "few", "-q"), 0, time.monotonic()
    many = peak_memory("batch", "d.yaml", "-o", "set", "-q")
    took = time.monotonic() - begun
    if many > few + 4000 or took > 4:
        wrong.append(f"600 stimuli: {many} kB, 20: {few} kB; with nothing to do {took:.1f} s")
    victim = f"set/10g_r{CHANCE.randint(100, 600)}.wav"
    with open(victim, "r+b") as f:
        f.seek(100)
        byte = f.read(1)
        f.seek(100)
        f.write(bytes([byte[0] ^ 1]))
    if rendered(batch("d.yaml", "set")) != 1:
        wrong.append("one bit of one file: not one was rendered")
    os.unlink("set/manifest.csv")
    with open(victim, "r+b") as f:
        f.seek(100)
        f.write(bytes([byte[0] ^ 1]))
    times = os.stat(victim.replace(".wav", ".json"))
    os.utime(victim, ns=(times.st_mtime_ns, times.st_mtime_ns))
    if rendered(batch("d.yaml", "set")) != 1:
        wrong.append("one bit of one file after a run that did not end: not one was rendered")
    for folder in "set", "few":
        shutil.rmtree(folder)


PARTS = {name[5:]: part for name, part in globals().items() if name.startswith("part_")}
for name in sys.argv[1:] or PARTS:
    os.mkdir(name)
    os.chdir(name)
    start()
    begun = time.monotonic()
    PARTS[name]()
    print(f"{name}: {time.monotonic() - begun:.1f} s")
    os.chdir("..")
print(*wrong, sep="\n")
if wrong:
    print(f"again: SETS_SEED={SEED}")
sys.exit(1 if wrong else 0)

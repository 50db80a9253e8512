"""What must hold of a scene, whatever it says: each broken promise is a finding."""
import hashlib
import json
import math
import os
import re
import resource
import signal
import struct
import subprocess
import time
from pathlib import Path

CODES = {0, 65, 66, 70, 71, 73, 74}  # of rasp(1), EXIT STATUS, those that a scene can lead to
PROGRAM_FAULTS = re.compile(
    r"runtime error:|Sanitizer|[Ii]nternal error|[Aa]ssertion|stack smashing|corrupted|double free")
# What only the sound itself shows, and rasp check cannot know (rasp-check: "such as clipping").
ONLY_IN_SOUND = re.compile(
    r"beyond the range of|too large for 32-bit|re full scale|silen|not finite|energy|too quiet|loudness|LUFS|out of memory|not to be trusted beyond")
# A refusal has a help of its own, or its text says what to do; of a damaged file it is enough to say what is damaged.
DO = ("give move take write set lower raise remove leave add must needs? use choose save mend restore shorten let make "
      "check restrict ask widen listen").split()
SAY = ["at most", "at least", "did you mean", "is missing", "No such", "exclude", "applies only", "what is read here",
       "allowed", "can be", "more than 64 deep"]
DAMAGE = ["Is a directory", "Too many levels", "is not a", "that is not", "not finite", "neither", "damaged",
          "cut short", "truncated", "there is no", "are called", "no column", "are too few", "is no", "is none",
          "file ends", "should (follow|stand)", "where the header", "blank line"]
CURE = re.compile(rf"\b({'|'.join(DO + SAY + DAMAGE)})\b", re.I)
# What is wrong with a file as a whole has no line in it.
WHOLE_FILE = re.compile(r"encoded as UTF|is empty|nothing in it|larger than")


class Ended:
    """A command that was run: how it ended, what it printed, its CPU time."""

    def __init__(self, args, cwd, limit, memory, grace, env=None):
        self.args, self.slow, self.deaf, self.grace = args, False, False, grace
        def limits():
            if memory:
                resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        p = subprocess.Popen(args, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            preexec_fn=limits, env=env)
        started = time.monotonic()
        while True:
            try:
                out, err = p.communicate(timeout=0.5)
                break
            except subprocess.TimeoutExpired:
                if cpu_of(p.pid) > limit or time.monotonic() - started > 10 * limit:
                    out, err = self.stop(p)
                    break
        self.code = p.returncode
        self.out, self.err = out.decode(errors="replace"), err.decode(errors="replace")

    def stop(self, p):
        """Over the limit: it has to end within `grace` seconds of its own time."""
        self.slow, before, asked = True, cpu_of(p.pid, False), time.monotonic()
        p.send_signal(signal.SIGTERM)
        while True:
            try:
                return p.communicate(timeout=0.05)
            except subprocess.TimeoutExpired:
                if cpu_of(p.pid, False) - before > self.grace or time.monotonic() - asked > 30:
                    self.deaf = True
                    p.kill()
                    return p.communicate()


def cpu_of(pid, kernel=True):
    """CPU time that a process has taken, s; without the kernel's, which goes on long after a command's own end where it
    gives up gigabytes."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + kernel * int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError):
        return 0.0


def state_of(folder):
    """Every name below a folder, and what is in it."""
    state = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            state[name] = "link"
        elif path.is_dir():
            state[name] = "folder"
        else:
            state[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return state


class Judge:
    """Runs a scene's commands in its folder and collects what does not hold."""

    def __init__(self, scene, programs, limit, memory):
        self.scene, self.folder, self.programs, self.limit, self.memory = scene, scene.folder, programs, limit, memory
        self.findings, self.slow, self.refusal = [], [], None
        self.accepted = False

    def finding(self, text):
        """One that an earlier command had is told once."""
        if text.partition(": ")[2] not in {f.partition(": ")[2] for f in self.findings}:
            self.findings.append(text)

    def run(self, *args, program="rasp"):
        """One command; what holds of all of them is looked at here."""
        sanitized = program == "sanitized"
        grace = 0.5 * (4 if sanitized else 1) * (2 if args[0] == "batch" else 1)  # of two threads each has its time
        end = Ended([self.programs[program], *args], self.folder, self.limit * (4 if sanitized else 1),
            0 if sanitized else self.memory, grace,
                    dict(os.environ, LC_ALL="C", ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=1"))
        name = f"rasp {args[0]}" + (" (sanitized)" if sanitized else "")
        if end.deaf:
            self.finding(f"{name}: does not end on SIGTERM within {grace:g} s of its own")
        elif end.slow:
            self.slow.append(name)
            if end.code not in (75, *CODES):
                self.finding(f"{name}: exit code {end.code} after SIGTERM")
        elif end.code < 0:
            self.finding(f"{name}: killed by {signal.Signals(-end.code).name}: {end.err[-300:]!r}")
        elif end.code not in CODES:
            self.finding(f"{name}: exit code {end.code}: {end.err[-300:]!r}")
        if m := PROGRAM_FAULTS.search(end.err):
            self.finding(f"{name}: {end.err[max(0, m.start() - 100):m.end() + 600]!r}")
        if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", end.err):
            self.finding(f"{name}: a control character in what it says")
        return end

    # ------------------------------------------------------------------ what it says

    def told(self, end, name):
        """Errors and warnings, each one line of JSON."""
        rows = []
        for line in end.err.splitlines():
            try:
                row = strict(line)
                rows.append(row)
            except ValueError:
                if not end.slow and end.code >= 0 and not PROGRAM_FAULTS.search(end.err):
                    self.finding(f"{name}: --diagnostics=json, and says {line[:200]!r}")
                break
        return rows

    def refused(self, end, rows, name):
        """A refusal says where it is and what to do."""
        errors = [r for r in rows if r["severity"] == "error"]
        if not errors and not end.slow:
            self.finding(f"{name}: exit code {end.code} without an error")
        for r in errors:
            placed = r["line"] and r["column"] and r["file"] or any(p.get("line") for p in r.get("named_at") or [])
            if not placed and not r.get("option") and end.code in (65, 66) and not WHOLE_FILE.search(r["message"]):
                self.finding(f"{name}: no line: {r['message']}")
            if not r["help"] and not CURE.search(r["message"]):
                self.finding(f"{name}: no cure: {r['message']}")
        return errors

    # ------------------------------------------------------------------ the commands, in turn

    def judge(self):
        before = state_of(self.folder)
        options = self.scene.options
        check = self.run("check", "--diagnostics=json", *options, "scene.yaml")
        rows = self.told(check, "check")
        if check.slow:
            return
        if check.code:
            errors = self.refused(check, rows, "check")
            self.refusal = (check.code, errors[0]["message"] if errors else "")
        self.planted_told(check, rows)
        plan = self.plan(check, options)
        if plan and not plan.slow and not self.dear(plan):
            self.render(check, options)
        now = state_of(self.folder)
        if {n: s for n, s in now.items() if not n.startswith("out")} != before:
            changed = sorted(set(now.items()) ^ set(before.items()))
            self.finding(f"its inputs changed, or something was left beside them: {changed[:5]}")

    def planted_told(self, check, rows):
        """A fault that was planted at a known line is told there."""
        if not self.scene.expected:
            return
        file, line = self.scene.expected
        places = [(r["file"], r["line"]) for r in rows if r["severity"] == "error"]
        whole = any("belongs to the whole scene" in r["message"] for r in rows)  # a map that is not looked into
        if check.code != 65 or not whole and not any((Path(f or "").name, n) == (file, line) for f, n in places):
            self.finding(f"check: {self.scene.planted}, planted at {file}:{line}: exit code {check.code}, "
                         f"told at {places[:4]}")

    def plan(self, check, options):
        plan = self.run("plan", "--json", "--diagnostics=json", *options, "scene.yaml")
        rows = self.told(plan, "plan")
        if plan.slow or plan.code < 0:
            return plan
        both = {65, 66} == {plan.code, check.code} and self.scene.planted  # of two faults each names the one that it comes to first
        sound = any(ONLY_IN_SOUND.search(r["message"]) for r in rows)  # of a pilot run
        if plan.code != check.code and 71 not in (plan.code, check.code) and not sound and not both:
            self.finding(f"check: exit code {check.code}, plan: {plan.code}: {(plan.err or check.err)[:300]}")
        if plan.code:
            self.refused(plan, rows, "plan")
            return plan
        try:
            contacts = strict(plan.out)[0]["contacts"]
        except (ValueError, KeyError, IndexError) as wrong:
            self.finding(f"plan: its JSON is none: {wrong}")
            return plan
        if len(contacts) != len(self.scene.contacts) and not self.scene.planted:
            self.finding(f"plan: {len(contacts)} contacts of {len(self.scene.contacts)}")
        plan.cycles = sum(c["cycles_per_sample"] for c in contacts)
        return plan

    def dear(self, plan):
        """Is it foretold to take much longer than the limit?"""
        rate = 48000 if "output.sample_rate" not in self.scene.top.given else 768000
        seconds = getattr(plan, "cycles", 0) * rate * self.scene.seconds() / 3e9
        if seconds > 100 * self.limit:
            self.slow.append("rasp render, not tried: it is planned to take too long")
        return seconds > 100 * self.limit

    def render(self, check, options):
        (self.folder / "out").mkdir()
        end = self.run("render", "--traps", "--json", "--diagnostics=json", *options, "-o", "out/", "scene.yaml")
        rows = self.told(end, "render")
        made = state_of(self.folder / "out")
        if end.slow or end.code < 0:
            if made and end.code != 0:
                self.finding(f"render: stopped, and left {sorted(made)[:5]}")
            return
        if end.code:
            errors = self.refused(end, rows, "render")
            if made:
                self.finding(f"render: exit code {end.code}, and left {sorted(made)[:5]}")
            sound = end.code in (70, 71) or any(ONLY_IN_SOUND.search(e["message"]) for e in errors)
            if check.code == 0 and not sound:
                why = errors[0]["message"] if errors else end.err[-300:]
                self.finding(f"check accepts what render refuses with {end.code}: {why}")
            if check.code == 0:
                self.refusal = (end.code, errors[0]["message"] if errors else "")
            return
        if check.code:
            self.finding(f"check refuses with {check.code} what render renders: {self.refusal}")
        self.accepted = True
        self.outputs(end, made, [r["message"] for r in rows])
        self.again(made, options)

    # ------------------------------------------------------------------ what was made

    def outputs(self, end, made, warnings):
        out = self.folder / "out"
        try:
            summary = strict(end.out)
            kept = strict((out / "scene.json").read_text())
        except (ValueError, OSError) as wrong:
            self.finding(f"render: its summary is none: {wrong}")
            return
        if kept.get("files") != summary.get("files"):
            self.finding("render: the summary printed is not the one written")
        names = {f["name"] for f in summary["files"]} | {"scene.json"}
        if names != set(made):
            self.finding(f"render: the summary names {sorted(names)}, and there are {sorted(made)}")
        for f in summary["files"]:
            if f.get("sha256") and f["sha256"] != made.get(f["name"]):
                self.finding(f"render: another SHA-256 than the summary's: {f['name']}")
        said = " ".join(warnings + summary["warnings"])
        told = {f["name"]: f for f in summary["files"]}
        for name in sorted(made):
            if name.endswith(".wav"):
                self.sound(told.get(name, {}), name, said)
            elif name.endswith(".csv") and re.search(r"(^|,)[-+]?(nan|inf)", (out / name).read_text(), re.M | re.I):
                self.finding(f"render: {name} is not finite")
            elif name.endswith(".npy"):
                self.array(name)

    def sound(self, told, name, said):
        """Samples are finite; nothing but zeros, and more than full scale, are told, in words and in the summary. The
        stem force holds newtons, which have no full scale."""
        kind, samples = read_wav((self.folder / "out" / name).read_bytes())
        if not all(map(math.isfinite, samples)):
            self.finding(f"render: {name} is not finite")
            return
        silent, newtons = not any(samples), told.get("stem") == "force"
        beyond = sum(abs(x) > 1 for x in samples) if kind.startswith("float") else 0
        if silent and not re.search(r"silent", said):
            self.finding(f"render: {name} ({kind}): all samples are 0, without a warning")
        elif beyond and not newtons and "full scale" not in said:
            level = 20 * math.log10(max(map(abs, samples)))
            self.finding(f"render: {name} ({kind}): {level:.1f} dB over full scale, without a warning")
        facts = told.get("silent"), told.get("samples_beyond_full_scale")
        found = silent, None if newtons else beyond
        if facts != found:
            self.finding(f"render: {name} ({kind}): silent, beyond full scale: {found}, by the summary {facts}")

    def array(self, name):
        data = (self.folder / "out" / name).read_bytes()
        size = struct.unpack("<H", data[8:10])[0]
        if data[:6] != b"\x93NUMPY" or not all(map(math.isfinite,
            struct.unpack(f"<{(len(data) - 10 - size) // 8}d", data[10 + size:]))):
            self.finding(f"render: {name} is no NPY, or not finite")

    def again(self, made, options):
        """The same bytes from the same scene, from the effective scene, from another build of the program, and of a set
        by one thread and by two."""
        way = self.scene.rng.choice(["again", "again", "effective", "effective", "batch"])
        if "sanitized" in self.programs:
            way = "sanitized"
        if way == "batch":
            self.batch()
            return
        folder = self.folder / "out again"
        folder.mkdir()
        if way == "effective":
            end = self.run("render", "-q", "out/scene.scene.yaml", "-o", "out again/scene.wav")
        else:
            end = self.run("render", "-q", *options, "scene.yaml", "-o", "out again/",
                program="sanitized" if way == "sanitized" else "rasp")
        if end.slow:
            return
        other = state_of(folder)
        differ = sorted(n for n in made.keys() | other.keys() if made.get(n) != other.get(n)
            and not n.endswith("scene.json"))
        if end.code or differ:
            self.finding(f"render ({way}): exit code {end.code}, other bytes: {differ}: {end.err[-300:]}")


    def batch(self):
        """A set of two other seeds: the same files, but those that hold times, and the same exit code."""
        (self.folder / "out.design.yaml").write_text("rasp-design: 1\nbase: scene.yaml\nreplicates: 2\n")
        made, codes = [], []
        for jobs in ("1", "2"):
            end = self.run("batch", "-q", "-j", jobs, "out.design.yaml", "-o", f"out of {jobs}")
            if end.slow:
                return
            codes.append(end.code)
            made.append({n: s for n, s in state_of(self.folder / f"out of {jobs}").items() if not n.startswith(".rasp")
                and not n.endswith(".json") and n != "timings.csv"})
        if codes[0] != codes[1] or made[0] != made[1]:
            differ = sorted(set(made[0].items()) ^ set(made[1].items()))
            self.finding(f"batch: exit codes {codes}, other bytes by two threads: {differ[:5]}")


def strict(text):
    """JSON without NaN and Infinity."""
    def refuse(name):
        raise ValueError(f"{name} in JSON")
    return json.loads(text, parse_constant=refuse)


def read_wav(data):
    """Kind and samples of a WAV: of integers as they are, all channels after each other as they lie."""
    at, kind, samples = 12, "", ()
    while at + 8 <= len(data):
        name, size = data[at:at + 4], struct.unpack("<I", data[at + 4:at + 8])[0]
        body = data[at + 8:at + 8 + size]
        if name == b"fmt ":
            tag, bits = struct.unpack("<H", body[:2])[0], struct.unpack("<H", body[14:16])[0]
            tag = struct.unpack("<H", body[24:26])[0] if tag == 0xFFFE else tag
            kind = f"{'float' if tag == 3 else 'pcm'}{bits}"
        elif name == b"data":
            width = bits // 8
            if kind == "pcm24":
                samples = [int.from_bytes(body[i:i + 3], "little", signed=True) for i in range(0, len(body) - 2, 3)]
            else:
                samples = struct.unpack(f"<{len(body) // width}{dict(pcm16='h', float32='f', float64='d')[kind]}",
                    body[:len(body) // width * width])
        at += 8 + size + size % 2
    return kind, samples

"""What rasp modes extract made of recordings whose modes are known (evidence/extract_judge.c), as rows of a table.

  python3 extract_score.py FOLDER [SET...]         one row a set; with --split FOLDER, one a level of noise too
  python3 extract_score.py --list FOLDER [SET...]  each mode that was missed, each component that is false or a blend

Of recording NAME the folder holds NAME.truth, NAME.json (the report, --json), NAME.code (exit code) and NAME.cpu (s).

A component is a true mode's if it lies within a gate of it, in angular frequency and in decay alike: 10 bounds, or,
where that is more, 0.2 of the decay, but no more than a quarter of the way to the nearest other true mode: an estimate
of the right mode that is badly off is found, and its error tells so; one half way between two is neither's. 10 bounds
are at most 3 times the decay: what is nearly lost in noise must not claim whatever is found near it. Of the possible
pairs those are taken that leave the fewest alone and are nearest, first of the modes that are resolvable, then of the
others. A component without a mode is false (and listed as hum if it is within 1 Hz of a line of hum and decays by less
than 2/s); if it lies between two true modes which overlap and of which one is not resolvable, and decays no more than 3
times as fast or slowly as they, it is a blend.
"""
import glob, json, math, os, sys

def either(of, *names):
    return next((of[n] for n in names if n in of), None)

def components(report):
    """Frequency, decay, gain of each, and their standard errors."""
    out = []
    for m in report["modes"]:
        p = m["places"][0]
        out.append({"f": m["frequency_hz"], "d": m["decay_per_s"], "gain": abs(p["gain"]), "slope": m.get("slope", 1),
                    "se_f": either(m, "frequency_se", "frequency_error"), "se_d": either(m, "decay_se", "decay_error"),
                    "se_gain": either(p, "gain_se", "gain_error"),
                    "chi": next((v for k, v in {**p, **m}.items() if "chi" in k), None)})
    return out

def pole_distance(a, b):
    return math.hypot(2 * math.pi * (a["f"] - b["f"]), a["d"] - b["d"])

def gates_set(modes):
    for m in modes:
        near = min((pole_distance(m, o) for o in modes if o is not m), default=math.inf)
        least = min(0.2 * m["d"], near / 4)
        bounds = 2 * math.pi * m["bound_f"], m["bound_d"]
        m["gate"] = [max(least, min(10 * b, 3 * m["d"])) for b in bounds]

def cost(mode, component):
    """Distance over the gate, squared: 0 to 1; None outside."""
    x = [2 * math.pi * (component["f"] - mode["f"]) / mode["gate"][0], (component["d"] - mode["d"]) / mode["gate"][1]]
    return None if max(map(abs, x)) > 1 else (x[0] ** 2 + x[1] ** 2) / 2

def assign(modes, found):
    """The pairs (mode, component) that are most and, of such, nearest: one mode after another gets a component, others
    move to their next one where that costs least (shortest augmenting path, by Bellman and Ford). A mode's component
    -1 - i, at a price, stands for none."""
    edges = [{k: c for k, c in enumerate(cost(m, f) for f in found) if c is not None} for m in modes]
    for i, of_mode in enumerate(edges):
        of_mode[-1 - i] = 1000.0
    of = {}                                          # component: mode, as numbers
    for start in range(len(modes)):
        least, came, queue = {}, {}, [(start, 0.0)]
        while queue:
            i, so_far = queue.pop()
            for k, c in edges[i].items():
                if of.get(k) != i and so_far + c < least.get(k, math.inf) - 1e-12:
                    least[k], came[k] = so_far + c, i
                    if k in of:
                        queue.append((of[k], so_far + c - edges[of[k]][k]))
        k = min((k for k in least if k not in of), key=least.get)
        has = {i: k for k, i in of.items()}
        while k is not None:
            i = of[k] = came[k]
            k = has.get(i) if i != start else None
    return [(modes[i], found[k]) for k, i in of.items() if k >= 0]

def blended(c, modes):
    """Between two modes (three bounds beyond them at most), not both of them resolvable, that overlap."""
    for a in modes:
        for b in modes:
            if a is b or a["f"] > b["f"] or (a["resolvable"] and b["resolvable"]):
                continue
            wide = (a["d"] + b["d"]) / (2 * math.pi)
            overlap = b["f"] - a["f"] < max(wide, min(6 * max(a["bound_f"], b["bound_f"]), 6 * wide))
            beyond = [min(3 * m["bound_f"], m["d"] / (2 * math.pi)) for m in (a, b)]
            alike = min(a["d"], b["d"]) / 3 < c["d"] < 3 * max(a["d"], b["d"])
            if overlap and alike and a["f"] - beyond[0] < c["f"] < b["f"] + beyond[1]:
                return True
    return False

def level_taken_out(pairs):
    """Of a recording whose level and onset are unknown: gains are scaled by one factor and moved by one time, those
    that leave the least sum of errors over bounds (not squared, so that a few which are far off do not count)."""
    rows = [(m["gain"] / m["bound_gain"], m["d"], math.log(c["gain"] / m["gain"]))
            for m, c in pairs if m["resolvable"] and c["gain"] > 0]
    if len(rows) < 3:
        return
    level = slope = 0
    for _ in range(50):
        weighed = [(w * w / max(abs(w * (y - level - slope * d)), 1e-3), d, y) for w, d, y in rows]
        s = [sum(w * d ** p * y ** q for w, d, y in weighed) for p, q in ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1))]
        slope = (s[0] * s[4] - s[1] * s[3]) / (s[0] * s[2] - s[1] ** 2)
        level = (s[3] - slope * s[1]) / s[0]
    for m, c in pairs:
        factor = math.exp(-level - slope * m["d"])
        c["gain"] *= factor
        c["se_gain"] = c["se_gain"] and c["se_gain"] * factor

def text(x, strongest):
    return f"{x['f']:.4f} Hz, {x['d']:.4f} 1/s, {20 * math.log10(max(x['gain'], 1e-30) / strongest):.1f} dB"

class Recording:
    def __init__(self, name):
        with open(name + ".truth") as f:
            self.truth = json.load(f)
        self.name, self.modes, self.code = name, self.truth["modes"], int(open(name + ".code").read())
        self.cpu = float(open(name + ".cpu").read())
        found = []
        if self.code == 0:
            with open(name + ".json") as f:
                found = components(json.load(f))
        gates_set(self.modes)
        for m in self.modes:
            m["clear"] = not any(o is not m and not o["resolvable"] and
                                 2 * math.pi * abs(o["f"] - m["f"]) < 6 * (o["d"] + m["d"]) for o in self.modes)
        pairs = []
        for kind in (True, False):
            free = [c for c in found if not any(c is o for _, o in pairs)]
            pairs += assign([m for m in self.modes if m["resolvable"] == kind], free)
        if not self.truth["level_known"]:
            level_taken_out(pairs)
        self.of = {id(m): c for m, c in pairs}
        self.alone = [c for c in found if not any(c is o for _, o in pairs)]
        for c in self.alone:
            hum = c["d"] < 2 and any(abs(c["f"] - h) < 1 for h in self.truth.get("hum", ()))
            c["kind"] = "hum" if hum else "blend" if blended(c, self.modes) else "false"

    def found(self, mode):
        return self.of.get(id(mode))

    def tell(self):
        """What one would want to look at: missed, false, blends, and found but more than 6 bounds off."""
        strongest = max(m["gain"] for m in self.modes)
        head = f"{os.path.basename(self.name)} {self.truth['snr_db']:g} dB:"
        if self.code:
            print(head, f"exit code {self.code}:", open(self.name + ".err").read().strip()[-200:])
            return
        for m in self.modes:
            c = self.found(m)
            if m["resolvable"] and not c:
                print(head, "missed", text(m, strongest) + f"; gain {m['gain'] / m['bound_gain']:.1f} bounds, nearest "
                      f"{m['apart']:.3g} bounds, {m['bound_f']:.3g} Hz")
            elif m["resolvable"]:
                off = {x: (c[x] - m[x]) / m["bound_" + x] for x in ("f", "d", "gain")}
                if max(map(abs, off.values())) > 6:
                    by_se = ", ".join(f"{(c[x] - m[x]) / c['se_' + x]:+.1f}" for x in off if c["se_" + x])
                    print(head, "far off", text(m, strongest) + "; in bounds " +
                          ", ".join(f"{x} {v:+.1f}" for x, v in off.items()) + "; in standard errors " + by_se)
        for c in self.alone:
            near = min(self.modes, key=lambda m: pole_distance(m, c))
            print(head, c["kind"], text(c, strongest) + ("" if c["chi"] is None else f", chi-squared {c['chi']:g}") +
                  ("" if self.truth["level_known"] else " (level not known)") +
                  f"; nearest {near['f']:.4f} Hz, {near['d']:.4f} 1/s" +
                  ("" if near["resolvable"] else ", not resolvable"))

KINDS = ("f", "d", "gain")

class Row:
    def __init__(self):
        self.files = self.failed = self.true = self.found = self.false = self.blends = 0
        self.resolvable, self.plain = [0, 0], [0, 0]
        self.ratio, self.inside, self.clear, self.cpu = *({x: [] for x in KINDS} for _ in range(3)), []

    def add(self, r):
        self.files += 1
        self.failed += r.code != 0
        self.true += len(r.modes)
        self.found += len(r.of)
        self.false += sum(c["kind"] != "blend" for c in r.alone)
        self.blends += sum(c["kind"] == "blend" for c in r.alone)
        self.cpu.append(r.cpu)
        for m in r.modes:
            c = r.found(m)
            for tally, key in ((self.resolvable, "resolvable"), (self.plain, "plain")):
                tally[0] += m[key]
                tally[1] += m[key] and c is not None
            for x in KINDS if m["resolvable"] and c else ():
                self.ratio[x].append(abs(c[x] - m[x]) / m["bound_" + x])
                if c["se_" + x]:
                    self.inside[x].append(abs(c[x] - m[x]) < 1.96 * c["se_" + x])
                    if m["clear"]:
                        self.clear[x].append(self.inside[x][-1])

    def line(self, name):
        middle = lambda v: sorted(v)[len(v) // 2] if v else math.nan
        ratios = ", ".join(f"{1.4826 * middle(v):.2f}" for v in self.ratio.values())
        inside, clear = (", ".join(f"{100 * sum(v) / len(v):.1f}" if v else "-" for v in of.values())
                         for of in (self.inside, self.clear))
        cells = [name, self.files, self.failed, self.true, self.found, f"{self.resolvable[1]} of {self.resolvable[0]}",
                 f"{self.plain[1]} of {self.plain[0]}", self.false, self.blends, ratios,
                 f"{inside} ({len(self.inside['f'])})", f"{clear} ({len(self.clear['f'])})", f"{middle(self.cpu):.1f}, {max(self.cpu):.1f}"]
        return "| " + " | ".join(map(str, cells)) + " |"

HEAD = ["set", "files", "exit code not 0", "true", "found", "resolvable, found", "of gain > 8 bounds", "false",
        "blends", "error / bound: f, d, gain", "in 95 % intervals: f, d, gain (of)",
        "the same, clear", "CPU s: median, most"]

def main(words):
    how = words.pop(0) if words[0] in ("--list", "--split") else None
    folder, *sets = words
    if how != "--list":
        print("| " + " | ".join(HEAD) + " |\n" + "|---" * len(HEAD) + "|")
    for name in sets or "ABCDEFGHI":
        rows = {}
        for path in sorted(glob.glob(f"{folder}/{name}*.truth")):
            if os.path.exists(path[:-5] + "code"):
                r = Recording(path[:-6])
                key = f"{name}, {r.truth['snr_db']:g} dB" if how == "--split" else name
                rows.setdefault(key, Row()).add(r)
                if how == "--list":
                    r.tell()
        for key in sorted(rows) if how != "--list" else ():
            print(rows[key].line(key))

if __name__ == "__main__":
    main(sys.argv[1:])

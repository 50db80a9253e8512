"""A scene in the making: what each key says, and how that is written as YAML."""
import json

from keys import number, plain, written

# keys of the scene; all others are a contact's
TOP = ("rasp", "title", "seed", "output", "accuracy", "include", "inputs")


class Part:
    """One contact: path of a key to its text as YAML. (Also the scene's own keys, in a Part of their own.)"""

    def __init__(self, scene, name=None):
        self.scene, self.keys, self.rng, self.name = scene, scene.keys, scene.rng, name
        self.given = {}
        self.opened = set()  # optional sections that were chosen
        self.field = (-0.05, -0.05, 0.05, 0.05)  # x0, y0, x1, y1: where the contact may be, m
        self.lasts = 0.1
        self.careless = False

    def __contains__(self, path):
        return any(p == path or p.startswith(path + ".") for p in self.given)

    def chance(self, p):
        return self.rng.random() < p

    def say(self, path, text):
        """The key, in the words of YAML. Numbers are written out in full."""
        self.given[path] = plain(text) if isinstance(text, float) else str(text)
        return text

    def draw(self, path, low=None, high=None):
        """A key drawn from a range of ours (or the usual one), and in some scenes from all that is legal. Gives the
        word, or the number in SI (of a point the first)."""
        key, rng = self.keys.all[path], self.rng
        if key.words:
            return self.say(path, rng.choice(key.words))
        if rng.random() < self.scene.wild:
            low, high = key.low, key.high
            if rng.random() < 0.3:
                low = high = rng.choice([low, high])
            self.scene.note("whole range")
        elif low is None:
            low, high = key.range_usual()
        x = [number(rng, key, low, high) for _ in range(key.numbers)]
        if key.type.startswith("[least, most]"):
            x.sort()
        texts = [written(rng, v, key) for v in x]
        self.given[path] = texts[0] if key.numbers == 1 else "[" + ", ".join(texts) + "]"
        return x[0]

    def choose(self, path, words):
        """One of some words, or nothing: then it is the first of them, which is the default."""
        word = self.rng.choice(words)
        if word is not None and (word != self.keys.all[path].default or self.chance(0.5)):
            self.say(path, word)
        return word

    def length(self, path, metres):
        """A length as it is, in some unit."""
        self.given[path] = written(self.rng, float(f"{metres:.6g}"), self.keys.all[path])
        return metres

    def point(self, path, *metres):
        key = self.keys.all["motion.at"]
        self.given[path] = "[" + ", ".join(written(self.rng, float(f"{m:.6g}"), key) for m in metres) + "]"

    def open(self, section):
        self.opened.add(section)

    def sprinkle(self, paths, p=0.12, closed=0.0):
        """Optional keys at random: each that may be given beside what there is. Sections that were not chosen are, of
        `closed`, chosen here."""
        for section in self.keys.sections:
            if section not in self.opened and self.chance(closed):
                self.opened.add(section)
        for key in self.keys.all.values():
            section = self.keys.section_of(key.path)
            if not key.path.startswith(paths) or not key.drawn or key.path in self or key.path.rpartition(".")[
                0] in self.given or (section and section not in self.opened):
                continue
            if self.chance(max(p, 0.3) if section else p) and self.keys.applies(key, self.given) and (self.careless
                or self.scene.only_if.get(key.path, always)(self)):
                self.draw(key.path)


def always(part):
    return True


class Scene:
    """What a folder holds: a scene's text, and the files that it names."""

    def __init__(self, keys, rng, folder, rasp):
        self.keys, self.rng, self.folder, self.rasp = keys, rng, folder, rasp
        self.wild = rng.choices([0, 0.01, 0.05, 0.3], [45, 30, 20, 5])[0]
        self.top = Part(self)
        self.contacts = []
        self.only_if = {}       # key: does it make sense beside what a contact has?
        self.notes = set()      # kinds of files and models, for the report of what was covered
        self.files = {}         # name: kind
        self.options = []       # of the command line
        self.texts = {}         # name of a YAML file: its text
        self.lines = {}         # key: (file, line)
        self.expected = None    # (file, line) of a planted fault which must be told there
        self.planted = None     # what was planted, in words

    def note(self, text):
        self.notes.add(text)

    def name(self, kind, ending):
        """A name for a file that is to be made."""
        name = f"{self.rng.choice(['', '', 'in/', 'a b/'])}{kind}{len(self.files)}{ending}"
        (self.folder / name).parent.mkdir(exist_ok=True)
        self.files[name] = kind
        return name

    def given(self):
        """All that is said, path and text."""
        for part in [self.top, *self.contacts]:
            yield from part.given.items()

    def seconds(self):
        return max((c.lasts for c in self.contacts), default=0)

    # ------------------------------------------------------------------ YAML

    def write(self):
        tree = {}
        several = len(self.contacts) > 1 or self.rng.random() < 0.05
        for path, text in self.top.given.items():
            plant(tree, path, text)
        if several:
            tree["contacts"] = []
            for part in self.contacts:
                tree["contacts"].append({"name": part.name, **grow(part.given)})
        else:
            for path, text in self.contacts[0].given.items():
                plant(tree, path, text)
        included = {}
        if self.rng.random() < 0.15:
            for name in [n for n, v in tree.items()
                if n in ("surface", "motion", "contact", "output", "scraper", "ball")]:
                if self.rng.random() < 0.5:
                    included[name] = tree.pop(name)
        if included:
            tree["include"] = "[part.yaml]"
            self.note("include")
            self.yaml("part.yaml", included)
        order = list(tree)
        if self.rng.random() < 0.2:
            self.rng.shuffle(order)
        self.yaml("scene.yaml", {name: tree[name] for name in order})

    def yaml(self, file, tree):
        out = []
        self.block(file, tree, 0, "", out)
        self.texts[file] = "\n".join(out) + "\n"

    def block(self, file, tree, indent, path, out):
        """Maps as blocks, some as flow; where each key stands is kept in self.lines."""
        for name, value in tree.items():
            start, where = " " * indent, f"{path}.{name}" if path else name
            self.lines[where] = (file, len(out) + 1)
            if isinstance(value, list):
                out.append(f"{start}{name}:")
                for i, item in enumerate(value):
                    out.append(f"{start}  -")
                    self.block(file, item, indent + 4, f"{where}.{i}", out)
            elif isinstance(value, dict) and (self.rng.random() < 0.3 or not value):
                self.flow_lines(file, value, where, len(out) + 1)
                out.append(f"{start}{name}: {flow(value)}")
            elif isinstance(value, dict):
                out.append(f"{start}{name}:" + self.rng.choice(["", "", "  # a comment", "\t"]))
                self.block(file, value, indent + self.rng.choice([2, 2, 4]), where, out)
            else:
                out.append(f"{start}{name}: {value}")

    def flow_lines(self, file, tree, path, line):
        for name, value in tree.items():
            self.lines[f"{path}.{name}"] = (file, line)
            if isinstance(value, dict):
                self.flow_lines(file, value, f"{path}.{name}", line)


def plant(tree, path, text):
    *maps, last = path.split(".")
    for name in maps:
        tree = tree.setdefault(name, {})
        # a careless scene says both accuracy: high and accuracy.preset: the first one stays
        if not isinstance(tree, dict):
            return
    tree.setdefault(last, text)


def grow(given):
    tree = {}
    for path, text in given.items():
        plant(tree, path, text)
    return tree


def flow(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name}: {flow(v)}" for name, v in value.items()) + "}"
    return value


def quoted(text):
    """Any text as a YAML scalar."""
    return json.dumps(text, ensure_ascii=False)

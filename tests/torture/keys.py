"""What a scene may say, as the program itself tells it (rasp explain --json and --schema=scene), and values drawn for
it. A key that is new in src is drawn without an edit here."""
import json
import math
import re
import subprocess
from decimal import Decimal

# How a number of a unit may be written: the unit's names, and the power of ten by which each is more than SI's.
UNITS = {
    "m": {"m": 0, "cm": -2, "mm": -3, "um": -6, "\u00b5m": -6, "nm": -9, "km": 3},
    "s": {"s": 0, "ms": -3, "us": -6, "ns": -9}, "Hz": {"Hz": 0, "kHz": 3, "MHz": 6, "mHz": -3},
    "kg": {"kg": 0, "g": -3, "mg": -6}, "N": {"N": 0, "mN": -3, "kN": 3, "MN": 6},
    "m/s": {"m/s": 0, "cm/s": -2, "mm/s": -3}, "m/s^2": {"m/s^2": 0, "m/s2": 0, "mm/s^2": -3},
    "rad": {"rad": 0, "mrad": -3}, "/m^2": {"/m^2": 0, "/cm^2": 4, "/mm2": 6, "/um^2": 12}, "dB": {"dB": 0, "dBFS": 0},
    "LUFS": {"LUFS": 0}, "Pa": {"Pa": 0, "kPa": 3, "MPa": 6, "GPa": 9},
    "kg/m^3": {"kg/m^3": 0, "g/cm^3": 3}, "1/s": {"1/s": 0, "/s": 0}, "N/m": {}, "s/m": {"s/m": 0, "ms/m": -3},
    "N s/m^2.5": {"N s/m^2.5": 0, "kN s/m^2.5": 3},
    "N/(m^1.5 kg)": {"N/(m^1.5 kg)": 0, "MN/m^1.5/kg": 6}, "N (s/m)^beta2": {"N s/m": 0, "N (s/m)^beta2": 0},
}
POINT = {"[x, y]": 2, "[least, most]": 2}  # how many numbers the type's list holds

# What is meant by most scenes: the range from which a key is drawn that is not drawn from all that is legal. Of keys
# that are not here it is five times less to five times more
# than the default, or the middle half of the legal range's decades.
USUAL = {
    "start": (1e-3, 0.05), "gain": (-2, 2), "motion.duration": (0.02, 0.2), "output.tail": (1e-3, 0.2),
    "output.duration": (0.01, 0.3), "output.ramp": (1e-5, 0.01), "output.channels": (1, 4),
    "output.diagnostics.rate": (10, 2e4), "output.sample_rate": (16000, 48000), "load.approach": (1e-4, 5e-3),
    "load.release": (1e-4, 5e-3), "load.constant": (0.05, 10), "motion.turns": (-3, 3),
    "surface.fractal.length": (0.02, 1), "surface.fractal.pitch": (2e-5, 2e-4),
    "surface.roughness.longest": (5e-4, 5e-3), "surface.roughness.shortest": (2e-5, 2e-4),
    "surface.roughness.rms": (1e-7, 1e-5),
    "surface.roughness.skewness": (-0.5, 0.5), "surface.roughness.kurtosis": (2.5, 5),
    "surface.roughness.exponent": (-4, 0), "surface.roughness.grain": (1, 5),
    "surface.continuation.shortest": (2e-6, 1e-5),
    "surface.continuation.from": (2e-5, 1e-3), "surface.continuation.exponent": (-4, -1),
    "surface.origin": (-0.01, 0.01), "surface.object.origin": (-0.01, 0.01), "scraper.object.at": (0, 0.02),
    "ball.object.at": (0, 0.001), "ablation.place": (-0.01, 0.01),
    "surface.ridges.width": (5e-5, 2e-4), "surface.ridges.spacing": (4e-4, 4e-3),
    "surface.response_length": (1e-3, 0.2), "scraper.response_length": (1e-3, 0.2), "ball.response_length": (1e-3, 0.2),
    "surface.space.from": (-0.7, 0.7), "surface.space.to": (-0.7, 0.7), "surface.space.dimension_to": (1, 3),
    "surface.modes": (1, 100), "scraper.modes": (1, 100), "ball.modes": (1, 100), "scraper.radius": (5e-4, 5e-3),
    "scraper.patch": (1e-5, 5e-5), "ball.patch": (1e-5, 5e-5), "ball.offset": (1e-6, 1e-3),
    "ball.lobe_height": (1e-9, 1e-5), "ball.wall": (1e-4, 2e-3), "ball.mass": (1e-3, 0.5),
    "grip.angle": (0.05, 1), "grip.friction": (0.05, 0.5), "contact.smoothing": (1e-6, 1e-4),
    "contact.limiter.alpha": (3e-3, 0.1), "contact.limiter.alpha_min": (1e-3, 0.01),
    "contact.limiter.alpha_max": (0.011, 0.1), "contact.limiter.force_range": (1e-3, 10),
    "contact.strike.first": (0, 0.02), "contact.strike.count": (0, 10), "contact.strike.interval": (1e-3, 0.05),
    "contact.strike.restitution": (0.1, 0.95), "contact.strike.speed": (0.05, 5), "contact.roll.drop": (1e-6, 1e-3),
    "contact.roll.stiffness": (1e7, 1e10), "contact.roll.kappa": (1e8, 1e11), "contact.given.channel": (1, 1),
    "contact.roll.static_penetration": (1e-6, 1e-4), "contact.impacts.amplitude.mean": (0.1, 1),
    "contact.impacts.interval.mean": (1e-3, 0.02), "contact.impacts.amplitude.deviation": (0.01, 0.2),
    "contact.impacts.interval.deviation": (1e-4, 1e-3), "contact.impacts.amplitude.a1": (-0.95, 0.5),
    "contact.impacts.interval.a1": (-0.95, 0.5), "contact.impacts.amplitude.b1": (-1, 1),
    "contact.impacts.interval.b1": (-1, 1), "contact.impacts.duration.zeta": (1e-5, 1e-3),
    "contact.impacts.duration.theta": (0, 0.5), "contact.impacts.modulation.rate": (1, 30),
    "contact.impacts.modulation.depth": (0.05, 0.9), "contact.impacts.floor.amplitude": (0.001, 0.1),
    "contact.impacts.floor.interval": (1e-6, 2e-5), "contact.impacts.rub.interval": (2.3e-5, 1e-3),
    "contact.impacts.space.angle": (-7, 7), "contact.impacts.space.angle_to": (-7, 7),
    "contact.comb.gain": (-0.9, 0.9), "contact.comb.distance": (0, 1), "contact.modulation.rate": (1, 50), "contact.modulation.radius": (1e-3, 0.05),
    "contact.gesture.cutoff": (100, 2e4), "output.level.full_scale": (1, 1e6), "output.level.dbfs_at_1_pa": (-150, -60),
    "output.listen.density": (0.5, 5), "output.listen.sound_speed": (200, 1500), "accuracy.error": (-90, -10),
    "accuracy.oversampling": (1, 16), "accuracy.contact_steps": (20, 400), "motion.straight": (0.01, 1),
    "motion.cutoff": (0, 100), "motion.until": (0.05, 2), "motion.corner": (1e-5, 1e-3),
    "surface.object.poisson": (0.05, 0.45), "scraper.object.poisson": (0.05, 0.45), "ball.object.poisson": (0.05, 0.45),
}
for body in ("surface", "scraper", "ball"):
    USUAL[f"{body}.band"] = (20, 4e4)
    for key, usual in {"youngs_modulus": (1e9, 2e11), "youngs_modulus_across": (5e8, 5e9), "shear_modulus": (1e8, 5e9),
        "density": (200, 9000), "alpha": (0, 50), "beta": (0, 1e-6), "loss": (1e-4, 0.05)}.items():
        USUAL[f"{body}.object.{key}"] = usual


class Key:
    """One key of the scene: where it may be given, and of what type and range it is."""

    def __init__(self, told):
        self.path, self.type, self.unit, self.low, self.high = told["path"], told["type"], told.get("unit"), told[
            "low"], told["high"]
        self.words = [w["word"] for w in told.get("words") or []]
        self.default, self.only = told.get("default"), told.get("only")
        self.whole = "whole number" in self.type
        self.numbers = next((n for name, n in POINT.items() if self.type.startswith(name)), 1)
        if self.type.startswith("[x, y], two lengths"):
            self.unit = "m"
        elif self.type.startswith("[least, most], two forces"):
            self.unit = "N"
        # else a recipe must know what to say
        self.drawn = bool(self.words) or (self.low is not None and not self.type.startswith("list"))

    def range_usual(self):
        if self.path in USUAL:
            return USUAL[self.path]
        try:
            middle = si(self.default or "", self)
        except (ArithmeticError, ValueError):  # none, or no number
            middle = 0
        if middle:
            return tuple(sorted((max(self.low, min(self.high, middle / 5)), max(self.low, min(self.high, middle * 5)))))
        if self.low > 0:
            return self.low ** 0.75 * self.high ** 0.25, self.low ** 0.25 * self.high ** 0.75
        return max(self.low, -1), min(self.high, 1)


def si(text, key):
    """What a number that the program prints (3 cm, 1e7 /m^2) is in SI; of angles only what is in rad or deg."""
    number, _, unit = text.partition(" ")
    if unit == "deg":
        return math.radians(float(number))
    return float(Decimal(number).scaleb(UNITS.get(key.unit, {}).get(unit, 0)))


def between(rng, low, high):
    """Even in the logarithm where the range spans more than a decade, even else; 0 and negative numbers where they are
    legal."""
    if low == high:
        return low
    if low > 0:
        return math.exp(rng.uniform(math.log(low), math.log(high))) if high / low > 10 else rng.uniform(low, high)
    if high <= 0:
        return -between(rng, -high, -low) if high < 0 else -between(rng, 0, -low)
    size = max(high, -low)
    x = rng.choice([0, rng.uniform(low, high), math.exp(rng.uniform(math.log(size * 1e-6), math.log(size))),
        -math.exp(rng.uniform(math.log(size * 1e-6), math.log(size)))])
    return min(high, max(low, x))


def number(rng, key, low, high):
    """One from low to high, as short as people write it unless that leaves the range."""
    x = between(rng, low, high)
    if key.whole:
        return min(int(key.high), max(math.ceil(key.low), round(x)))
    short = float(f"{x:.{rng.choice([1, 2, 3, 3, 4, 16])}g}")
    return short if min(low, high) <= short <= max(low, high) else x


def written(rng, x, key):
    """The number as YAML: bare, or with one of its units, which is exact in decimal."""
    names = UNITS.get(key.unit, {})
    if key.whole or not names or rng.random() < 0.4:
        if key.unit == "rad" and rng.random() < 0.5 and key.low * 0.999 < x < key.high * 0.999:
            return f"{math.degrees(x):.5g}" + rng.choice([" deg", "\u00b0", "deg"])
        return str(x) if key.whole else plain(x)
    name = rng.choice(sorted(names))
    digits = plain(float(0)) if x == 0 else str(Decimal(plain(x)).scaleb(-names[name])).replace("E", "e")
    return digits + (" " if name[0].isdigit() else rng.choice(["", " ", " "])) + name


def plain(x):
    return repr(float(x)).removesuffix(".0")


class Keys:
    """All keys, in the program's order, which puts what decides before what is decided."""

    def __init__(self, rasp):
        told = json.loads(subprocess.run([rasp, "explain", "--json"], capture_output=True, check=True).stdout)
        self.schema = json.loads(subprocess.run([rasp, "explain", "--schema=scene"], capture_output=True,
            check=True).stdout)
        self.all = {t["path"]: Key(t) for t in told}
        self.sections = sorted(self.sections_of(self.schema))

    def sections_of(self, schema):
        """Maps that are themselves a choice (a grip, grit, listening): their keys are drawn only where the section was
        chosen. Others, such as contact.limiter, only hold keys."""
        for top, definition in schema["$defs"].items():
            todo = [(top, definition)]
            while todo:
                path, node = todo.pop()
                todo += [(f"{path}.{name}", child) for name, child in node.get("properties", {}).items()]
                if "object" in (node.get("type") or []) and node.get("description"):
                    yield path

    def section_of(self, path):
        return next((s for s in self.sections if path.startswith(s + ".")), None)

    def applies(self, key, given):
        """May the key be given beside what is given (path to text)? By the sentence that says so."""
        if key.only is None:
            return True
        m = re.fullmatch(r"beside (\S+)|where (\S+) is (.+)", key.only)
        other = self.all[m[1] or m[2]]
        if m[1]:
            fits = other.path in given
        elif m[3] == "not given":
            fits = other.path not in given
        else:
            fits = given.get(other.path, other.default) in re.split(r", | or ", m[3])
        return fits and self.applies(other, given)

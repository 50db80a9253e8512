"""Scenes: what has to fit together is put together here, and all that may be added to it is then drawn from the
program's own list of keys (Part.sprinkle). A new model, motion or kind of file is a
function here; a new key that stands by itself needs nothing."""
import math

import inputs
from scene import Part, Scene, quoted

# Which speed laws go with which path.
LAWS = {
    "back_and_forth": [None, "auto", "harmonic", "minimum_jerk", "given"],
    "line": [None, "auto", "harmonic", "constant", "minimum_jerk", "given"],
    "four_in_line": [None, "harmonic", "constant", "minimum_jerk", "given"],
    "circle": [None, "harmonic", "constant", "minimum_jerk", "two_thirds", "given"],
    "scribble": [None, "auto", "harmonic", "constant", "minimum_jerk", "two_thirds", "given"],
    "spline": [None, "auto", "harmonic", "constant", "minimum_jerk", "two_thirds", "given"],
    "polyline": [None, "auto", "harmonic", "minimum_jerk"],
    "recorded": [None, None, "auto", "harmonic", "constant", "minimum_jerk", "two_thirds", "given"],
    "still": [None, "auto"], "incline": [None, "auto"],
}
MATERIALS = ["basswood", "poplar", "oak", "pvc", "polycarbonate", "acrylic", "glass", "ceramic", "steel", "aluminium"]
FOLLOWS = ("scrape", "roll", "roll_coupled", "playback")  # models that read a surface's heights
BALLS = ("roll", "roll_coupled")


def make(keys, rng, folder, rasp):
    """A scene, and the files that it names, in the folder."""
    scene = Scene(keys, rng, folder, rasp)
    scene.quantity = rng.choice(["displacement", "velocity", "velocity", "acceleration"])  # of its mode tables
    scene.only_if = ONLY_IF
    scene.top.say("rasp", 1)
    count = rng.choices([1, 2, 3], [85, 12, 3])[0]
    for i in range(count):
        part = Part(scene, rng.choice(["c", "rod_", "_"]) + str(i))
        scene.contacts.append(part)
        contact(part)
    output(scene)
    accuracy(scene)
    if rng.random() < 0.5:
        scene.top.say("seed", rng.choice([0, 1, rng.getrandbits(64), 2 ** 64 - 1]))
    if rng.random() < 0.2:
        scene.top.say("title", quoted(rng.choice(["a scene", "\u00fcber # all: {things}, [said]", "x" * 300, "1e5",
            "~"])))
    scene.write()
    if rng.random() < 0.1:
        scene.options += ["--seed", str(rng.getrandbits(40))]
    return scene


# ------------------------------------------------------------------ a contact

def contact(part):
    model = part.rng.choice(["scrape", "scrape", "scrape", "strike", "given", "roll", "roll_coupled", "impacts",
        "impacts", "playback"])
    tool = "ball" if model in BALLS else "scraper"
    part.scene.note(f"model: {model}")
    if model != "scrape" or part.chance(0.3):
        part.say("contact.model", model)
    response(part, model)
    MODELS[model](part)
    if model in FOLLOWS:
        relief(part, model)
    motion(part, model)
    tool_response(part, tool)
    if part.chance(0.15):
        part.open("ablation")
        if rings(part, "surface") and rings(part, tool):
            part.choose("ablation.sound", [None, "both", "surface", tool])
    if model in ("impacts", "playback", "given") and part.chance(0.25) and part.given.get("motion.path") != "still":
        part.open("contact.gesture")
        part.draw("contact.gesture.cutoff")
    if part.chance(0.2) and ("surface.object" in part or "surface.space" in part
        or part.given.get("surface.response", "").rstrip('"').endswith(".csv")):
        part.open("contact.enhance")
        part.draw("contact.enhance.gain")
    sprinkle(part, model, tool)


def sprinkle(part, model, tool):
    """What may be added, but for what a recipe has decided about as a whole; now and then that, too."""
    part.sprinkle(("name", "start", "gain", "contact.limiter", "contact.smoothing", "contact.leak", "contact.beta",
        "contact.gravity", "contact.force", "contact.gesture", "contact.modulation", "contact.comb", "contact.enhance", "ablation",
                   "grip", "motion.straight", "load.approach", "load.release", "contact.impacts", "contact.roll.mu", "load.phase",
                   "contact.roll.lambda", "contact.roll.static_penetration", "contact.roll.damping_ratio", "contact.roll.scraping",
                   "contact.roll.ground"))
    part.sprinkle(tuple(f"{tool}.{k}" for k in ("weight", "radius", "patch", "offset", "start_angle", "lobe", "wall",
        "mass")), p=0.1)
    if model in FOLLOWS:
        part.sprinkle(("surface.roughness", "surface.ridges", "surface.grit", "surface.fractal",
            "surface.continuation", "surface.levelling", "surface.along", "surface.origin", "surface.off_map"), p=0.1)
    for body in ("surface", tool):
        if rings(part, body):
            part.sprinkle((f"{body}.modes", f"{body}.band", f"{body}.object", f"{body}.space"), p=0.1)
            reading(part, body)
    if part.chance(0.06):
        part.scene.note("carelessly put together")
        part.careless = True
        part.sprinkle(("",), p=0.03, closed=0.05)
    kurtosis_fits(part)


def rings(part, body):
    """By what a body rings: table, recorded, object, space or None."""
    file = part.given.get(f"{body}.response", "").strip('"')
    if file:
        return "table" if file.endswith(".csv") else "recorded"
    return next((kind for kind in ("object", "space") if f"{body}.{kind}" in part), None)


def reading(part, body):
    """How the response is read as the contact moves, and by which engine: what goes together."""
    kind = rings(part, body)
    travels = "surface.space.to" in part or "surface.space.dimension_to" in part
    moving = None
    if body == "surface":
        shared = part.shared if kind == "table" else not travels
        moving = part.choose("surface.moving", [None, None, "auto", "launch"]
            + ["glide", "readout"] * (kind != "recorded") + ["fixed"] * (kind != "recorded" and shared))
        if kind == "table" and part.chance(0.2):
            part.draw("surface.pairing")
    glides = moving == "glide" or moving in (None, "auto") and travels and kind == "space"
    if part.chance(0.3):
        engines = ["auto"] + ["overlap_add"] * (not glides) + ["resonators"] * (kind != "recorded" and moving != "readout")
        part.choose(f"{body}.convolution", engines)
    engine = part.given.get(f"{body}.convolution")
    if not glides and engine != "resonators" and part.chance(0.15):
        part.draw(f"{body}.response_length")
    if not glides and kind != "recorded" and engine in (None, "auto", "overlap_add") and part.chance(0.15):
        part.draw(f"{body}.gammatone")


# What is drawn as an optional key only where this holds (of a careless scene always); of keys that recipes decide about
# it never does.
ONLY_IF = {
    "surface.fractal.interpolation": lambda p: False,
    "surface.roughness.grain": lambda p: p.given.get("surface.along") in (None, "plane") and "surface.fractal" not in p,
    "surface.ridges.direction": lambda p: "surface.fractal" not in p,
    "surface.object.origin": lambda p: p.given.get("surface.extrapolate") == "nearest",
    "surface.object.shape": lambda p: False,
    "surface.object.edges": lambda p: False, "scraper.object.edges": lambda p: False,
    "ball.object.edges": lambda p: False, "surface.origin": lambda p: p.given.get("surface.off_map") != "error",
    "surface.along": lambda p: "surface.fractal" not in p
    and "surface.height_map" not in p, "surface.object.thickness": lambda p: False,
    "scraper.object.thickness": lambda p: False,
    "ball.object.thickness": lambda p: False, "surface.off_map": lambda p: False,
    "surface.height_range": lambda p: False, "surface.pitch": lambda p: False,
    "surface.roughness.like_pitch": lambda p: False,
    "contact.impacts.amplitude.distribution": lambda p: False,
    "contact.impacts.interval.distribution": lambda p: False,
    "contact.impacts.marginal": lambda p: "table" not in str(p.given),
    "contact.impacts.modulation.rate": lambda p: "contact.impacts.modulation.depth" in p.given,
    "contact.roll.mu": lambda p: p.given.get("contact.roll.penetration") != "paper",
    "contact.roll.static_penetration": lambda p: not {"contact.roll.stiffness", "contact.roll.kappa"} & set(p.given),
    "ball.patch": lambda p: p.given.get("contact.roll.follows") != "point",
    "contact.roll.ground": lambda p: False, "contact.roll.drop": lambda p: False,
    "ablation.sound": lambda p: False, "output.listen.radiator": lambda p: False,
    "contact.limiter.alpha_min": lambda p: "contact.limiter.alpha_max" in p.given or p.scene.wild == 0,
}


def kurtosis_fits(part):
    """Skewness and kurtosis that no heights have are a fault that is drawn far too often."""
    if "surface.roughness.skewness" in part.given and part.chance(0.8):
        part.draw("surface.roughness.kurtosis", 6, 20)


# ------------------------------------------------------------------ models

def scrape(part):
    part.draw("scraper.mass", 1e-3, 0.2)
    if part.chance(0.3):
        part.draw("scraper.radius", 3e-4, 5e-3)
    force = part.choose("contact.force", [None, None, "directional", "paper"])
    if force == "paper" and part.chance(0.4):
        part.draw("contact.limiter.ratio_y", 0.3, 3)
    part.load = part.rng.choice([None, None, "grip", "constant", "recorded"])
    if part.load == "grip":
        part.open("grip")
        part.draw("grip.angle")
    elif part.load == "constant":
        part.draw("load.constant")


def strike(part):
    part.draw("scraper.mass", 1e-3, 0.2)
    part.draw("contact.strike.speed")
    pulse = part.choose("contact.strike.pulse", [None, "hertz", "half_sine"])
    if pulse == "half_sine":
        part.draw("contact.strike.stiffness", 1e4, 1e8)
    elif part.chance(0.5):
        part.draw("contact.strike.stiffness", 1e6, 1e10)
    else:
        part.draw("scraper.radius", 1e-3, 2e-2)
        for body in ("surface", "scraper"):
            if f"{body}.material" not in part:
                part.choose(f"{body}.material", MATERIALS)
    more = part.rng.choice([None, "contact.strike.interval", "contact.strike.restitution"])
    if more:
        part.draw(more)
    if part.chance(0.5):
        part.draw("contact.strike.first")
    if more and part.chance(0.4):
        part.draw("contact.strike.count")


def given(part):
    rng, scene = part.rng, part.scene
    kind, rate, seconds = rng.choice(["wav", "npy", "csv"]), rng.choice([8000, 44100, 48000, 10000,
        96000]), rng.uniform(0.005, 0.018)
    scene.note(f"force: {kind}")
    force = [rng.gauss(0, 0.2) for _ in range(int(rate * seconds))]
    name = scene.name("force", "." + kind)
    if kind == "wav":
        count = rng.choice([1, 1, 2, 3])
        inputs.wav(scene.folder / name, [force] * count, rate, rng.choice(inputs.ENCODINGS))
        if part.chance(0.3):
            part.draw("contact.given.channel", 1, count)
        part.draw("contact.given.scale", 0.1, 100)
    elif kind == "npy":
        inputs.npy(scene.folder / name, force, rng.choice(["f4", "f8"]))
        part.draw("contact.given.rate", rate, rate)
    else:
        column = rng.choice(["force_n", "f x"])
        inputs.text(scene, name, [f"time_s,{column}",
            *(f"{t:.9g},{rng.gauss(0, 1):.6g}" for t in inputs.rising(rng, seconds, 1e-4))])
        if column != "force_n":
            part.say("contact.given.column", quoted(column))
    if kind != "wav" and part.chance(0.4):
        part.draw("contact.given.scale", *rng.choice([(0.1, 10), (-10, -0.1)]))
    part.say("contact.given.file", quoted(name))


def ball(part):
    part.draw("ball.radius", 2e-3, 3e-2)
    if "ball.material" not in part:
        part.choose("ball.material", MATERIALS)
    body = part.choose("ball.body", [None, None, "solid", "hollow", "hoop", "wheel"])
    if body in ("hoop", "wheel") or part.chance(0.3):
        part.draw("ball.mass", 1e-3, 0.5)
    elif body == "hollow":
        part.draw("ball.wall", 1e-4, 1.5e-3)
    if part.chance(0.25):
        part.draw("ball.offset", 1e-5, 5e-4)
    if part.chance(0.2):
        part.draw("ball.lobe_height", 1e-8, 1e-5)


def roll(part):
    ball(part)
    penetration = part.choose("contact.roll.penetration", [None, "deviation", "paper"])
    part.scene.note(f"roll: {penetration or 'deviation'}")
    if part.chance(0.3):
        part.say("contact.roll.follows", part.rng.choice(["ball", "point"]))
    if penetration == "paper":
        part.draw(part.rng.choice(["contact.roll.stiffness", "contact.roll.kappa"]), 1e2, 1e5)
    elif part.chance(0.3):
        part.draw(part.rng.choice(["contact.roll.stiffness", "contact.roll.kappa"]), 1e7, 1e10)


def roll_coupled(part):
    ball(part)
    modes = "surface.object" in part or "surface.space" in part
    integrator = part.choose("contact.roll.integrator", [None, "discrete_gradient", "rk4", "exact_impact"])
    ground = "rigid" if integrator == "exact_impact" else part.rng.choice([None, "auto", "rigid", "elastic"]
        if modes else [None, "auto", "rigid"])
    if ground:
        part.say("contact.roll.ground", ground)
    if part.chance(0.5):
        part.draw(part.rng.choice(["contact.roll.stiffness", "contact.roll.kappa"]), 1e6, 1e9)
    elif "surface.material" not in part:
        part.choose("surface.material", MATERIALS)
    if part.chance(0.4):
        part.draw("contact.roll.drop", 1e-4, 1e-2)
    part.scene.note(f"roll_coupled: {integrator or 'discrete_gradient'}, {ground or 'auto'} ground")


def impacts(part):
    prototype = part.choose("contact.impacts.prototype", ["roll", "rub", "scratch", "space", "custom"])
    part.scene.note(f"impacts: {prototype}")
    if prototype == "custom" or part.chance(0.15) and prototype in ("roll", "space"):
        for series in ("amplitude", "interval"):
            path = f"contact.impacts.{series}"
            part.draw(f"{path}.mean")
            kind = part.choose(f"{path}.distribution", [None, "gaussian", "exponential", "table"])
            if kind == "table":
                width = 0.2 if series == "amplitude" else 1e-3
                rows = [[v * width, part.rng.uniform(0, 1) + (v == 0)] for v in (-1, -0.5, 0, 0.4, 1)]
                part.say(f"{path}.table", quoted(inputs.table(part.scene, "density", ["value", "density"], rows)))
            else:
                part.draw(f"{path}.deviation")
        part.draw("contact.impacts.duration.zeta")
        if part.chance(0.4):
            part.draw("contact.impacts.modulation.depth")
            part.draw("contact.impacts.modulation.rate")
    if prototype == "space":
        way = part.rng.choice(["place", "to", "walk"])
        if way == "walk":
            turn = inputs.wave(part.rng, -400, 400, 0.2)
            rows = [[t, turn(t), part.rng.uniform(-1, 1)] for t in inputs.rising(part.rng, 0.2, 0.03)]
            part.say("contact.impacts.space.walk",
                quoted(inputs.table(part.scene, "walk", ["time_s", "angle_deg", "radius"], rows)))
        elif way == "to":
            part.draw("contact.impacts.space.angle_to")
            part.draw("contact.impacts.space.radius_to")


def playback(part):
    if part.chance(0.5):
        part.draw("contact.playback.stiffness")


MODELS = {"scrape": scrape, "strike": strike, "given": given, "roll": roll, "roll_coupled": roll_coupled,
    "impacts": impacts, "playback": playback}


# ------------------------------------------------------------------ surfaces

def relief(part, model):
    """One or several of what a surface's heights are made of."""
    rng, scene = part.rng, part.scene
    kinds = rng.sample(["roughness", "like", "map", "ridges", "grit", "fractal", "recipe"], rng.choice([1, 1, 1, 2, 3]))
    if "fractal" in kinds:
        kinds = [k for k in kinds if k in ("fractal", "roughness")]
    if "like" in kinds:
        kinds = [k for k in kinds if k not in ("roughness", "recipe")]
    for kind in kinds:
        scene.note(f"surface: {kind}")
        if kind in ("roughness", "like"):
            roughness(part, kind == "like")
        elif kind == "map":
            height_map(part)
        elif kind == "recipe":
            surface_recipe(part)
        else:
            part.open(f"surface.{kind}")
            part.draw(f"surface.{kind}.{dict(ridges='spacing', grit='diameter', fractal='pitch')[kind]}",
                *{"grit": (5e-5, 5e-4)}.get(kind, ()))
            if kind == "ridges":
                part.choose("surface.ridges.shape", ["sine", "round", "groove"])
            if kind == "grit":
                part.draw("surface.grit.density", 1e4, 1e7)
            if kind == "fractal":
                part.choose("surface.along", ["path", "x"])
                if model != "scrape" or "scraper.radius" in part:
                    part.choose("surface.fractal.interpolation", ["spline", "linear", "nearest"])
    if "surface.along" not in part and part.chance(0.2):
        part.choose("surface.along", ["auto", "path", "x", "plane"])


def roughness(part, like):
    part.open("surface.roughness")
    if like:
        m = inputs.Map(part.scene, formats=["gsf", "gwy", "sdf", "npy", "csv"], metres=True)
        part.say("surface.roughness.like", quoted(m.name))
        if not m.holds_pitch or part.chance(0.2):
            part.length("surface.roughness.like_pitch", m.pitch)
    else:
        part.draw("surface.roughness.rms")
    if part.chance(0.15) and "surface.fractal" not in part:
        part.draw("surface.roughness.grain")
        part.draw("surface.roughness.grain_direction")
        part.say("surface.along", "plane")


def height_map(part):
    holes = part.chance(0.1)
    m = inputs.Map(part.scene, holes)
    part.say("surface.height_map", quoted(m.name))
    if holes:
        part.say("surface.holes", "fill")
    elif part.chance(0.1):
        part.say("surface.holes", "refuse")
    if not m.holds_pitch or part.chance(0.2):
        part.length("surface.pitch", m.pitch)
    if m.scale and (m.scale != 1 or part.chance(0.3)):
        part.length("surface.height_scale", m.scale)
    if m.range:
        part.length("surface.height_range", m.range)
    if part.chance(0.3):
        part.choose("surface.levelling", ["none", "mean", "plane"])
    if part.chance(0.2) and "surface.response" not in part and "surface.object" not in part:
        part.say("surface.off_map", "error")
        part.say("surface.along", "plane" if m.rows > 1 else "x")
        part.field = tuple(f * s for f, s in zip(m.field, (1, 1, 1, 1)))
    elif part.chance(0.3):
        part.choose("surface.off_map", ["mirror", "wrap"])
    if m.columns >= 64 and part.chance(0.2):
        part.open("surface.continuation")
        part.draw("surface.continuation.from", 4 * m.pitch, 8 * m.pitch)
        part.draw("surface.continuation.shortest", m.pitch / 5, 2 * m.pitch)


def surface_recipe(part):
    lines = ["title: made", f"roughness: {{rms: {part.rng.uniform(0.1, 5):.3g} um}}"]
    if part.chance(0.5):
        lines.append("grit: {density: 1 /mm^2, diameter: 100 um}")
    part.say("surface.recipe", quoted(inputs.text(part.scene, part.scene.name("recipe", ".yaml"), lines)))


# ------------------------------------------------------------------ how things ring

def response(part, model):
    """What the surface rings like, and so where it may be touched (part.field)."""
    rng, scene = part.rng, part.scene
    kind = rng.choice(["none", "table", "table", "object", "object", "space", "wav", "folder"])
    scene.note(f"surface's response: {kind}")
    if kind == "object":
        thing(part, "surface")
    elif kind == "space":
        part.open("surface.space")
        part.draw("surface.space.from")
        if part.chance(0.4):
            part.draw(rng.choice(["surface.space.to", "surface.space.dimension_to"]))
    elif kind == "table":
        part.field = (0, 0, rng.randint(5, 40) / 100, rng.randint(3, 15) / 50)
        layout = rng.choice(["one", "line", "line", "plane"])
        name, part.shared = inputs.mode_table(scene, part.field, layout, drives=model == "roll_coupled")
        part.say("surface.response", quoted(name))
        within(part, layout)
    elif kind == "wav":
        part.say("surface.response", quoted(inputs.impulse_response(scene)))
    elif kind == "folder":
        part.field = (0, 0, 0.1, 0.05)
        part.say("surface.response", quoted(inputs.folder_of_responses(scene, part.field)))
        part.say("surface.extrapolate", "nearest")
    if kind in ("table", "object", "space") and part.chance(0.15):
        scene.note("residual")
        part.say("surface.residual", quoted(inputs.residual(scene)))
        part.sprinkle(("surface.residual",), p=0.4)


def within(part, layout):
    """The field shrinks to where the table has places, unless what lies beyond rings, too."""
    x0, y0, x1, y1 = part.field
    if part.chance(0.3):
        part.choose("surface.extrapolate", ["nearest"])
    elif layout == "line":
        part.field = (x0, (y0 + y1) / 2, x1, (y0 + y1) / 2)


def thing(part, body):
    """An object of simple shape, and its material."""
    rng, o = part.rng, f"{body}.object"
    shape = part.choose(f"{o}.shape", ["bar", "rod", "string", "plate", "disk", "membrane", "drum", "shell"])
    part.open(o)
    part.scene.note(f"object: {shape}")
    size = rng.uniform(0.05, 0.5) if body == "surface" else rng.uniform(0.02, 0.2)
    thin = size * math.exp(rng.uniform(math.log(0.003), math.log(0.03)))
    sizes = {"bar": {"length": size, "width": size / 10, "thickness": thin},
        "rod": {"length": size, "diameter": 2 * thin}, "string": {"length": size, "diameter": thin / 20},
             "plate": {"length": size, "width": size * rng.uniform(0.3, 1), "thickness": thin},
             "disk": {"diameter": size, "thickness": thin},
             "membrane": {"length": size, "width": size * rng.uniform(0.3, 1), "thickness": thin / 20},
             "drum": {"diameter": size, "thickness": thin / 20}, "shell": {"diameter": size, "thickness": thin}}[shape]
    for name, metres in sizes.items():
        if part.chance(part.scene.wild):
            part.draw(f"{o}.{name}")
        else:
            part.length(f"{o}.{name}", metres)
    if shape == "string":
        part.draw(f"{o}.tension", 10, 200)
    if shape in ("membrane", "drum"):
        part.draw(f"{o}.surface_tension", 100, 5000)
    if shape in ("bar", "rod"):
        part.choose(f"{o}.edges", [None, "free", "supported", "clamped", "cantilever"])
        part.choose(f"{o}.waves", [None, None, "bending", "longitudinal"])
    elif shape in ("plate", "disk"):
        part.choose(f"{o}.edges", [None, "free", "supported", "clamped"])
    if f"{body}.material" in part.given:
        pass
    elif part.chance(0.7):
        part.choose(f"{body}.material", MATERIALS)
    else:
        if part.chance(0.5):
            part.say(f"{body}.material", "custom")
        for name in ("density", "youngs_modulus", "poisson", "loss"):
            part.draw(f"{o}.{name}")
    if body == "surface":
        if part.chance(0.3):
            part.say("surface.extrapolate", "nearest")
        round_ = shape in ("disk", "drum", "shell")
        half = size * 0.3
        part.field = (-half, -half, half, half) if round_ else (0, 0, size, sizes.get("width", 0))


def tool_response(part, tool):
    kind = part.rng.choice(["none", "none", "table", "wav", "object"])
    if kind == "table":
        part.say(f"{tool}.response", quoted(inputs.mode_table(part.scene, (0, 0, 0.1, 0), "one")[0]))
    elif kind == "wav":
        part.say(f"{tool}.response", quoted(inputs.impulse_response(part.scene)))
    elif kind == "object":
        thing(part, tool)
    part.scene.note(f"{tool}'s response: {kind}")


# ------------------------------------------------------------------ motions

def motion(part, model):
    """A path within the field, short enough for the time it lasts."""
    rng = part.rng
    thin = part.field[3] - part.field[1] < 1e-6
    paths = ["back_and_forth", "line", "four_in_line"] + ["circle", "scribble", "polyline", "spline",
        "recorded"] * (not thin)
    if model in ("strike", "given", "impacts", "roll_coupled"):
        paths.append("still")
    if model != "given" and getattr(part, "load", None) != "grip":
        paths.append("incline")
    path = part.say("motion.path", rng.choice(paths))
    law = part.choose("motion.law", LAWS[path])
    part.lasts = part.draw("motion.duration") if path not in ("incline",
        "recorded") and law != "given" else math.exp(rng.uniform(math.log(0.02), math.log(0.2)))
    box = Box(part, min(part.lasts, 1) * math.exp(rng.uniform(math.log(5e-3), math.log(1))))
    PATHS[path](part, box, law)
    part.scene.note(f"motion: {path}, {law or 'auto'}")
    if law == "given":
        speed = inputs.wave(rng, 0, 0.7 * min(box.width, box.height or box.width) / part.lasts, part.lasts)
        rows = [[t, max(0.0, speed(t))] for t in inputs.rising(rng, part.lasts, 0.01)]
        part.lasts = rows[-1][0]
        part.say("motion.profile", quoted(inputs.table(part.scene, "speeds", ["time_s", "speed_m_per_s"], rows)))
    elif path in ("line", "four_in_line", "circle", "polyline", "spline") and part.chance(0.3):
        del part.given["motion.duration"]
        part.draw("motion.speed", box.way / part.lasts, box.way / part.lasts)
    if getattr(part, "load", None) == "recorded":
        force = inputs.wave(rng, rng.choice([-0.2, 0.1]), 3, part.lasts)
        rows = [[t, force(t)] for t in inputs.rising(rng, max(part.lasts, 0.2) * 1.2, 0.01)]
        part.say("load.recorded", quoted(inputs.table(part.scene, "forces", ["time_s", "normal_force_n"], rows)))


class Box:
    """Somewhere within the field, as large as a way of so many metres has room in."""

    def __init__(self, part, way):
        self.rng = part.rng
        x0, y0, x1, y1 = part.field
        margin = 0.05
        x0, x1, y0, y1 = x0 + margin * (x1 - x0), x1 - margin * (x1 - x0), y0 + margin * (y1 - y0), y1 - margin * (
            y1 - y0)
        self.width, self.height = min(way, x1 - x0) / 2, min(way, y1 - y0) / 2
        self.x, self.y = self.rng.uniform(x0, x1 - self.width), self.rng.uniform(y0, y1 - self.height)
        self.way = max(self.width, self.height, 1e-6)

    def place(self):
        return self.rng.uniform(self.x, self.x + self.width), self.rng.uniform(self.y, self.y + self.height)

    def middle(self):
        return self.x + self.width / 2, self.y + self.height / 2

    def stroke(self, part):
        part.point("motion.from", self.x, self.rng.uniform(self.y, self.y + self.height))
        part.point("motion.to", self.x + self.width, self.rng.uniform(self.y, self.y + self.height))


def back_and_forth(part, box, law):
    box.stroke(part)
    if law != "given":
        part.draw("motion.rate", 0.5 / part.lasts, 3 / part.lasts)


def line(part, box, law):
    box.stroke(part)


def four_in_line(part, box, law):
    box.stroke(part)
    if part.chance(0.5):
        part.draw("motion.strokes", 1, 6)


def circle(part, box, law):
    part.point("motion.center", *box.middle())
    part.length("motion.radius", max(1e-4, min(box.width, box.height) / 2.1))
    if part.chance(0.5):
        part.draw("motion.turns", *part.rng.choice([(0.3, 3), (-3, -0.3)]))
    if part.chance(0.3):
        part.draw("motion.start_angle")


def scribble(part, box, law):
    part.point("motion.center", *box.middle())
    part.point("motion.size", max(box.width, 1e-4), max(box.height, 1e-4))
    part.draw("motion.rate", 0.5 / part.lasts, 3 / part.lasts)


def points(part, box, law):
    n = part.rng.randint(2, 6)
    part.say("motion.points", "[" + ", ".join("[%.6g, %.6g]" % box.place() for _ in range(n)) + "]")


def polyline(part, box, law):
    points(part, box, law)
    if part.chance(0.4):
        part.draw("motion.corner", 1e-5, max(1e-5, box.way / 100))


def recorded(part, box, law):
    rng = part.rng
    x, y = inputs.wave(rng, box.x, box.x + box.width, part.lasts), inputs.wave(rng, box.y, box.y + box.height,
        part.lasts)
    rows = [[t, x(t), y(t)] for t in inputs.rising(rng, part.lasts, rng.choice([1e-3, 5e-3]))]
    part.say("motion.file", quoted(inputs.table(part.scene, "positions", ["time_s", "x_m", "y_m"], rows)))
    if part.chance(0.4):
        part.draw("motion.cutoff")
    if law and law not in ("auto", "given") or law != "given" and part.chance(0.2):
        part.draw("motion.duration", part.lasts * 0.3, part.lasts * 0.9)


def still(part, box, law):
    part.point("motion.at", *box.place())


def incline(part, box, law):
    box.stroke(part)
    part.draw("motion.start_speed", box.way / part.lasts * 0.5, box.way / part.lasts * 2)
    if part.chance(0.5):
        part.draw("motion.incline", -0.5, 0.3)
    if part.chance(0.5):
        part.draw("motion.rolling_friction", 1e-4, 0.1)


PATHS = {"back_and_forth": back_and_forth, "line": line, "four_in_line": four_in_line, "circle": circle,
    "scribble": scribble, "polyline": polyline, "spline": points, "recorded": recorded,
         "still": still, "incline": incline}


# ------------------------------------------------------------------ what is written, and how accurately

def output(scene):
    rng, part = scene.rng, scene.top
    bodies = [body for body in ("surface", "scraper", "ball") for c in scene.contacts if rings(c, body)]
    quantity = "force" if not bodies or rng.random() < 0.15 else None
    kinds = {rings(c, body) for c in scene.contacts for body in ("surface", "scraper", "ball")}
    recorded, mixed = "recorded" in kinds, "table" in kinds and kinds & {"object",
        "space"} and scene.quantity != "velocity"
    if quantity:
        part.say("output.quantity", quantity)
    elif mixed and not recorded or not recorded and rng.random() < 0.4:
        quantity = part.choose("output.quantity", ["displacement", "velocity", "acceleration"] + ["auto"] * (not mixed))
    objects = [c for c in scene.contacts if "surface.object" in c]
    spaces = any("surface.space" in c for c in scene.contacts)  # how large they are is not said
    if quantity in (None, "auto") and not recorded and not spaces and rng.random() < (0.5 if objects else 0.3):
        listen(part, objects if len(objects) == len(scene.contacts) else [])
    level = rng.choice([None, None, "full_scale", "peak", "rms", "lufs", "dbfs_at_1_pa"])
    if level == "lufs":
        part.draw("output.tail", 0.4, 0.5)  # it needs 0.4 s of sound
    if level and (level != "dbfs_at_1_pa" or "output.listen.places" in part):
        part.draw(f"output.level.{level}", *{"peak": (-60, 0), "rms": (-70, -20), "lufs": (-70, -20)}.get(level, ()))
    part.choose("output.encoding", [None, "pcm16", "pcm24", "float32", "float32", "float64", "float64"])
    if rng.random() < 0.4:
        part.draw("output.sample_rate", *rng.choice([(16000, 48000), (16000, 48000), (8000, 768000)]))
    silent = any("ablation.sound" in c.given or f"{body}.weight" in c.given or "gain" in c.given
        for c in scene.contacts for body in ("scraper", "ball"))
    if rng.random() < 0.3 and (not silent or rng.random() < 0.1):
        stems = sorted({"force", *([] if quantity == "force" else bodies)})
        part.say("output.stems", "[" + ", ".join(rng.sample(stems, rng.randint(1, len(stems)))) + "]")
    if rng.random() < 0.6 or not bodies and quantity != "force":
        part.open("output.diagnostics")
        part.draw("output.diagnostics.rate", 10, 8000)
        if rng.random() < 0.2:
            part.say("output.diagnostics.columns", "["
                + ", ".join(rng.sample(["time_s", "x_m", "y_m", "stroke_m", "speed_m_per_s", "force_rms_n",
                "force_peak_n", "force_mean_n"], 3)) + "]")
    if any(c.given.get("contact.model") == "impacts" for c in scene.contacts) and rng.random() < 0.5:
        part.choose("output.impacts", ["table", "table", "none"])
    if rng.random() < 0.8 and "output.tail" not in part:
        part.draw("output.tail")
    if rng.random() < 0.1:
        part.draw("output.duration")
    part.sprinkle(("output.ramp", "output.envelope", "output.diagnostics",
        *(["output.channels"] if "output.listen.places" not in part else []), "output.listen"), p=0.15)


def listen(part, objects):
    part.open("output.listen")
    flat = objects and all(c.given.get("surface.object.shape") in ("plate", "disk", "membrane", "drum") for c in objects)
    radiator = part.choose("output.listen.radiator", [None, "monopole", "contact"] + ["point", "point"] * bool(objects)
        + ["plate", "plate"] * bool(flat))
    part.scene.note(f"listening: {radiator or 'monopole'}")
    if radiator == "contact":
        return
    rng = part.rng
    if radiator == "point":
        x0, y0, x1, y1 = objects[0].field
        spots = [(rng.uniform(0.9 * x0 + 0.1 * x1, x1), rng.uniform(0.9 * y0 + 0.1 * y1, y1), 0)
            for _ in range(rng.randint(1, 3))]
    else:
        spots = [(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.1, 2)) for _ in range(rng.randint(1, 4))]
    part.say("output.listen.places", "[" + ", ".join("[%.4g, %.4g, %.4g]" % s for s in spots) + "]")


def accuracy(scene):
    rng, part = scene.rng, scene.top
    presets = ["draft", "standard", "high", "reference"]
    kind = rng.choices(["none", "word", "map", "error"], [5, 3, 3, 1])[0]
    if kind == "word":
        part.say("accuracy", rng.choices(presets, [4, 3, 2, 1])[0])
    elif kind == "map":
        if rng.random() < 0.5:
            part.say("accuracy.preset", rng.choices(presets, [4, 3, 2, 1])[0])
        for key in scene.keys.all.values():
            knob = key.path.startswith("accuracy.") and key.low is not None and key.path != "accuracy.error"
            if knob and rng.random() < 0.3:
                part.draw(key.path)
    elif kind == "error":
        part.say("accuracy.error", rng.choice(["%.3g dB", "%.4g"]) % rng.uniform(-90, -20))
        scene.note("accuracy.error")

#!/usr/bin/env python3
"""rasp from Python: scenes as dictionaries, sweeps, tables and manifests as lists. The standard library is all it takes.

    import rasp
    scene = {"surface": {"roughness": {"rms": "4 um"}, "material": "oak", "object": {"shape": "plate", "length": "16 cm", "width": "10 cm",
             "thickness": "1.2 mm"}}, "scraper": {"mass": "20 g"}, "motion": {"path": "line", "from": ["1 cm", "5 cm"], "to": ["9 cm", "5 cm"], "duration": "1 s"}}
    sound = rasp.render(scene, "out/scrape.wav")
    for sound in rasp.sweep(scene, "out", {"surface.material": ["oak", "glass"], "motion.duration": ["1 s", "0.5 s"]}):
        print(sound["name"], sound["sound"]["rms"])

Every sound is made by the program `rasp`, which must be on the PATH (or named by the environment's RASP); nothing is computed here. What rasp refuses raises
RaspError, with its words and its exit code.

    scripts/rasp.py scene.json sound.wav      # from a shell: renders a scene written as JSON
"""
import csv
import itertools
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path


class RaspError(RuntimeError):
    """What rasp said, its exit code (`code`), and its errors as dictionaries (`errors`: message, file, line, column, help)."""

    def __init__(self, text, code, errors):
        super().__init__(text)
        self.code, self.errors = code, errors


def run(*words, text=None):
    """Runs rasp with these words; what it printed."""
    done = subprocess.run([os.environ.get("RASP", "rasp"), *map(str, words)], input=text, capture_output=True, text=True, check=False)
    if done.returncode:
        errors = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
        words = "\n".join(e["message"] for e in errors if e.get("severity") == "error") or done.stderr.strip()
        raise RaspError(words, done.returncode, errors)
    return done.stdout


def scene_text(scene):
    """A scene as text for rasp: JSON is YAML. "rasp": 1 is added where it is missing."""
    return json.dumps({"rasp": 1, **scene}, indent=1)


def render(scene, to, sets=None, seed=None):
    """Renders a scene (a dictionary, or the name of a file) to a WAV, and what else the scene asks for beside it. sets: {"motion.rate": "2 Hz"}, laid over it.
    Returns rasp's summary: level, files, warnings, times."""
    words = ["render", "--json", "--diagnostics=json", "-o", to]
    for key, value in (sets or {}).items():
        words += ["--set", f"{key}={value if isinstance(value, str) else json.dumps(value)}"]
    if seed is not None:
        words += ["--seed", seed]
    if not isinstance(scene, dict):
        return json.loads(run(*words, scene))
    # Names of files in the dictionary start at the working folder, as in all that comes through a pipe.
    return json.loads(run(*words, "/dev/stdin", text=scene_text(scene)))


def sweep(scene, folder, keys, name=None):
    """Renders every combination of the keys' values into the folder; gives the summary of each, with its "name" and its "keys". name: a function of the
    dictionary of keys; else values joined by _."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for values in itertools.product(*keys.values()):
        sets = dict(zip(keys, values))
        own = name(sets) if name else "_".join(str(v).replace(" ", "").replace("/", "_") for v in values)
        yield {**render(scene, Path(folder) / f"{own}.wav", sets), "name": own, "keys": sets}


def batch(design, folder, *options):
    """Renders the set of a design (a dictionary, or a file) into the folder; gives its manifest. A dictionary's base is seen from the working folder."""
    if not isinstance(design, dict):
        run("batch", design, "-o", folder, "-q", "--diagnostics=json", *options)
        return manifest(folder)
    with tempfile.NamedTemporaryFile("w", suffix=".yaml", dir=".", prefix=".design-", delete=False) as f:
        f.write(json.dumps({"rasp-design": 1, **design}))
    try:
        run("batch", f.name, "-o", folder, "-q", "--diagnostics=json", *options)
    finally:
        os.unlink(f.name)
    return manifest(folder)


def table(path):
    """A CSV of rasp's as a list of dictionaries: numbers where they are numbers, None where there is nothing; lines that begin with # are left out."""
    with open(path, newline="", encoding="utf-8") as f:
        return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(line for line in f if not line.startswith("#"))]


def manifest(folder):
    """The manifest of a set: a row for each stimulus."""
    return table(Path(folder) / "manifest.csv")


def number(text):
    """A cell: 17 digits and more, as seeds have, stay text."""
    if text in ("", "n/a", None):
        return None
    try:
        return int(text) if len(text) < 17 else text
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as given:
        try:
            print(json.dumps(render(json.load(given), sys.argv[2])["sound"], indent=1))
        except RaspError as error:
            print(error, file=sys.stderr)
            sys.exit(error.code)

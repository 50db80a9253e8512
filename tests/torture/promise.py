#!/usr/bin/env python3
"""accuracy.error on random scenes: is it held, and what does choosing cost?

    tests/torture/promise.py --scenes 200 --seed 1          # scenes 0 to 199, asked for -40, -60, -80 or -100 dB in turn
    tests/torture/promise.py --scenes 200 --preset standard # as a preset has it

A scene of tests/torture that takes at most --limit CPU seconds is rendered with --verify: against itself with every knob twice as
fine or finer. Prints a line of each that misses by more than 0.5 dB, and a summary."""
import argparse
import json
import multiprocessing
import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import recipes
from keys import Keys


def one(k):
    folder = Path(tempfile.mkdtemp(prefix="rasp-promise-"))
    try:
        scene = recipes.make(KEYS, random.Random(f"{OPTIONS.seed}:{k}"), folder, OPTIONS.rasp)
        asked = (-40, -60, -80, -100)[k % 4]
        top = scene.top.given
        for path in [p for p in top if p.startswith(("accuracy", "output.level", "output.encoding", "output.tail", "output.duration"))]:
            del top[path]
        top["accuracy"] = OPTIONS.preset or "{error: %d dB}" % asked
        top["output.encoding"], top["output.level"] = "float64", "{full_scale: 1e6}"
        scene.texts = {}
        scene.write()
        for name, text in scene.texts.items():
            (folder / name).write_text(text)
        result = {"scene": k, "asked": asked, "model": model(scene)}
        try:
            done = subprocess.run([OPTIONS.rasp, "render", "scene.yaml", "-f", "--json", "--verify", "-o", "x.wav"],
                                  cwd=folder, capture_output=True, text=True, timeout=OPTIONS.limit)
        except subprocess.TimeoutExpired:
            return {**result, "what": "slow"}
        if done.returncode and "is not kept" not in done.stderr:
            return {**result, "what": "refused" if "cannot be promised" in done.stderr else "invalid", "text": done.stderr[-300:]}
        d = json.loads(done.stdout)
        by = d["accuracy"]
        return {**result, "what": "rendered", "measured": by.get("measured_db"), "predicted": by.get("predicted_db"), "knobs": {p["knob"]: p["value"] for p in by.get("by", [])},
                "choosing": by.get("cpu_s"), "cpu": d["cpu_s"]}
    finally:
        shutil.rmtree(folder)


def model(scene):
    return "+".join(sorted({c.given.get("contact.model", "scrape") for c in scene.contacts}))


if __name__ == "__main__":
    top = Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seed", default="promise")
    options.add_argument("--scenes", type=int, default=100)
    options.add_argument("--first", type=int, default=0)
    options.add_argument("--preset")
    options.add_argument("--limit", type=float, default=20)
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--rasp", default=str(top / "build/rasp"))
    OPTIONS = options.parse_args()
    KEYS = Keys(OPTIONS.rasp)
    with multiprocessing.Pool(OPTIONS.jobs) as pool:
        for r in pool.imap(one, range(OPTIONS.first, OPTIONS.first + OPTIONS.scenes)):
            print(json.dumps(r), flush=True)

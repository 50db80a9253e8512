#!/usr/bin/env python3
"""What rasp plan says that random scenes cost, beside what they do.

    evidence/planned_random.py [--seeds 1,2,3] [--scenes 150] [--runs 3] [--before RASP] [--read FILE]... [--write FILE]

Scenes of tests/torture, without faults, are planned with --measure: planned over measured cycles of the whole render, CPU time; of the runs that
which took least (a render of more than 0.3 s is run once). A scene that is refused, or takes longer than --limit seconds, does not count.
--before: another program, whose cycles_per_sample times all samples are what it says of the whole. --write keeps what was found, --read shows it."""
import argparse
import json
import random
import math
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/torture"))
import recipes
from keys import Keys

OWN = ("output.level", "output.encoding", "output.tail", "output.duration")  # keys that are put in place
LONG = 0.3  # s


def write(keys, name, folder, rasp):
    """False: the generator's own files clash."""
    try:
        scene = recipes.make(keys, random.Random(name), folder, rasp)
    except (subprocess.CalledProcessError, FileExistsError):
        return False
    top = scene.top.given
    for path in [p for p in top if p.startswith(OWN)]:
        del top[path]
    top["output.encoding"], top["output.level"] = "float64", "{full_scale: 1e6}"
    scene.texts = {}
    scene.write()
    for file, text in scene.texts.items():
        (folder / file).write_text(text)
    return True


def plan(rasp, folder, *words):
    done = subprocess.run([rasp, "plan", "--json", *words, "scene.yaml"], cwd=folder, capture_output=True, text=True, timeout=OPTIONS.limit)
    return json.loads(done.stdout)[0] if done.returncode == 0 else None


def measured(name, folder):
    """None: it is refused."""
    best = None
    for _ in range(OPTIONS.runs):
        one = plan(OPTIONS.rasp, folder, "--measure")
        if one is None:
            return None
        if best is None or one["measured"]["cycles"] < best["measured"]["cycles"]:
            best = one
        if one["measured"]["cpu_s"] > LONG:
            break
    before = plan(OPTIONS.before, folder) if OPTIONS.before else None
    result = {"scene": name, "planned": best["cycles"], "measured": best["measured"]["cycles"],
              "before": sum(c["cycles_per_sample"] for c in before["contacts"]) * best["samples"] if before else None, "parts": []}
    for c in best["contacts"]:
        for s in c["stages"]:
            if "measured_once" in s:
                result["parts"].append([s["name"] + ", once", s["cycles_once"], s["measured_once"]])
                result["parts"].append([s["name"], s["cycles_per_sample"] * s["samples"], s["measured_per_sample"] * s["samples"]])
    for b in best["in_no_stage"]:
        result["parts"].append([b["does"], b["cycles_once"] + b["cycles_per_sample"] * best["samples"], b["measured"]])
    return result


def share(values, part):
    values = sorted(values)
    return values[min(len(values) - 1, int(part * len(values)))]


def row(what, ratios):
    quantiles = " | ".join(f"{share(ratios, q):.2f}" for q in (0.05, 0.1, 0.5, 0.9, 0.95))
    print(f"| {what} | {len(ratios)} | {quantiles} | {100 * sum(0.5 <= r <= 2 for r in ratios) / len(ratios):.1f} % |")


def others(result, which):
    """Cycles of all but choosing, planned (1) or measured (2)."""
    return sum(part[which] for part in result["parts"] if part[0] != "choosing the knobs")


def report(results, left):
    print("| planned over measured | scenes | 5 % | 10 % | median | 90 % | 95 % | within a factor of 2 |\n|---|---|---|---|---|---|---|---|")
    if all(r["before"] is not None for r in results):
        row("before", [r["before"] / r["measured"] for r in results])
    for seed in sorted({r["scene"].split(":")[0] for r in results}):
        row(f"now, seed {seed}", [r["planned"] / r["measured"] for r in results if r["scene"].startswith(seed + ":")])
    row("now, all", [r["planned"] / r["measured"] for r in results])
    row("now, all, but for choosing the knobs", [others(r, 1) / others(r, 2) for r in results])
    if left:
        print("\nNot counted: " + ", ".join(f"{n} {why}" for why, n in left.most_common()) + ".")
    print("\n| the worst twenty | planned over measured | million cycles | of which is off most | planned | measured |\n|---|---|---|---|---|---|")
    for r in sorted(results, key=lambda r: -abs(math.log(r["planned"] / r["measured"])))[:20]:
        name, by, was = max(r["parts"], key=lambda p: abs(p[1] - p[2]))
        print(f"| {r['scene']} | {r['planned'] / r['measured']:.2f} | {r['measured'] / 1e6:.1f} | {name} | {by / 1e6:.1f} | {was / 1e6:.1f} |")


def main():
    results, left = [], Counter()
    for file in OPTIONS.read:
        kept = json.loads(Path(file).read_text())
        results, left = results + kept["results"], left + Counter(kept["left"])
    keys = None if OPTIONS.read else Keys(OPTIONS.rasp)
    for name in [] if OPTIONS.read else [f"{seed}:{k}" for seed in OPTIONS.seeds.split(",") for k in range(OPTIONS.scenes)]:
        with tempfile.TemporaryDirectory(prefix="rasp-planned-") as folder:
            folder = Path(folder)
            try:
                one = measured(name, folder) if write(keys, name, folder, OPTIONS.rasp) else None
            except subprocess.TimeoutExpired:
                left[f"that took more than {OPTIONS.limit:g} s"] += 1
                continue
        if one:
            results.append(one)
        else:
            left["refused"] += 1
    if OPTIONS.write:
        Path(OPTIONS.write).write_text(json.dumps({"results": results, "left": left}))
    report(results, left)


if __name__ == "__main__":
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--rasp", default=str(ROOT / "build/rasp"))
    options.add_argument("--before", help="a program to plan with, too")
    options.add_argument("--seeds", default="1,2,3")
    options.add_argument("--scenes", type=int, default=150)
    options.add_argument("--runs", type=int, default=3)
    options.add_argument("--limit", type=float, default=60)
    options.add_argument("--read", action="append", default=[])
    options.add_argument("--write")
    OPTIONS = options.parse_args()
    main()

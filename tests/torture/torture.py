#!/usr/bin/env python3
"""Random scenes over the whole legal range, a part of them with a fault planted, held to what the program promises of
every scene: README.md of tests/ says what.

    tests/torture/torture.py --scenes 2000                        # seed 1, scenes 0 to 1999, two at a time
    tests/torture/torture.py --seconds 60 --sanitized build/sanitize/rasp
    tests/torture/torture.py --seed 1 --scene 321 --keep folder   # one of them, its files and what was said kept
"""
import argparse
import json
import multiprocessing
import random
import re
import resource
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path
from queue import Empty

sys.dont_write_bytecode = True  # the source tree stays as it is
import faults
import recipes
from checks import Judge
from keys import Keys



def one(k):
    """Scene k of the seed, a function of the two alone: made, judged, and what came of it."""
    folder = Path(OPTIONS.keep or tempfile.mkdtemp(prefix="rasp-torture-"))
    folder.mkdir(exist_ok=True)
    rng, before = random.Random(f"{OPTIONS.seed}:{k}"), cpu()
    programs = {"rasp": OPTIONS.rasp}
    if OPTIONS.sanitized and k % OPTIONS.every == OPTIONS.every - 1:
        programs["sanitized"] = OPTIONS.sanitized
    try:
        scene = recipes.make(KEYS, rng, folder, OPTIONS.rasp)
        fault = faults.plant(scene) if rng.random() < OPTIONS.faults else None
        if fault:
            fault()
        for name, text in scene.texts.items():
            (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        judge = Judge(scene, programs, OPTIONS.limit, OPTIONS.memory << 20)
        judge.judge()
    finally:
        if not OPTIONS.keep:
            shutil.rmtree(folder)
    said = {"name"} if len(scene.contacts) > 1 else set()
    said |= {p for p, _ in scene.given()} | {f"{p}: {t}" for p, t in scene.given() if KEYS.all.get(p)
        and KEYS.all[p].words}
    return {"scene": k, "findings": judge.findings, "slow": judge.slow, "refusal": judge.refusal,
        "accepted": judge.accepted, "planted": scene.planted, "cpu": cpu() - before,
            "covered": sorted(said) if judge.accepted else [], "notes": sorted(scene.notes) if judge.accepted else []}


def cpu():
    """CPU seconds of the commands that this worker ran."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def all_there_is():
    """Every key and every word of a choice: what is to be accepted in some scene."""
    for key in KEYS.all.values():
        yield key.path
        yield from (f"{key.path}: {word}" for word in key.words)


def report(results, seconds):
    """The whole run in Markdown."""
    accepted, planted = [r for r in results if r["accepted"]], [r for r in results if r["planted"]]
    covered = {c for r in results for c in r["covered"]} | {"include" for r in results if "include" in r["notes"]}
    everything = list(all_there_is())
    never = [c for c in everything if c not in covered]
    dearest = ", ".join(f"{r['scene']} ({r['cpu']:.0f} s)" for r in sorted(results, key=lambda r: -r["cpu"])[:5])
    print(f"\nScenes: {len(results)} of seed {OPTIONS.seed}, {len(accepted)} rendered, {len(planted)} with a fault "
          f"planted, in {seconds:.0f} s ({sum(r['cpu'] for r in results):.0f} s of CPU time; the dearest: {dearest}).")
    print(f"Keys and words accepted in some scene: {len(everything) - len(never)} of {len(everything)}. "
          f"Never: {', '.join(never) or 'none'}.")
    for title, counts in (("refused, by exit code", Counter(f"{r['refusal'][0]}" for r in results if r["refusal"])),
                          ("refusals without a fault planted, the most frequent",
                          Counter(bare(r["refusal"][1]) for r in results if r["refusal"] and not r["planted"])),
                          ("faults planted, and refused", Counter(r["planted"] for r in planted if r["refusal"])),
                          ("faults planted, and accepted", Counter(r["planted"] for r in planted if r["accepted"])),
                          ("what accepted scenes had", Counter(n for r in results for n in r["notes"])),
                          ("over the limit of CPU time", Counter(s for r in results for s in r["slow"]))):
        print(f"\n{title}:\n")
        print("\n".join(f"- {n}: {text}" for text, n in counts.most_common(OPTIONS.rows)) or "- none")
    findings = [(r["scene"], f) for r in results for f in r["findings"]]
    print(f"\nFindings: {len(findings)} in {len({k for k, _ in findings})} scenes.\n")
    print("\n".join(f"- {n}: {text}" for text, n in Counter(bare(f) for _, f in findings).most_common()) or "- none")


def bare(text):
    """A message without its numbers and names, so that alike ones are counted together."""
    return re.sub(r"'[^']*'", "'...'", re.sub(r"[-+]?\d[\d.e+-]*", "#", text))[:150]


def main():
    global OPTIONS, KEYS
    top = Path(__file__).resolve().parents[2]
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seed", default="1", help="of all scenes (1)")
    options.add_argument("--scenes", type=int, default=10 ** 9, help="how many")
    options.add_argument("--first", type=int, default=0, help="number of the first")
    options.add_argument("--scene", type=int, help="only this one")
    options.add_argument("--seconds", type=float, default=0, help="begin none after so many seconds")
    options.add_argument("--faults", type=float, default=0.3, help="share of the scenes with a fault planted (0.3)")
    options.add_argument("--limit", type=float, default=20, help="CPU seconds for a command (20)")
    options.add_argument("--memory", type=int, default=4096, help="MiB for a command (4096)")
    options.add_argument("--jobs", type=int, default=2, help="scenes at a time (2)")
    options.add_argument("--rasp", default=str(top / "build/rasp"), help="the program (build/rasp)")
    options.add_argument("--sanitized",
        help="the same with sanitizers: it runs a part of the scenes, too, and must have the same bytes")
    options.add_argument("--every", type=int, default=4, help="of so many scenes one is run by --sanitized, too (4)")
    options.add_argument("--keep", help="folder that keeps the scene's files (with --scene)")
    options.add_argument("--rows", type=int, default=25, help="lines of each list of the report")
    OPTIONS = options.parse_args()
    OPTIONS.rasp, OPTIONS.sanitized = str(Path(OPTIONS.rasp).resolve()), OPTIONS.sanitized and str(Path(
        OPTIONS.sanitized).resolve())
    if OPTIONS.keep and OPTIONS.scene is None:
        options.error("--keep goes with --scene")
    if OPTIONS.scenes == 10 ** 9 and not OPTIONS.seconds and OPTIONS.scene is None:
        options.error("one of --scenes, --seconds, --scene is needed")
    KEYS = Keys(OPTIONS.rasp)
    started, results = time.monotonic(), []
    for r in all_of([OPTIONS.scene] if OPTIONS.scene is not None else range(OPTIONS.first, OPTIONS.first
        + OPTIONS.scenes), started + (OPTIONS.seconds or 1e9)):
        results.append(r)
        for f in r["findings"]:
            print(f"FINDING {f}\n    again: {again(r['scene'])}", flush=True)
        if OPTIONS.scene is not None:
            print(json.dumps(r, indent=1))
    if OPTIONS.scene is None:
        report(results, time.monotonic() - started)
    failed = sum(bool(r["findings"]) for r in results)
    print(f"\n{len(results) - failed} passed, {failed} failed")
    return failed > 0


def again(k):
    """The command that makes a scene once more, and keeps its files."""
    sanitized = f" --sanitized {OPTIONS.sanitized} --every {OPTIONS.every}" if OPTIONS.sanitized else ""
    options = f"--seed {OPTIONS.seed} --scene {k} --limit {OPTIONS.limit:g}{sanitized}"
    return f"tests/torture/torture.py {options} --keep FOLDER"


def all_of(numbers, end):
    """What comes of each scene, as they come; none is begun after `end`. Workers take the next number, so that a slow
    scene holds up nobody."""
    following, queue = multiprocessing.Value("l", 0), multiprocessing.Queue()

    def work():
        while time.monotonic() < end:
            with following.get_lock():
                i, following.value = following.value, following.value + 1
            if i >= len(numbers):
                break
            try:
                queue.put(one(numbers[i]))
            except Exception:  # of the generator itself: told as any finding
                queue.put({"scene": numbers[i], "findings": [f"the generator: {traceback.format_exc()}"], "slow": [],
                    "refusal": None, "accepted": False, "planted": None, "cpu": 0, "covered": [], "notes": []})
        queue.put(None)
    workers = [multiprocessing.Process(target=work) for _ in range(min(OPTIONS.jobs, len(numbers)))]
    for w in workers:
        w.start()
    running = len(workers)
    while running:
        try:
            r = queue.get(timeout=1)
        except Empty:
            if not any(w.is_alive() for w in workers) and queue.empty():
                raise SystemExit("a worker broke off")
            continue
        if r is None:
            running -= 1
        else:
            yield r


if __name__ == "__main__":
    sys.exit(main())

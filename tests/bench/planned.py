"""What rasp plan says that a round tip or a ball over roughness in the plane costs, beside what it does: one Markdown table. Cycles are the CPU time of the contact's stages, the least of REPEATS
rounds, times the core clock, which is measured before each render, over the samples of its motion; start of a motion, which is more than half of a short one, are in both."""
from runs import *
import tempfile

FOLDER = tempfile.TemporaryDirectory(prefix="rasp-bench-")
os.chdir(FOLDER.name)
ROLL, TIP = "contact: {model: roll}\nball: ", "load: {constant: 1 N}\nscraper: "
# name: (roughness, tool, motion)
SCENES = {
    "ball of 5 mm, line, 1 um": ("rms: 1 um", ROLL + "{radius: 5 mm, material: glass}", "path: line, from: [10 cm, 5 cm], to: [13 cm, 5 cm], speed: 10 cm/s"),
    "the same, stiffness given, aslant": ("rms: 1 um", ROLL.replace("roll}", "roll, roll: {stiffness: 1e9 N/m^1.5}}") + "{radius: 5 mm, material: glass}", "path: line, from: [10 cm, 5 cm], to: [14 cm, 8 cm], speed: 25 cm/s"),
    "the same, circle": ("rms: 1 um", ROLL + "{radius: 5 mm, material: glass}", "path: circle, center: [10 cm, 5 cm], radius: 1 cm, turns: 0.5, speed: 10 cm/s"),
    "ball of 1 cm, to and fro, 0.3 um of 50 um and more": ("rms: 0.3 um, shortest: 50 um, longest: 5 mm", ROLL + "{radius: 1 cm, material: glass, patch: 50 um}", "path: back_and_forth, from: [10 cm, 5 cm], to: [14 cm, 6 cm], rate: 1 Hz, duration: 2 s"),
    "ball of 5 mm, slowly, 0.2 um of 10 to 500 um": ("rms: 0.2 um, shortest: 10 um, longest: 0.5 mm", ROLL + "{radius: 5 mm, material: glass, patch: 20 um}", "path: line, from: [10 cm, 5 cm], to: [12 cm, 5.5 cm], speed: 4 cm/s"),
    "ball of 2 cm, 5 um of 100 um and more, patch 100 um": ("rms: 5 um, shortest: 100 um, longest: 5 mm", ROLL + "{radius: 2 cm, material: glass, patch: 100 um}", "path: line, from: [10 cm, 5 cm], to: [20 cm, 6 cm], speed: 50 cm/s"),
    "ball of 5 mm, 1 um, patch 100 um": ("rms: 1 um", ROLL + "{radius: 5 mm, material: glass, patch: 100 um}", "path: line, from: [10 cm, 5 cm], to: [13 cm, 6 cm], speed: 30 cm/s"),
    "ball of 2 mm, 0.1 um of 5 to 200 um": ("rms: 0.1 um, shortest: 5 um, longest: 0.2 mm", ROLL + "{radius: 2 mm, material: glass}", "path: line, from: [10 cm, 5 cm], to: [12 cm, 5.5 cm], speed: 20 cm/s"),
    "tip of 0.5 mm, circle, 3 um": ("rms: 3 um, longest: 1 mm", TIP + "{mass: 20 g, radius: 0.5 mm, patch: 15 um}", "path: circle, center: [15 cm, 0 cm], radius: 5 mm, turns: 2, speed: 6 cm/s"),
    "no tip, line, 5 um": ("rms: 5 um", TIP + "{mass: 20 g}", "path: line, from: [1 cm, 3 cm], to: [39 cm, 6 cm], speed: 20 cm/s"),
    "no tip, circle, 5 um": ("rms: 5 um", TIP + "{mass: 20 g}", "path: circle, center: [10 cm, 5 cm], radius: 2 cm, turns: 8, duration: 5 s"),
    "no tip, to and fro, 5 um": ("rms: 5 um", TIP + "{mass: 20 g}", "path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 1 cm], rate: 1 Hz, duration: 4 s"),
    "no tip, to and fro, 5 um of 50 um and more": ("rms: 5 um, shortest: 50 um", TIP + "{mass: 20 g}", "path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 1 cm], rate: 1 Hz, duration: 4 s"),
    "tip of 2 mm, to and fro, 5 um": ("rms: 5 um", TIP + "{mass: 20 g, radius: 2 mm, patch: 20 um}", "path: back_and_forth, from: [10 cm, 5 cm], to: [13 cm, 5 cm], rate: 2 Hz, duration: 2 s"),
}
SCENES = {name: scene for name, scene in SCENES.items() if os.environ.get("ONLY", "") in name}


def planned(name):
    plan = json.loads(subprocess.run([BUILD + "/rasp", "plan", "--json", name], capture_output=True, text=True, check=True).stdout)[0]
    return sum(s["cycles_once"] + s["cycles_per_sample"] * s["samples"] for s in plan["contacts"][0]["stages"] if s["runs"]) / plan["samples"]


def measured(name):
    clock, _ = yardstick()
    run([BUILD + "/rasp", "render", "-q", name, "-o", "job.wav"])
    with open("job.json") as f:
        told = json.load(f)
    return clock * sum(stage["cpu_s"] for stage in told["contacts"][0]["stages"]) / ((os.path.getsize("job.wav") - 44) / 3)


if __name__ == "__main__":
    print("| roughness in the plane | accuracy | cycles a sample, planned | measured | planned over measured |\n|---|---|---|---|---|")
    for k, (name, (rough, tool, motion)) in enumerate(SCENES.items()):
        for accuracy in ("draft", "high"):
            with open(f"{k}.yaml", "w") as out:
                out.write(f"rasp: 1\nseed: 7\nsurface: {{along: plane, roughness: {{{rough}}}, material: glass, object: {{shape: plate, edges: supported, length: 40 cm, width: 20 cm, thickness: 3 mm}}}}\n{tool}\n"
                          f"motion: {{{motion}}}\naccuracy: {accuracy}\noutput: {{sample_rate: 44.1 kHz, level: {{full_scale: 10}}, ramp: 0, tail: 0}}\n")
            plan, cost = planned(f"{k}.yaml"), min(measured(f"{k}.yaml") for _ in range(REPEATS))
            print(f"| {name} | {accuracy} | {plan:.0f} | {cost:.0f} | {plan / cost:.2f} |", flush=True)

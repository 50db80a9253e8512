# rasp plan --without: each effect of a scene, with the cost of the scene without it, which is that of the plan with its setting.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
scenes=$ROOT/scenes
# said, so that both sides have the same
KNOBS='accuracy.oversampling=4 accuracy.gain_ramp=64 accuracy.contact_steps=200 accuracy.tip_heights=1'
said=()
for knob in $KNOBS; do said+=(--set "$knob"); done
export KNOBS
rasp plan --without "$scenes/rubbing.yaml" | sed 's/^.*rubbing/rubbing/'
for scene in basswood_scrape two_contacts residual_strike eccentric_ball rubbing marble_drop nodal_lines; do
    rasp plan --without --json "$scenes/$scene.yaml" --set output.sample_rate='44.1 kHz' "${said[@]}" > without.json
    python3 - "$scenes/$scene.yaml" << 'END'
import json, os, subprocess, sys
def cycles(settings):
    words = [w for s in os.environ["KNOBS"].split() + settings for w in ("--set", s)]
    plan = json.loads(subprocess.run(["rasp", "plan", "--json", sys.argv[1], "--set", "output.sample_rate=44.1 kHz", *words], capture_output=True, text=True, check=True).stdout)
    return sum(c["cycles_per_sample"] for c in plan[0]["contacts"])
whole, rows = cycles([]), json.load(open("without.json"))[0]["without"]
off = [r["effect"] for r in rows if abs(cycles(r["without"].split("; ")) - r["cycles_per_sample"]) > 1e-9 * whole or abs(whole - r["cycles_per_sample"] - r["more_cycles_per_sample"]) > 1e-9 * whole]
print(sys.argv[1].split("/")[-1] + ":", len(rows), "effects; not as planned:", off)
END
done
# What is measured are times, of which nothing is held but their order.
rasp plan --without --measure --json "$scenes/residual_strike.yaml" > measured.json
python3 -c 'import json; r = [w for w in json.load(open("measured.json"))[0]["without"] if w["effect"] == "residual"][0]; print(r["effect"], r["more_s"] < 1, r["more_quartiles_s"][0] <= r["more_s"] <= r["more_quartiles_s"][1])'
# The whole scene beside its plan: once, a sample, and what is in no stage.
rasp plan --measure --json "$scenes/basswood_scrape.yaml" > whole.json
python3 << 'END'
import json
plan = json.load(open("whole.json"))[0]
stages = [s for c in plan["contacts"] for s in c["stages"] if s["runs"]]
print([b["does"] for b in plan["in_no_stage"]])
print(all(s["cycles_once"] >= 0 and s["measured_once"] >= 0 and s["measured_per_sample"] >= 0 for s in stages))
planned = sum(s["cycles_once"] + s["cycles_per_sample"] * s["samples"] for s in stages) + sum(b["cycles_once"] + b["cycles_per_sample"] * plan["samples"] for b in plan["in_no_stage"])
measured = sum(s["measured_once"] + s["measured_per_sample"] * s["samples"] for s in stages) + sum(b["measured"] for b in plan["in_no_stage"])
print(abs(planned / plan["cycles"] - 1) < 1e-9, abs(measured / plan["measured"]["cycles"] - 1) < 0.02, 0.1 < planned / measured < 10)
END
rasp plan --measure "$scenes/basswood_scrape.yaml" | grep -c '^measured\|^in no stage\|^in all\|^  measured'
ls

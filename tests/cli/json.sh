# plan --json and explain --json hold what the texts hold.
scene=$ROOT/scenes/basswood_scrape.yaml
rasp plan --json "$scene" "$ROOT/scenes/two_contacts.yaml" > plans
rasp plan "$scene" > text
rasp explain --json > keys
rasp explain > reference
python3 - <<'X'
import json, re

plans = json.load(open("plans"))
print([(len(p["contacts"]), [c["name"] for c in p["contacts"]]) for p in plans])
contact = plans[0]["contacts"][0]
text = open("text").read()
runs = re.findall(r"^  ([a-z_]+) +[0-9.]+ %  ", text, re.M)
print(runs == [s["name"] for s in contact["stages"] if s["runs"]], len(runs) > 5)
idle = re.findall(r"^  not run: ([a-z_]+) +(.*)", text, re.M)
print(idle == [(s["name"], s["why_not"]) for s in contact["stages"] if not s["runs"]], len(idle) > 5)
whole = sum(s["cycles_per_sample"] or 0 for s in contact["stages"])
print(f"about {whole:.0f} cycles" in text, abs(whole - contact["cycles_per_sample"]) < 1e-6 * whole)
print("turned by accuracy: " + ", ".join(contact["knobs"]) in text)

keys = json.load(open("keys"))
paths = [k["path"] for k in keys]
print(len(paths) == len(set(paths)), len(paths) > 250)
names = set(re.findall(r"^ *#?([a-z0-9_]+):", open("reference").read(), re.M))
print([p for p in paths if p.split(".")[-1] not in names])
X
rasp explain --json motion.law | head -n 9
rasp explain --json accuracy.oversampling
rasp explain --json surface.grit | grep path
rasp explain --json motion.raet || echo $?
rasp explain --json "$scene" || echo $?
rasp explain --schema=scenes || echo $?

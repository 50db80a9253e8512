# Every scene that ships, and roughness like a map in every use of it: `rasp plan` predicts a number, above 0, for every contact, in text and in JSON.
[ -z "${SANITIZED:-}" ] || { echo "two minutes under sanitizers, where cli/plan-without runs"; exit 77; }
for map in acrylic ridged_plate; do cp "$ROOT/surfaces/$map.gsf" .; done
scene() { printf 'rasp: 1\nsurface: {%s}\n%s\nmotion: {%s}\noutput: {quantity: force}\n' "$2" "$3" "$4" > "$1.yaml"; }
line='path: line, to: [1 cm, 0], duration: 0.1 s'
scene alone 'roughness: {like: acrylic.gsf}' 'scraper: {mass: 10 g}' "$line"
scene pitch 'roughness: {like: acrylic.gsf, like_pitch: 2.5 um}' 'scraper: {mass: 10 g}' "$line"
scene tip 'roughness: {like: acrylic.gsf}' 'scraper: {mass: 10 g, radius: 1 mm}' "$line"
scene paper 'roughness: {like: acrylic.gsf}' 'scraper: {mass: 10 g}
contact: {force: paper}' "$line"
scene playback 'roughness: {like: acrylic.gsf}' '
contact: {model: playback}' "$line"
scene map 'height_map: ridged_plate.gsf, roughness: {like: acrylic.gsf}' 'scraper: {mass: 10 g}' "$line"
scene plane 'roughness: {like: acrylic.gsf}, along: plane' 'scraper: {mass: 10 g}' 'path: circle, radius: 2 mm, duration: 0.1 s'
scene ball 'roughness: {like: acrylic.gsf}' 'ball: {radius: 2 mm, mass: 0.1 g}
contact: {model: roll}' "$line"
cat > two.yaml << 'END'
rasp: 1
contacts:
- {name: like, surface: {roughness: {like: acrylic.gsf}}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0], duration: 0.1 s}}
- {name: plain, surface: {roughness: {}}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0], duration: 0.1 s}}
output: {quantity: force}
END
cat > judge.py << 'END'
import json, math, sys
plans = json.load(open(sys.argv[1]))
want = dict(line.split() for line in open(sys.argv[2]))
for plan in plans:
    name = plan["file"].split("/")[-1]
    names = [c["name"] for c in plan["contacts"]]
    bad = [c["name"] for c in plan["contacts"] if not (math.isfinite(c["cycles_per_sample"]) and (c["cycles_per_sample"] > 0 or not c["targets"]))]
    stages = sum(s["runs"] and not (math.isfinite(s["cycles_per_sample"]) and s["cycles_per_sample"] >= 0) for c in plan["contacts"] for s in c["stages"])
    if bad or stages or len(names) != int(want[name]):
        print(f"{name}: contacts {names}, of which without a number: {bad}; stages without one: {stages}")
print(len(plans) == len(want), len(plans) >= 25)
END
scenes=("$ROOT"/scenes/*.yaml ./*.yaml)
for scene in "${scenes[@]}"; do
    n=$(grep -c '^ *- \(name:\|{name:\)' "$scene") || true
    echo "${scene##*/} $((n > 0 ? n : 1))"
done > contacts
rasp plan --json "${scenes[@]}" > plans.json
python3 judge.py plans.json contacts
rasp plan "${scenes[@]}" > plans.txt
grep -c 'about [1-9][0-9]* cycles' plans.txt | awk '{print ($1 >= 35)}'
! grep -n 'about [^1-9]' plans.txt

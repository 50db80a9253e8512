# A mode that decays with two slopes, beside one that does not: found unasked, as components of one mode and one frequency; the table is read back and rendered.
. "$ROOT/tests/cli/modes-extract-make.inc"
python3 wav.py make slopes.wav 8000 slopes 8000
extract slopes.wav --impulse --scale 1 --quantity displacement --json -o slopes.csv > slopes.json
python3 - << 'PY'
import json
true = {1: [(800, 8, 0.1), (800, 120, 1.0)], 2: [(1500, 30, 0.5)]}
found = json.load(open("slopes.json"))["modes"]
print(len(found), "components of", len({m["mode"] for m in found}), "modes")
for f, d, g in [(800, 120, 1.0), (800, 8, 0.1), (1500, 30, 0.5)]:
    best = min(found, key=lambda m: abs(m["frequency_hz"] - f) + abs(m["decay_per_s"] - d))
    near = abs(best["frequency_hz"] - f) < 0.05 and abs(best["decay_per_s"] / d - 1) < 0.01 and abs(best["places"][0]["gain"] / g - 1) < 0.01
    print(f, "Hz,", d, "1/s: mode", best["mode"], "slope", best["slope"], "within 0.05 Hz, 1 % of decay and gain" if near else best)
PY
grep -v '^#' slopes.csv | head -1
awk -F, '!/^[#p]/ { print $4, $9 }' slopes.csv
rasp modes list slopes.csv | head -3 | cut -c -12
printf '%s\n' 'rasp: 1' 'surface: {response: slopes.csv}' 'scraper: {mass: 1 g}' 'motion: {path: still, duration: 0.2 s}' \
    'contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e5}}' > strike.yaml
rasp render -q strike.yaml

# The report of modes extract, and what stands in the table: the median decay by energy; the recording's name without its folder; places that cannot be compared without a
# force.
. "$ROOT/tests/cli/modes-extract-make.inc"
rasp render -q plate.yaml
python3 wav.py join plate.wav plate.force.wav strikes.wav 1e-6
echo "half of the energy decays more slowly than the median by energy:"
extract strikes.wav --force-channel 2 --json -o energy.csv > energy.json
extract strikes.wav --force-channel 2 -f -o energy.csv | sed -n 's/.*by energy \(.*\) 1.s$/\1/p' > energy.txt
cat > energy.py << 'END'
import json
d = json.load(open("energy.json"))
import math
of = sorted((m["decay_per_s"], m["share"]) for m in d["modes"] if m["decay_per_s"] <= 300)
whole, middle, at, points = sum(e for _, e in of), d["median_decay_by_energy_per_s"], 0, []
for x, e in of: # each mode's decay stands at the middle of its share
    points.append((at + e / 2, math.log(x)))
    at += e
below = max(p for p in points if p[0] <= whole / 2) if points[0][0] <= whole / 2 else points[0]
above = min(p for p in points if p[0] >= whole / 2) if points[-1][0] >= whole / 2 else points[-1]
wanted = below[1] if above == below else below[1] + (above[1] - below[1]) * (whole / 2 - below[0]) / (above[0] - below[0])
print("between the decays on both sides", abs(middle / math.exp(wanted) - 1) < 1e-9,
      "no share below 0, all 1", min(e for _, e in of) >= 0 and abs(sum(m["share"] for m in d["modes"]) - 1) < 1e-6, "physical", d["physical"],
      "printed", abs(float(open("energy.txt").read()) / middle - 1) < 1e-3)
END
python3 energy.py
echo "from another folder the same table and picture:"
python3 wav.py make late.wav 8000 late 8000
words="--impulse --scale 1 --quantity velocity -q"
command -v gnuplot > /dev/null && plot=1 || plot=
mkdir folder
# shellcheck disable=SC2086
extract late.wav $words -o here.csv ${plot:+--plot here.svg}
# shellcheck disable=SC2086
(cd folder && extract "$OLDPWD/late.wav" $words -o ../there.csv ${plot:+--plot ../there.svg})
cmp here.csv there.csv
[ -z "$plot" ] || cmp here.svg there.svg
grep -E '^# (source|note)' there.csv | sed 's/sha256 .*/sha256 ../'
echo "several places without a force:"
sed 's/at: .7 cm/at: [15 cm/' plate.yaml > other.yaml
rasp render -q other.yaml
python3 wav.py join other.wav other.force.wav other_strikes.wav 1e-6
extract strikes.wav@7cm,6cm other_strikes.wav@15cm,6cm --method spectrogram -o places.csv | sed -n '/^warning/,$p'
grep -c 'compared with each other' places.csv
extract strikes.wav --method spectrogram -q -o one.csv
grep -c 'compared with each other' one.csv || true

# Three real objects, struck by hand with a hammer: strikes, delays and modes of each as they are known; ceramic, the hardest, decays at least three times as slowly. Two strikes below
# 4 kHz, which is quick; evidence/extract.sh has all. By the spectrogram's method steel, too.
# Long: see tests/run.sh.
data=$ROOT/../shared/data/impacts
for name in steel ceramic polycarb wood; do
    [ -f "$data/$name.wav" ] || { echo "no recordings of strikes in ../shared/data/impacts"; exit 77; }
done
[ -z "${SANITIZED:-}" ] || { echo "the same code as in cli/modes-extract"; exit 77; } # minutes of it
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
for name in ceramic polycarb wood; do
    rasp modes extract "$data/$name.wav" --force-channel 2 --strikes 2,3 --high 4kHz --modes 12 --json -o $name.csv > $name.json || exit
done
rasp modes extract "$data/steel.wav" --force-channel 2 --method spectrogram --json -o steel.csv > steel.json || exit
# Steel swings: its modes lie up to 1 % apart from strike to strike, and some ring longer than the recording tells.
rasp modes extract "$data/steel.wav" --force-channel 2 --high 2kHz --json -o swings.csv > swings.json || exit
python3 - << 'END'
import json
decay = {}
# name: strikes that are heard, modes that stand out (Hz)
for name, heard, hz in (("ceramic", 8, (2215.5, 2056.2)), ("polycarb", 5, (3372, 1368)), ("wood", 10, (780,))):
    d = json.load(open(name + ".json"))
    p, modes = d["places"][0], d["modes"]
    decay[name] = d["median_decay_by_energy_per_s"]
    good = [len(p["strikes"]) == heard, sum(s["used"] for s in p["strikes"]) == 2, p["explained"] > 0.8, p["predicted"] > 0.4, 0.0001 < p["delay_s"] < 0.002, not d["physical"],
            all(any(abs(m["frequency_hz"] / f - 1) < 0.002 for m in modes) for f in hz), all(m["frequency_se_between"] > 0 for m in modes)]
    print(name, "as known" if all(good) else ("differs", good, p["explained"], p["predicted"], modes[:3]))
d = json.load(open("steel.json"))
print("steel", "as known" if len(d["places"][0]["strikes"]) == 11 and any(abs(m["frequency_hz"] / 1699 - 1) < 0.01 for m in d["modes"]) else d["modes"][:5])
d = json.load(open("swings.json"))
p = d["places"][0]
good = [p["explained"] > 0.95, min(s["explained"] for s in p["strikes"]) > 0.9, all(any(abs(m["frequency_hz"] / f - 1) < 0.002 for m in d["modes"]) for f in (320.5, 889.5, 1699)), any("longer than the strikes show" in w for w in d["warnings"])]
print("steel", "as known" if all(good) else (good, p["explained"]))
print("ceramic < polycarbonate, wood:", max(decay["ceramic"] * 3, 20) < min(decay["polycarb"], decay["wood"]) or decay)
END

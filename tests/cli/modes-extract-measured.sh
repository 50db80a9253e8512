# Four real objects, struck by hand with a hammer: strikes, delays and the strongest mode of each as they are known; the harder the material, the slower its modes decay.
# By the spectrogram's method, which is quick; evidence/extract.sh has both.
data=$ROOT/../shared/data/impacts
for name in steel ceramic polycarb wood; do
    [ -f "$data/$name.wav" ] || { echo "no recordings of strikes in ../shared/data/impacts"; exit 77; }
done
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
for name in steel ceramic polycarb wood; do
    rasp modes extract "$data/$name.wav" --force-channel 2 --method spectrogram --json -o $name.csv > $name.json || exit
done
python3 - << 'END'
import json
decay = {}
# name: strikes that are heard, least that are used, a mode that stands out (Hz)
for name, heard, least, hz in (("steel", 11, 9, 1699), ("ceramic", 8, 6, 2216), ("polycarb", 5, 5, 2651), ("wood", 10, 9, 2302)):
    d = json.load(open(name + ".json"))
    strikes = d["places"][0]["strikes"]
    used, modes = sum(s["used"] for s in strikes), sorted(m["decay_per_s"] for m in d["modes"])
    decay[name] = modes[len(modes) // 2]
    good = [len(strikes) == heard, used >= least, d["places"][0]["explained"] > 0.4, 0.0001 < d["places"][0]["delay_s"] < 0.002, not d["physical"],
            any(abs(m["frequency_hz"] / hz - 1) < 0.01 for m in d["modes"])]
    print(name, "as known" if all(good) else ("differs", good, len(strikes), used, d["places"][0]["explained"], d["modes"][:3]))
print("steel < ceramic < polycarbonate and wood:", decay["steel"] < decay["ceramic"] < min(decay["polycarb"], decay["wood"]) or decay)
END

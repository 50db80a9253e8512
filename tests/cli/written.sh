# What the files hold, told in words, in the summary and in the manifest: silence, also what is rounded to it, and samples beyond full scale; against what Python finds in the files.
cat > zero.yaml << 'END'
rasp: 1
surface: {material: glass, object: {shape: plate, length: 30 cm, width: 20 cm, thickness: 5 mm}}
motion: {path: still, at: [10 cm, 8 cm], duration: 0.1 s}
contact: {model: impacts, impacts: {prototype: rub}}
output: {encoding: pcm16, level: {full_scale: 10000}, tail: 0.1 s}
END
cat > loud.yaml << 'END'
rasp: 1
surface: {roughness: {}, material: steel, modes: 20, object: {shape: bar, length: 30 cm, width: 2 cm, thickness: 1 cm}}
scraper: {mass: 20 g}
motion: {path: line, from: [5 cm, 0], to: [7 cm, 0], duration: 0.1 s}
output: {tail: 0.05 s, sample_rate: 22050}
END
cat > judge.py << 'END'
"""What each WAV holds, and what is said of it in SUMMARY.json (and on standard error, ERR). judge.py BASE ERR: prints what disagrees."""
import json, math, struct, sys

def samples(path):
    d = open(path, "rb").read()
    at, form = 12, None
    while True:
        name, size = d[at:at + 4], struct.unpack("<I", d[at + 4:at + 8])[0]
        body = d[at + 8:at + 8 + size]
        if name == b"fmt ":
            kind, channels, bits = struct.unpack("<HH10xH", body[:16])
        if name == b"data":
            break
        at += 8 + size + size % 2
    if kind == 3:
        x = struct.unpack("<%d%s" % (size * 8 // bits, "f" if bits == 32 else "d"), body)
    else:
        n = bits // 8
        x = [int.from_bytes(body[i:i + n], "little", signed=True) / 2 ** (bits - 1) for i in range(0, size, n)]
    return x, channels

def judge(base, said):
    j = json.load(open(base + ".json"))
    folder = base[:base.rfind("/") + 1]
    warnings = " ".join(j["warnings"])
    for f in j["files"]:
        if not f["name"].endswith(".wav"):
            continue
        x, channels = samples(folder + f["name"])
        force, what = f.get("stem") == "force", "stem " + f["stem"] if "stem" in f else "sound"
        quiet = [k + 1 for k in range(channels) if not any(x[k::channels])]
        silent, beyond = len(quiet) == channels, sum(abs(v) > 1 for v in x)
        told = f"the {what} is silent" in warnings, f"the {what}: {beyond} of {len(x)} samples lie beyond full scale, by up to %.2f dB" % (20 * math.log10(max(map(abs, x)) or 1)) in warnings
        want = silent, beyond > 0 and not force
        facts = f["silent"], f["samples_beyond_full_scale"]
        if told != want or facts != (silent, None if force else beyond):
            print(f"{base}: {f['name']}: silent {silent}, {beyond} beyond full scale; told {told}, {facts}")
        if what == "sound":
            sound = j["sound"]
            if (sound["silent"], sound["samples_beyond_full_scale"]) != (silent, beyond):
                print(f"{base}: sound: {sound}")
            if quiet and not silent and f"channel{'s' * (len(quiet) > 1)} {', '.join(map(str, quiet))} of {channels}" not in warnings:
                print(f"{base}: channels {quiet} of {channels} are silent")
            if channels > 1 and "channels" in sound and [k + 1 for k, c in enumerate(sound["channels"]) if c["silent"]] != quiet:
                print(f"{base}: channels: {sound['channels']}, silent are {quiet}")
    text = open(said).read() if said else ""
    if said and any(w not in text for w in j["warnings"]):
        print(f"{base}: not said: {[w for w in j['warnings'] if w not in text]}")
    return j

if __name__ == "__main__":
    j = judge(sys.argv[1], sys.argv[2])
    print(sys.argv[1], *[w for w in j["warnings"] if "silent" in w or "beyond" in w], sep="\n    ")
END
try() { # NAME SCENE SET...
    local name=$1 scene=$2 set=()
    shift 2
    for key in "$@"; do set+=(--set "$key"); done
    rasp render -q "$scene" "${set[@]}" -o "$name.wav" 2> "$name.err" || { cat "$name.err"; return 1; }
    python3 judge.py "$name" "$name.err"
}
echo "-- as found"
try zero zero.yaml
try beyond loud.yaml output.encoding=float32 output.level.full_scale=1e-6
echo "-- encodings"
try pcm24 zero.yaml output.encoding=pcm24
try pcm24 zero.yaml output.encoding=pcm24 output.level.full_scale=1e5
try float zero.yaml output.encoding=float32
try double loud.yaml output.encoding=float64 output.level.full_scale=1e-5
echo "-- a peak of full scale is not beyond it"
for encoding in pcm16 pcm24 float32 float64; do try peak loud.yaml output.encoding=$encoding 'output.level={peak: 0 dB}'; done
echo "-- stems, and channels"
try stems loud.yaml output.encoding=float32 output.level.full_scale=1e-6 'output.stems=[force, surface]'
try quiet loud.yaml output.encoding=pcm16 output.level.full_scale=1e6 'output.stems=[force, surface]'
try two loud.yaml output.encoding=pcm16 output.level.full_scale=1e6 output.channels=2
echo "-- nothing at all"
printf 'time_s,force_n\n0,0\n0.05,0\n0.1,0\n' > force.csv
cat > still.yaml << 'END'
rasp: 1
surface: {material: glass, object: {shape: plate, length: 30 cm, width: 20 cm, thickness: 2 mm}, modes: 10}
motion: {path: still, at: [10 cm, 8 cm], duration: 0.1 s}
contact: {model: given, given: {file: force.csv}}
END
try still still.yaml
try still still.yaml output.level.full_scale=1
echo "-- listening places, of which one is too far away"
try places zero.yaml output.level.full_scale=1 'output.listen={places: [[10 cm, 10 cm, 30 cm], [0 cm, 0 cm, 1 km], [10 cm, 10 cm, 40 cm]]}'
echo "-- levels around the least step and around full scale"
cat > draw.py << 'END'
import random
draw = random.Random(24)
for i in range(24):
    encoding = draw.choice(["pcm16", "pcm24", "float32", "float64"])
    centre = 1.4e-4 * {"pcm16": 2 ** 16, "pcm24": 2 ** 24}.get(encoding, 1)
    print(encoding, "%.6g" % (centre * 10 ** draw.uniform(-1, 1)))
END
python3 draw.py > drawn
while read -r encoding full_scale; do
    rasp render -q loud.yaml --set output.encoding="$encoding" --set output.level.full_scale="$full_scale" -o drawn.wav 2> drawn.err && python3 judge.py drawn drawn.err
done < drawn > drawn.out || true
grep -v '^drawn$\|^    the sound' drawn.out || true
awk '/is silent/ {s++} /beyond/ {b++} /^drawn$/ {n++} END {print n, (s >= 2), (b >= 2), (n - s - b >= 2)}' drawn.out
echo "-- a set: by its own levels, by a common one, of recordings"
cat > wav.py << 'END'
import struct, sys
x = [float(v) for v in sys.argv[2:]] * 8000
body = struct.pack("<%df" % len(x), *x)
open(sys.argv[1], "wb").write(b"RIFF" + struct.pack("<I", 36 + len(body)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 1, 22050, 88200, 4, 32) + b"data" + struct.pack("<I", len(body)) + body)
END
python3 wav.py hot.wav 1.5 -0.5
python3 wav.py faint.wav 1e-7 -1e-7
python3 wav.py plain.wav 0.5 -0.5
set_of() { # NAME ENCODING LEVEL RECORDING...
    local name=$1
    { printf '%s\n' 'rasp-design: 1' 'base: loud.yaml' "set: {output.encoding: $2}" 'factors: {kind: [{label: loud}, {label: quiet, set: {gain: 1e-6}}, {label: real, of: recordings}]}' \
        "level: {$3}" 'length: own' 'recordings:'
      for recording in "${@:4}"; do echo "- {file: $recording.wav, kind: real, name: $recording}"; done; } > "$name.yaml"
    echo "$name"
    rasp batch -q "$name.yaml" -o "$name" 2>&1 | sed 's/^/    /'
    python3 - "$name" << 'END'
import csv, sys
from judge import samples, judge
for row in csv.DictReader(open(sys.argv[1] + "/manifest.csv")):
    x, _ = samples(sys.argv[1] + "/" + row["file_name"])
    facts, want = (row["silent"], row["samples_beyond_full_scale"]), (str(int(not any(x))), str(sum(abs(v) > 1 for v in x)))
    print("   ", row["stimulus_id"], *facts, *([] if facts == want else [f"but it is {want}"]))
    if row["recording"] == "n/a":
        judge(sys.argv[1] + "/" + row["stimulus_id"], None)
END
}
set_of common pcm16 'common: {peak: -3 dB}' plain
set_of common_loud float32 'common: {rms: 0 dB}' plain
set_of each float64 'each: {rms: 0 dB}' plain
set_of given float32 'common: {full_scale: 1e-5}' hot faint plain
set_of given_small pcm16 'common: {full_scale: 0.01}' faint plain

# A page for a set of stimuli, and for a folder of sounds: what it links is there, pictures have common scales, failures are told.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > page.py << 'END'
# What stands in a page, and whether its files are there. A picture: its size, and its mean step of the palette, from 0 (dark) to 40.
import json, os, re, struct, sys, urllib.parse, zlib
page = sys.argv[1]
text = open(page, encoding="utf-8").read()
assert text.startswith("<!DOCTYPE html>") and text.count("</script>") == 1 and "http" not in text
head, items = re.search(r"^const set = (.*);\nset.items = (\[.*?^\]);$", text, re.S | re.M).groups()
top, items = json.loads(head), json.loads(items.replace(",\n]", "]"))
print(re.search("<h1>.*</h1>", text)[0], "|", " | ".join(top["columns"]))
print("axes: %.4g s, %g to %g Hz, %g dB below %g" % (top["seconds"], top["low"], top["high"], top["range"], top["top"]))
def picture(file):
    data, at, packed = open(file, "rb").read(), 8, b""
    while at < len(data):
        n, kind = struct.unpack(">I4s", data[at : at + 8])
        packed += data[at + 8 : at + 8 + n] if kind == b"IDAT" else b""
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8 : at + 18])
        if kind == b"PLTE":
            colours = data[at + 8 : at + 8 + n]
        at += 12 + n
    raw = zlib.decompress(packed)
    rows = [raw[k * (width + 1) : (k + 1) * (width + 1)] for k in range(height)]
    assert (depth, colour) == (8, 3) and not any(row[0] for row in rows) and len(colours) == 3 * 42
    assert sum(colours[:3]) < 10 and sum(colours[120:123]) > 600
    return width, height, sum(map(sum, rows)) / (width * height), max(map(max, rows))
for item in items:
    print(*filter(None, [item["name"], *item["values"], item.get("text", ""), item.get("why", "")]), end="")
    if "file" in item:
        assert os.path.exists(os.path.join(os.path.dirname(page), urllib.parse.unquote(top["sounds"] + item["file"])))
        width, height, mean, most = picture(os.path.join(os.path.dirname(page), urllib.parse.unquote(top["pictures"] + item["picture"] + ".png")))
        assert width == item["columns"] <= top["width"] and height == top["height"]
        print(" -> %d x %d, mean step %.0f, greatest %d" % (width, height, mean, most), end="")
    print()
END
cat > stroke.yaml << 'END'
rasp: 1
surface: {roughness: {}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0 cm], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 20 ms}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
cat > design.yaml << 'END'
rasp-design: 1
title: Light & heavy
base: stroke.yaml
factors:
  motion.speed: [10 cm/s, 20 cm/s]
  tool:
    - {label: light & small, set: {scraper.mass: 1 g}}
    - {label: heavy, set: {scraper.mass: 50 g}}
END
rasp batch -q design.yaml -o set
rasp plot --gallery set
python3 page.py set/gallery.html
echo "-- the manifest, elsewhere, with a title"
rasp plot -j 1 --gallery set/manifest.csv -o page.html --title 'a <b> & "c"'
python3 page.py page.html | sed -n 1p
cmp page/10cm_s_heavy.png set/gallery/10cm_s_heavy.png
echo "-- stimuli without sound, and some that failed"
sed 's/, response: modes.csv//' stroke.yaml > bare.yaml
cat > forces.yaml << 'END'
rasp-design: 1
base: bare.yaml
level: scene
set: {output.diagnostics.rate: 1 kHz}
factors:
  kind:
    - {label: force, set: {output.diagnostics.format: csv}}
    - {label: npy, set: {output.diagnostics.format: npy}}
    - {label: clips</script>, set: {surface.response: modes.csv, output.level.full_scale: 1e-9}}
END
rasp batch -q forces.yaml -o forces 2> batch.txt || echo "exit $?"
rasp plot --gallery forces
python3 page.py forces/gallery.html | sed 's/frame .*channel 1: .* is .* dB re/... dB re/'
echo "-- a folder of sounds, one 20 dB weaker, one half as long, at another rate and with two channels"
mkdir 'some sounds'
python3 - << 'END'
import array, random, wave
def write(name, gain, rate, frames, channels):
    random.seed(1)
    with wave.open("some sounds/" + name, "wb") as w:
        w.setparams((channels, 2, rate, frames, "NONE", ""))
        w.writeframes(array.array("h", [round(gain * random.uniform(-1, 1) * (k % channels == 0)) for k in range(frames * channels)]).tobytes())
write("one 100%.wav", 30000, 44100, 22050, 1)
write("weaker.wav", 3000, 44100, 22050, 1)
write("short.wav", 30000, 16000, 4000, 2)
END
echo no sound > 'some sounds/two.wav'
rasp plot --gallery 'some sounds/'
python3 page.py 'some sounds/gallery.html'
echo "-- what cannot be"
try() { "$@" || echo "exit code $?"; }
mkdir empty
try rasp plot --gallery empty
try rasp plot --gallery gone
try rasp plot --gallery stroke.yaml
try rasp plot --gallery modes.csv
try rasp plot --gallery set -o page.txt
try rasp plot --gallery set --from 1
try rasp plot --gallery set --panels force
try rasp plot --gallery set -o gone/page.html
find . -name '*.html' | sort

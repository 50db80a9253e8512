# Stems beside the sound, channels for listening places, what an earlier render left of them, and pictures of one channel.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
format() { python3 -c '
import struct, sys
for name in sys.argv[1:]:
    kind, channels, rate = struct.unpack("<HHI", open(name, "rb").read(28)[20:])
    print(name, "float" if kind == 3 else "integers", channels, "x", rate)' "$@"; }
summary() { python3 -c '
import json, sys
d = json.load(open(sys.argv[1]))
for f in d["files"]: print(f["kind"], f["name"], f.get("stem", "-"))
sound = d.get("sound")
if sound: print(sound["unit"], [(c["place_m"], c["peak"] <= sound["peak"], c["rms"] > 0) for c in sound.get("channels", [])])' "$1"; }
cat > pane.yaml << END
rasp: 1
surface:
  roughness: {}
  material: glass
  object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 3 mm, origin: [-10 cm, -10 cm]}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
output:
  tail: 50 ms
  stems: [force, surface]
  listen: {radiator: plate, places: [[0, 0, 30 cm], [50 cm, 0, 40 cm]]}
END
rasp render -q pane.yaml
format pane.wav pane.force.wav pane.surface.wav
summary pane.json
rasp plan pane.yaml > plan
head -1 plan
rm plan
echo "-- the effective scene gives the same bytes"
mkdir again
rasp render -q pane.scene.yaml -o again/
for file in pane.wav pane.force.wav pane.surface.wav; do cmp $file again/$file; done
echo "-- without them: they stay, with a warning"
sed '/stems:/d; /listen:/d' pane.yaml > less.yaml
rasp render -q less.yaml -o pane.wav
format pane.wav
summary pane.json
echo "-- a stem that is an input"
printf '%s\n' 'rasp: 1' 'surface: {response: pane.force.wav, roughness: {}}' 'scraper: {mass: 10 g}' 'motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}' \
    'output: {stems: [force]}' > scene.yaml
rasp render -q scene.yaml -o pane.wav || echo "exit code $?" >&2
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
echo "-- pictures"
rasp plot again/pane.wav --channel 2 -o two.svg
grep -o 'channel 2 of 2' two.svg
rasp plot again/pane.force.wav -o force.svg
rasp plot again/pane.wav --channel 3 || echo "exit code $?" >&2
rasp plot again/pane.wav --channel 1.5 || echo "exit code $?" >&2

# What stimuli share of their inputs: a file that is read in other ways by each (pitch, scale, range, levelling, edges, rate, length, channel, pairing ...) is another thing for each; and so are objects of other sizes, materials, bands.
# One thread, four, and each stimulus rendered alone, which shares nothing, give the same bytes; and no two have the same samples.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
awk 'BEGIN { for (j = 0; j < 24; j++) for (i = 0; i < 96; i++) printf "%.6f%s", 3 * sin(i / 3) + 2 * sin(i * i + j) + i / 10, i < 95 ? "," : "\n" }' > map.csv
awk 'BEGIN { for (j = 0; j < 24; j++) for (i = 0; i < 96; i++) printf("%s%s", (j == 7 && i > 9 && i < 14) ? "nan" : sprintf("%.6f", 3 * sin(i / 3) + 2 * sin(i * i + j)), i < 95 ? "," : "\n") }' > holes.csv
rasp surface convert map.csv map.png --pitch 5um --height-scale 1um > /dev/null
printf '%s\n' '# poles: separate' '# quantity: velocity' '# pairing: frequency' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad \
    a,0,0,1,1000,60,1,0 a,0,0,2,1300,90,1,0 b,0.02,0,1,1500,60,1,0 b,0.02,0,2,1010,70,0.5,0 > modes.csv
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,700,60,1,0 > one.csv
python3 - << 'X'
import math, struct, wave
def put(name, rate, channels):
    w = wave.open(name, "wb")
    w.setnchannels(channels), w.setsampwidth(2), w.setframerate(rate)
    for i in range(4000):
        w.writeframes(b"".join(struct.pack("<h", int(20000 * math.exp(-i / 600) * math.sin(0.05 * (k + 1) * i))) for k in range(channels)))
put("tap.wav", 44100, 1)
put("force.wav", 44100, 2)
X
cat > base.yaml << 'X'
rasp: 1
seed: 4
surface: {roughness: {rms: 3 um}, response: one.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [2 cm, 0], duration: 0.15 s}
accuracy: draft
output: {tail: 0 s, encoding: float32}
X
for pascal in 60 50; do
    sed 's/response: one.csv/material: pane, object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm}/' base.yaml
    printf 'materials: {pane: {youngs_modulus: %d GPa, poisson: 0.2, density: 2400 kg/m^3, loss: 0.002}}\n' $pascal
done | awk '/^rasp: 1/ { n++ } { print > (n == 1 ? "own.yaml" : "soft.yaml") }'
cat > set.yaml << 'X'
rasp-design: 1
base: base.yaml
length: own
level: {each: {peak: -6 dB}}
factors:
  map:
    - {label: plain, set: {surface.height_map: map.csv, surface.pitch: 5 um, surface.height_scale: 1 um, surface.off_map: mirror}}
    - {label: pitch, set: {surface.height_map: map.csv, surface.pitch: 6 um, surface.height_scale: 1 um, surface.off_map: mirror}}
    - {label: scale, set: {surface.height_map: map.csv, surface.pitch: 5 um, surface.height_scale: 0.7 um, surface.off_map: mirror}}
    - {label: wrap, set: {surface.height_map: map.csv, surface.pitch: 5 um, surface.height_scale: 1 um, surface.off_map: wrap}}
    - {label: level, set: {surface.height_map: map.csv, surface.pitch: 5 um, surface.height_scale: 1 um, surface.off_map: mirror, surface.levelling: plane}}
    - {label: range, set: {surface.height_map: map.png, surface.pitch: 5 um, surface.height_range: 20 um, surface.off_map: mirror}}
    - {label: ranger, set: {surface.height_map: map.png, surface.pitch: 5 um, surface.height_range: 30 um, surface.off_map: mirror}}
    - {label: holes, set: {surface.height_map: holes.csv, surface.pitch: 5 um, surface.height_scale: 1 um, surface.off_map: mirror, surface.holes: fill}}
    - {label: holes_level, set: {surface.height_map: holes.csv, surface.pitch: 5 um, surface.height_scale: 1 um, surface.off_map: mirror, surface.holes: fill, surface.levelling: plane}}
    - {label: like, set: {surface.roughness: {like: like.csv, like_pitch: 5 um, rms: null}}}
    - {label: likes, set: {surface.roughness: {like: like.csv, like_pitch: 8 um, rms: null}}}
    - {label: tap, set: {surface.response: tap.wav}}
    - {label: short, set: {surface.response: tap.wav, surface.response_length: 20 ms}}
    - {label: launch, set: {surface.response: modes.csv, surface.pairing: 0.05}}
    - {label: pairs, set: {surface.response: modes.csv, surface.pairing: 0.3}}
    - {label: fewer, set: {surface.response: modes.csv, surface.modes: 1}}
    - {label: moving, set: {surface.response: modes.csv, surface.moving: readout}}
    - {label: moved, set: {surface.response: modes.csv, motion.to: [1 cm, 0]}}
    - {label: force, set: {surface.roughness: null, scraper: null, contact.model: given, contact.given.file: force.wav, contact.given.scale: 1 N}}
    - {label: channel, set: {surface.roughness: null, scraper: null, contact.model: given, contact.given.file: force.wav, contact.given.scale: 1 N, contact.given.channel: 2}}
    - {label: plate, set: {surface.response: null, surface.material: glass, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm}}}
    - {label: thicker, set: {surface.response: null, surface.material: glass, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 4 mm}}}
    - {label: steel, set: {surface.response: null, surface.material: steel, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm}}}
    - {label: own, base: own.yaml}
    - {label: own_soft, base: soft.yaml}
    - {label: plate_fewer, set: {surface.response: null, surface.modes: 7, surface.material: glass, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm}}}
    - {label: plate_band, set: {surface.response: null, surface.band: [500 Hz, 6 kHz], surface.material: glass, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm}}}
    - {label: plate_moved, set: {surface.response: null, surface.material: glass, surface.object: {shape: plate, length: 20 cm, width: 12 cm, thickness: 3 mm, origin: [-5 cm, -4 cm]}}}
replicates: 2
name: "{map}_{replicate}"
X
awk 'BEGIN { for (i = 0; i < 3000; i++) printf "%.9g\n", 1e-6 * (3 * sin(i / 3) + 2 * sin(i * i)) }' > like.csv
rasp batch set.yaml -o one -j 1 -q 2> told.txt
rasp batch set.yaml -o four -j 4 -q 2> /dev/null
grep "^set.yaml" told.txt || true
(cd one && sha256sum -c --quiet SHA256SUMS) && cmp one/SHA256SUMS four/SHA256SUMS && wc -l < one/SHA256SUMS
for scene in one/*.scene.yaml; do
    rasp render "$scene" -q -o again.wav 2> /dev/null
    cmp again.wav "${scene%.scene.yaml}.wav"
done
echo "different sounds: $(tail -n +2 one/manifest.csv | wc -l) stimuli"
python3 -c '
import csv
rows = list(csv.DictReader(open("one/manifest.csv")))
seen = {}
for r in rows:
    other = seen.setdefault(r["audio_sha256"], r["stimulus_id"])
    if other != r["stimulus_id"]: print(r["stimulus_id"], "is", other)'

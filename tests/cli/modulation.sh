# A modulation of the force, whatever makes it: of a scrape, a ball, impacts, and a recorded sound (given, and heard as it is), the ratio of what is rendered with
# it and without is 1 + m sin(2 pi nu t), or follows the turn of a wheel there and back; the effective scene makes the same bytes.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > ratio.py << 'END'
import array, math, sys
def read(name):
    d = open(name, "rb").read()
    at = d.index(b"data")
    return array.array("d", d[at + 8:at + 8 + int.from_bytes(d[at + 4:at + 8], "little")])
plain, told = read(sys.argv[1]), read(sys.argv[2])
m, phase = eval(sys.argv[3])
worst = max(abs(b - a * (1 + m * math.sin(phase(n / 44100)))) for n, (a, b) in enumerate(zip(plain, told)))
most = max(map(abs, plain))
print("as equation 7 has it" if worst < 1e-12 * most and most > 0 else f"off by {worst} of {most}")
END
head='rasp: 1
output: {quantity: force, sample_rate: 44.1 kHz, encoding: float64, ramp: 0, tail: 0, level: {full_scale: 1}}'
scene() { printf '%s\n' "$head" "$@" > scene.yaml; }
both() { # MODULATION PYTHON
    rasp render -q -f scene.yaml -o plain.wav 2>> told
    rasp render -q -f scene.yaml -o told.wav --set "contact.modulation=$1" 2>> told
    python3 ratio.py plain.wav told.wav "$2"
    rasp render -q -f told.scene.yaml -o again.wav 2>> told
    cmp told.wav again.wav && cmp told.scene.yaml again.scene.yaml
}
scene 'surface: {roughness: {}}' 'scraper: {mass: 10 g}' 'motion: {path: back_and_forth, to: [2 cm, 0], rate: 2 Hz, duration: 0.5 s}'
both '{depth: 0.8, rate: 30 Hz}' '0.8, lambda t: 2 * math.pi * 30 * t'
# u = 1 cm (1 - cos 4 pi t): back where it came from, so is the modulation
both '{radius: 3 mm}' '0.3, lambda t: (0.01 * (1 - math.cos(4 * math.pi * t)) if t < 0.5 else 0) / 3e-3'
scene 'surface: {roughness: {}}' 'ball: {radius: 1 cm, mass: 10 g}' 'motion: {path: line, to: [10 cm, 0], speed: 20 cm/s}' 'contact: {model: roll}'
both '{depth: 1, radius: 1 cm}' '1, lambda t: 20 * min(t, 0.5)'
cp plain.wav recording.wav
scene 'motion: {path: still, duration: 0.5 s}' 'contact: {model: impacts, impacts: {prototype: roll}}'
both '{}' '0.3, lambda t: 2 * math.pi * 5 * t'
scene 'motion: {path: still, duration: 0.5 s}' 'contact: {model: given, given: {file: recording.wav, scale: 1 N}}'
both '{depth: 0.5, rate: 4 Hz}' '0.5, lambda t: 2 * math.pi * 4 * t'
grep error told || true
for wrong in '{radius: 1 cm}' '{depth: 1.1}' '{rate: 4 Hz, radius: 1 cm}' '{speed: 1}'; do
    rasp check scene.yaml --set "contact.modulation=$wrong" 2>&1 || true
done

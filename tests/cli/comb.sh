# What comes back from an edge: of a contact that keeps its place 10 cm from it the force is f(t) + g f(t - 2 ms) at 100 m/s, to rounding; of one that moves, and a
# sine, a sine that comes late by 2 d(t)/c, to what a cubic leaves. The effective scene makes the same bytes.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > comb.py << 'END'
import array, math, struct, sys
def read(name):
    d = open(name, "rb").read()
    at = d.index(b"data")
    return array.array("d", d[at + 8:at + 8 + int.from_bytes(d[at + 4:at + 8], "little")])
RATE, SINE = 48000, 1000
if sys.argv[1] == "make":
    data = struct.pack("<%df" % 24000, *(math.sin(2 * math.pi * SINE * t / RATE) for t in range(24000)))
    open("sine.wav", "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 1, RATE, 4 * RATE, 4, 32) + b"data" + struct.pack("<I", len(data)) + data)
elif sys.argv[1] == "still":
    x, y = read("plain.wav"), read("told.wav")
    worst = max(abs(y[n] - x[n] + 0.5 * (x[n - 96] if n >= 96 else 0)) for n in range(23000))
    print("to rounding" if worst < 1e-15 * max(map(abs, x)) * 8 else worst)
else:
    x, y = read("plain.wav"), read("told.wav")
    def late(n):
        return 2 * abs(0.3 - 0.4 * n / RATE) / 200 # s
    worst = max(abs(y[n] - x[n] - 0.7 * math.sin(2 * math.pi * SINE * (n / RATE - late(n)))) for n in range(200, 23000))
    print("to what a cubic leaves" if worst < 2e-4 else worst)
END
python3 comb.py make
both() { # MOTION COMB CASE
    printf '%s\n' 'rasp: 1' "motion: $1" 'contact: {model: given, given: {file: sine.wav, scale: 1 N}}' \
        'output: {quantity: force, sample_rate: 48 kHz, encoding: float64, ramp: 0, tail: 0, level: {full_scale: 1}}' > scene.yaml
    rasp render -q -f scene.yaml -o plain.wav 2>> told
    rasp render -q -f scene.yaml -o told.wav --set "contact.comb=$2" 2>> told
    python3 comb.py "$3"
    rasp render -q -f told.scene.yaml -o again.wav 2>> told
    cmp told.wav again.wav && cmp told.scene.yaml again.scene.yaml
}
both '{path: still, duration: 0.5 s}' '{gain: -0.5, distance: 10 cm, speed: 100 m/s}' still
both '{path: line, to: [20 cm, 0], speed: 40 cm/s}' '{}' moves
grep error told || true
rasp check scene.yaml --set 'contact.comb={gain: 2, edge: 1 cm}' 2>&1 || true

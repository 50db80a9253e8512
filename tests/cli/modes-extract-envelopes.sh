# How each mode falls: of two modes that decay as exponentials the amplitude by heterodyne is A e^(-d t), times what a Hann window makes of the fall inside it
# (sinh(a) / a / (1 + a^2 / pi^2), a = d T / 2), and its phase stands still; what the modes make of it is the same.
. "$ROOT/tests/cli/modes-extract-make.inc"
cat > falls.py << 'END'
import csv, math, struct, sys
modes = [(800.0, 20.0, 0.5, 0.7), (1100.0, 45.0, 0.3, -1.0)] # Hz, 1/s, A, phase
if sys.argv[1] == "make":
    n, rate = 24000, 24000
    x = [sum(a * math.exp(-d * t / rate) * math.sin(2 * math.pi * f * t / rate + p) for f, d, a, p in modes) for t in range(n)]
    data = struct.pack("<%df" % n, *x)
    fmt = struct.pack("<HHIIHH", 3, 1, rate, 4 * rate, 4, 32)
    open("ring.wav", "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<I", 16) + fmt + b"data" + struct.pack("<I", len(data)) + data)
    sys.exit()
worst, turned, rows = 0, 0, 0
for row in csv.DictReader(open("falls.csv")):
    f, d, a, p = min(modes, key=lambda m: abs(m[0] - float(row["frequency_hz"])))
    half = d * 4 / 300 / 2
    there = a * math.exp(-d * float(row["time_s"])) * math.sinh(half) / half / (1 + (half / math.pi) ** 2)
    if there < 0.1 * a: continue # later on the slower mode shines through, -41 dB of it
    rows += 1
    worst = max(worst, abs(float(row["amplitude"]) / there - 1), abs(float(row["amplitude_of_modes"]) / there - 1))
    turned = max(turned, abs(math.remainder(float(row["phase_rad"]) - p, 2 * math.pi)))
print(rows > 30 and "rows of both modes", "within 1 %" if worst < 0.01 else worst, "phases within 0.02 rad" if turned < 0.02 else turned)
END
python3 falls.py make
extract ring.wav@1cm,2cm --impulse --delay 0s --quantity velocity --scale 1 -q -o table.csv --envelopes falls.csv
head -n 1 falls.csv
python3 falls.py read
try extract ring.wav --impulse -q -o a.csv --envelopes falls.txt
try extract ring.wav --impulse -q -o a.csv --envelopes a.csv
try rasp modes object plate.yaml --envelopes a.csv

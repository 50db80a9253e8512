# The residual of a recorded strike: with the true table it is the noise, a mode that is left out is in it, what is no
# mode comes back by either domain; estimated tables; the folder, whole or not there; what is refused.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
try() { local code=0; "$@" || code=$?; echo "exit code $code"; }
residual() { rasp modes residual "$@"; }
# make NAME SEED KIND: KIND.wav of 44.1 kHz, a strike at 0.3 s on ten modes, with noise at -60 dB; true.csv has the modes
# but 2 kHz, all.csv all. force: a second channel, of half sines of 5 N; click: a burst of noise for 30 ms besides.
cat > make.py << 'END'
import math, random, struct, sys
name, seed, kind = sys.argv[1], int(sys.argv[2]), sys.argv[3]
random.seed(seed)
rate, onset, n = 44100, 13230, 66150
mode = [(f * random.uniform(0.97, 1.03), random.uniform(4, 40), random.uniform(0.05, 1) * random.choice((-1, 1)), random.uniform(-0.5, 0.5)) for f in (180, 340, 520, 800, 1200, 1500, 2900, 3500, 4100)]
mode.append((2000.0, 12.0, 0.5, 0.3))
pulse = [5 * math.sin(math.pi * (k + 0.5) / 10) for k in range(10)] if kind == "force" else [1.0]
x = [random.gauss(0, 1e-3) for t in range(n)]
noise = sum(v * v for v in x[onset:]) / (n - onset)
burst = random.Random(seed + 1000)
rest = [0.1 * burst.gauss(0, 1) * math.exp(-k / 400) if kind == "click" else 0.0 for k in range(n - onset)]
missing = [0.0] * (n - onset)
if kind == "force":  # modes that begin without a jump: what is sampled is what rings
    mode = [(f, d, g, 0.0) for f, d, g, p in mode]
for f, d, g, p in mode:
    turn, re, im = complex(-d, 2 * math.pi * f) / rate, 0j, 0j
    step = 2.718281828459045 ** turn
    state, a = 0j, g * complex(math.cos(p), math.sin(p)) / (1 if kind != "force" else rate / 100)
    for k in range(n - onset):
        state = state * step + (pulse[k] if k < len(pulse) else 0)
        x[onset + k] += (a * state).imag
        missing[k] = (a * state).imag
if kind == "tone":  # begins with the strike
    rest = [0.2 * math.sin(2 * math.pi * 997 * k / rate) for k in range(n - onset)]
for k, v in enumerate(rest):
    x[onset + k] += v
force = [0.0] * n
force[onset:onset + len(pulse)] = pulse
def save(name, channels, flat):
    data = struct.pack("<%df" % len(flat), *flat)
    open(name, "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, channels, rate, rate * 4 * channels, 4 * channels, 32) + b"data" + struct.pack("<I", len(data)) + data)
save("missing.wav", 1, missing)
save("rest.wav", 1, rest)
if kind == "force":
    save(name, 2, [v for pair in zip(x, force) for v in pair])
else:
    save(name, 1, x)
for file, modes in (("all.csv", mode), ("true.csv", mode[:-1])):
    with open(file, "w") as out:
        out.write("# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n")
        for k, m in enumerate(modes):
            out.write("1,0,0,%d,%.12g,%.12g,%.12g,%.12g\n" % (k + 1, *m))
END
# same RESIDUAL OTHER LOW HIGH DECIBEL: has the folder's residual the energy of another sound in that band, within so much?
# blown RESIDUAL FORCE: convolved with the force, is its response its sound, below 4 kHz, to -40 dB?
cat > same.py << 'END'
import cmath, json, math, struct, sys
def fft(v):
    if len(v) == 1: return v
    even, odd = fft(v[::2]), fft(v[1::2])
    half = len(v) // 2
    turned = [cmath.exp(-2j * math.pi * k / len(v)) * odd[k] for k in range(half)]
    return [e + t for e, t in zip(even, turned)] + [e - t for e, t in zip(even, turned)]
def load(name, channel=0, channels=1):
    b = open(name, "rb").read()
    at = b.index(b"data")
    return struct.unpack("<%df" % (struct.unpack("<I", b[at + 4:at + 8])[0] // 4), b[at + 8:])[channel::channels]
def spectrum(x, n):
    return fft(list(x) + [0.0] * (n - len(x)))
def level(x, low, high):
    n = 1 << (len(x) - 1).bit_length()
    return 10 * math.log10(sum(abs(v) ** 2 for v in spectrum(x, n)[int(low * n / 44100):int(high * n / 44100)]) / n)
folder, other = sys.argv[1:3]
facts = json.load(open(folder + ".json"))
left = load(folder + "/strike.wav", 1, 2)
if sys.argv[3] == "through":  # the force of a recording, of which the first sample of the residual is the most
    at = round(facts["start_s"] * 44100)
    h, f, n = list(load(folder + "/residual.wav")), load(other, 1, 2)[at:at + 300], 2 << (len(left) - 1).bit_length()
    h[0] /= 2
    h, f, y = spectrum(h, n), spectrum(f, n), spectrum(left, n)
    off = sum(abs(a * b / 44100 - c) ** 2 for a, b, c in zip(h, f, y)) / sum(abs(c) ** 2 for c in y)
    print("through the force:", "as it was" if off < 1e-3 else 10 * math.log10(off))
elif sys.argv[3] == "blown":
    h, f = list(load(folder + "/residual.wav")), [0.0] * (13230 - round(facts["onset_s"] * 44100)) + [5 * math.sin(math.pi * (k + 0.5) / 10) for k in range(10)]
    h[0] /= 2  # as of any response
    n = 2 << (len(h) - 1).bit_length()
    h, f, y = spectrum(h, n), spectrum(f, n), spectrum(left, n)
    scale = 44100
    k = range(4000 * n // 44100)
    off = sum(abs(h[i] * f[i] / scale - y[i]) ** 2 for i in k) / sum(abs(y[i]) ** 2 for i in k)
    print("by the force:", "as it was" if off < 1e-4 else 10 * math.log10(off))
else:
    low, high, limit = map(float, sys.argv[3:])
    off = level(left, low, high) - level(load(other), low, high)
    print("%g to %g Hz:" % (low, high), "as it should be" if abs(off) < limit else off)
END
# fact NAME EXPRESSION: of the --json report d.
fact() { python3 -c 'import json, sys; d = json.load(open(sys.argv[1] + ".json")); print(eval(sys.argv[2]))' "$1" "$2"; }
measure() { residual "$@" --quantity velocity --json -f > "${*: -1}.json"; }
for seed in 1 2 3; do
    for kind in plain force; do
        python3 make.py $kind.wav $seed $kind
        channels=()
        [ $kind = plain ] || channels=(--force-channel 2 --scale 1 --force-scale 1)
        echo "seed $seed, $kind: all modes leave the noise, of which little stays; 2 kHz is what it is where it is left out"
        measure $kind.wav all.csv "${channels[@]}" -o all
        fact all 'abs(d["left_db"] - d["noise_db"]) < 0.1, d["residual_db"] < d["noise_db"] - (25.5 if "'$kind'" == "plain" else 10), d["physical"], d["outside"]'
        for domain in time power; do
            measure $kind.wav true.csv "${channels[@]}" --keep-noise --residual-domain $domain -o one
            python3 same.py one missing.wav 1782 2245 0.2
            [ $kind$domain != forcetime ] || python3 same.py one - blown
        done
    done
    python3 make.py click.wav $seed click
    measure click.wav all.csv -o all
    echo "seed $seed: a burst of noise"
    python3 same.py all rest.wav 5000 16000 0.2
    python3 same.py all rest.wav 500 5000 0.8
done

# What a scene makes of a table is all represented, a jump, a direct term and what sampling folds back in it.
cat > join.py << 'END'
import struct, sys
def load(name):
    b = open(name, "rb").read()
    at = b.index(b"data") + 4
    n = struct.unpack("<I", b[at:at + 4])[0]
    return struct.unpack("<%df" % (n // 4), b[at + 4:at + 4 + n])
flat = [v for pair in zip(load(sys.argv[1]), load(sys.argv[2])) for v in pair]
data = struct.pack("<%df" % len(flat), *flat)
open(sys.argv[3], "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 3, 2, 44100, 352800, 8, 32) + b"data" + struct.pack("<I", len(data)) + data)
END
cat > struck.yaml << 'END'
rasp: 1
surface: {response: quantity.csv}
scraper: {mass: 5 g}
motion: {path: still, at: [0, 0], duration: 0.4 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 0.5 m/s, stiffness: 2e6, first: 0.3 s}}
output: {sample_rate: 44.1 kHz, stems: [force], encoding: float32, level: {full_scale: 1}, duration: 2 s, ramp: 0}
END
python3 make.py force.wav 4 force
for quantity in velocity acceleration; do
    sed "s/quantity: velocity/quantity: $quantity/" all.csv > quantity.csv
    rasp render struck.yaml -q -f -o struck.wav
    python3 join.py struck.wav struck.force.wav both.wav
    residual both.wav quantity.csv --force-channel 2 --quantity $quantity --scale 1 --force-scale 1 --json -f -o struck > struck.json
    fact struck '"'$quantity': left", d["left_db"] < -80'
done
# Called a velocity, it leaves its direct term: a response that is over at once. A soft hammer does not reach up to where that does.
for stiffness in 2e6 5e4; do
    rasp render struck.yaml --set contact.strike.stiffness=$stiffness -q -f -o struck.wav
    python3 join.py struck.wav struck.force.wav both.wav
    residual both.wav quantity.csv --force-channel 2 --quantity velocity --scale 1 --force-scale 1 --json -f -o struck > struck.json
    python3 same.py struck both.wav through
    fact struck 'd["force_divided_out_to_hz"]'
done
python3 make.py click.wav 3 click

echo "estimated: the same modes match; other decays only in part; a table of which nothing matches leaves all"
rm -rf all one
residual click.wav all.csv --estimated all.csv -o all | sed -n 2p
awk -F, -v OFS=, '/^1,/ { $6 *= 1.13 } { print }' all.csv > near.csv
awk -F, -v OFS=, '/^1,/ { $5 *= 1.2 } { print }' all.csv > far.csv
residual click.wav all.csv --estimated near.csv -o near | sed -n 2p
residual click.wav all.csv --estimated far.csv --keep-noise -o far | sed -n 's/[.][0-9]* dB/ dB/g; 2,3p'
python3 make.py force.wav 1 force
residual force.wav all.csv --force-channel 2 --delay 20ms -o late | grep -o 'warning: the sound sets in .*'
try residual force.wav all.csv --force-channel 2 -o ''
python3 make.py click.wav 3 click
residual click.wav far.csv -o other | grep -o 'warning: .* off'
echo "the same bytes"
residual click.wav all.csv -q -o again
cmp all/residual.wav again/residual.wav
ls all
sed -e 's/[0-9a-f]\{64\}/HASH/' -e 's/\(_db: -*[0-9]*\)[.0-9]*/\1/' -e 's/peak: .*/peak: P/' all/residual.yaml
head -3 all/modes.csv | sed 's/[0-9a-f]\{64\}/HASH/'

echo "doubtful"
residual click.wav all.csv -f -o doubtful | grep -A1 'taken as' | tr -s ' \n' ' '
residual click.wav all.csv --quantity velocity -f -o doubtful | grep -c 'taken as' || true
python3 make.py tone.wav 3 tone
rasp modes extract tone.wav -f -o tone.csv | grep -c '1 mode falls by less than 0.9 dB'
python3 make.py click.wav 3 click
# Under sanitizers two minutes, of what cli/modes-extract runs there, too.
if [ "${SANITIZED:-}" ]; then echo 0; else rasp modes extract click.wav -f -o click.csv | grep -c 'falls by less' || true; fi

echo "a scene"
cat > scene.yaml << 'END'
rasp: 1
surface: {response: all.csv, residual: all/residual.yaml}
scraper: {mass: 2 g}
motion: {path: still, at: [0, 0], duration: 0.5 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 2e6}}
output: {sample_rate: 44.1 kHz}
END
render() { rasp render "$@" | sed -e 's/s, [.0-9]* times.*/s/' -e 's/[.][0-9]* dB/ dB/g'; }
render scene.yaml -o with.wav
rasp render scene.yaml -q -o again.wav
cmp with.wav again.wav
render scene.yaml --set surface.residual_inverse=noise --set surface.residual_shift=ratio -o noise.wav
render scene.yaml --set output.sample_rate='48 kHz' -o other.wav
rasp plan scene.yaml | sed -n '/surface_residual/,+1 s/[0-9.]* %/P %/; /surface_residual/,+1 p'
rasp render scene.yaml --set surface.residual_gain=0 -q -o none.wav
sed 's/, residual.*yaml//' scene.yaml > without.yaml
rasp render without.yaml -q -o without.wav
rasp compare none.wav without.wav > compared.txt && echo "a gain of 0 is no residual"
# What is left of modes that match in part is as loud beside whole modes as in the strike, here some 6 dB softer.
sed -n 's/\(residual_db: -*[0-9]*\)[.0-9]*/\1/p' near/residual.yaml
render scene.yaml --set surface.residual=near/residual.yaml -o part.wav
cp -r all silent
python3 - << 'END'
import hashlib
b = bytearray(open("silent/residual.wav", "rb").read())
y, before = open("silent/residual.yaml").read(), hashlib.sha256(b).hexdigest()
b[b.index(b"data") + 8:] = bytes(len(b) - b.index(b"data") - 8)
open("silent/residual.wav", "wb").write(b)
open("silent/residual.yaml", "w").write(y.replace(before, hashlib.sha256(b).hexdigest()))
END
render scene.yaml --set surface.residual=silent/residual.yaml -o silent.wav
rasp render scene.yaml --set surface.residual=silent/residual.yaml -o silent.wav --json | grep level_db
grep -A1 'file: .*residual' with.scene.yaml | sed 's/[0-9a-f]\{64\}/HASH/'

echo refused >&2
try residual click.wav all.csv
try residual click.wav all.csv -o all
try residual click.wav all.csv -f -q -o all
touch all/other
try residual click.wav all.csv -f -o all
rm all/other
mkdir empty
try residual click.wav all.csv -f -o empty
try residual click.wav all.csv -o nowhere/all
try residual click.wav all.csv -o /dev/null
ln -s all link
try residual click.wav all.csv -f -o link
try residual click.wav missing.csv -o x
try residual nowhere.wav all.csv -o x
try residual click.wav all.csv --estimated click.wav -o x
try residual click.wav all.csv --residual-domain both -o x
try residual click.wav all.csv --low 5kHz -o x
try residual all all.csv -o x
try residual click.wav -o x
try residual click.wav all.csv --plot x.png -o x
find . -name x -o -name '.rasp*'
try rasp render scene.yaml --set surface.residual=all -o x.wav
try rasp render scene.yaml --set surface.residual=scene.yaml -o x.wav
try rasp render scene.yaml --set surface.response=plain.wav -o x.wav
try rasp render scene.yaml --set surface.response=null -o x.wav
try rasp render scene.yaml --set surface.gammatone=2 -o x.wav
awk -F, -v OFS=, '/^1,/ { $5 *= 100; if ($5 > 20000) next } { print }' all.csv > high.csv
try rasp render scene.yaml --set surface.response=high.csv -o x.wav
sed -i 's/rasp_residual: 3/rasp_residual: 4/' again/residual.yaml
try rasp render scene.yaml --set surface.residual=again/residual.yaml -o x.wav
sed -i 's/1$/2/' near/modes.csv
try rasp render scene.yaml --set surface.residual=near/residual.yaml -o x.wav
rm all/residual.wav
try rasp render scene.yaml -o x.wav
# a hum that no silence before the strike shows stays in the residual, and that is said
python3 make.py late.wav 7 plain
python3 - << 'END'
import struct
b = open("late.wav", "rb").read()
at = b.index(b"data") + 8
x = b[at + 4 * 13228:]
open("late.wav", "wb").write(b[:4] + struct.pack("<I", at + len(x) - 8) + b[8:at - 4] + struct.pack("<I", len(x)) + x)
END
{ echo '# hum: 1'; cat true.csv; } > hum.csv
for table in true hum; do
    echo "$table: $(residual late.wav $table.csv --quantity velocity -f -o late | grep -c 'has a hum, and no silence before the strike')"
done

# A ball that follows the ground as a point does (papers/000, section 4.1, as printed), with a ball as experiment 3 has it: without the non-linearity it is 20 dB
# louder and 1 kHz brighter, and under the rolling curve it is neither. The effective scene makes the same bytes. A patch has nothing to smooth.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > heard.py << 'END'
import array, cmath, math, sys

def read(name):
    "Samples of a mono float32 WAV."
    d = open(name, "rb").read()
    at = d.index(b"data")
    return array.array("f", d[at + 8:at + 8 + int.from_bytes(d[at + 4:at + 8], "little")])

def transform(x):
    if len(x) == 1: return x
    even, odd, n = transform(x[::2]), transform(x[1::2]), len(x)
    turned = [cmath.exp(-2j * math.pi * k / n) * odd[k] for k in range(n // 2)]
    return [a + b for a, b in zip(even, turned)] + [a - b for a, b in zip(even, turned)]

def heard(name):
    "Level in dB, and the power spectrum's centroid in Hz, of 2^14 samples from 0.2 s on at 44.1 kHz."
    n = 1 << 14
    x = [v * (0.5 - 0.5 * math.cos(2 * math.pi * i / n)) for i, v in enumerate(read(name)[8820:8820 + n])]
    power = [abs(v) ** 2 for v in transform(x)[1:n // 2]]
    return 10 * math.log10(sum(power)), sum((i + 1) * p for i, p in enumerate(power)) / sum(power) * 44100 / n

for ball in "point", "ball":
    (level, centre), (less, dull) = heard(ball + "_omitted.wav"), heard(ball + "_kept.wav")
    print(f"{ball}: {'more' if level - less > 20 else 'less'} than 20 dB, {'more' if centre - dull > 1000 else 'less'} than 1 kHz")
    print(f"{ball}: {level - less:.1f} dB, {centre - dull:.0f} Hz", file=sys.stderr)
END
scene=$ROOT/scenes/experiments/000_rolling/glass_on_ceramic_up.yaml
for follows in ball point; do
    for limit in kept omitted; do
        rasp render "$scene" -q -o ${follows}_$limit.wav --set contact.roll.follows=$follows --set ball.patch=null --set ablation.nonlinearity=$limit \
            --set 'output={sample_rate: 44.1 kHz, encoding: float32, level: {full_scale: 1}}'
    done
done 2>&1 | grep -v "hardly heard\|beyond full scale" || true
python3 heard.py 2> /dev/null
rasp render point_kept.scene.yaml -q -o again.wav 2>&1 | grep -v "hardly heard" || true
cmp point_kept.wav again.wav && cmp point_kept.scene.yaml again.scene.yaml && echo "the same bytes"
for follows in point hover; do
    { rasp check "$scene" --set contact.roll.follows=$follows || true; } 2>&1 | sed "s|$ROOT/||g"
done
cat > linear.yaml << 'END'
rasp: 1
surface: {fractal: {interpolation: nearest}}
ball: {radius: 1 cm, mass: 10 g}
motion: {path: line, to: [6 cm, 0], speed: 30 cm/s}
contact: {model: roll, roll: {follows: point}}
output: {quantity: force}
END
rasp render linear.yaml -q -o linear.wav 2>&1 || echo "exit $?"
# Where N(t) is greatest: lowest, or falling, a quarter of a turn earlier.
for phase in lowest falling; do
    rasp render "$ROOT/scenes/eccentric_ball.yaml" -q -o turned.wav --set load.phase=$phase \
        --set 'output.diagnostics={rate: 1000, columns: [time_s, roll_angle_rad, normal_force_n]}' 2>&1 | grep -v warning || true
    head -1 turned.csv
    awk -F, 'NR > 1 { if ($2 > most) { most = $2; angle = $3 } } END { a = angle / 6.283185307; printf "greatest at %.2f of a turn\n", a - int(a) + (a < int(a)) }' turned.csv
done

# Momentum of impacts, and of given forces, that begin with the file: the sum of a float64 file over its rate, at random
# pulses, stiffnesses, beginnings, rates and sub-intervals, within 1e-6.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > momentum.py << 'END'
import random, struct, subprocess

FULL = 1e6  # N

def force(path):
    data, at = open(path, 'rb').read(), 12
    while data[at:at + 4] != b'data':
        if data[at:at + 4] == b'fmt ':
            rate = struct.unpack('<I', data[at + 12:at + 16])[0]
        at += 8 + struct.unpack('<I', data[at + 4:at + 8])[0]
    n = struct.unpack('<I', data[at + 4:at + 8])[0] // 8
    return rate, [FULL * x for x in struct.unpack('<%dd' % n, data[at + 8:at + 8 + 8 * n])]

def off(what, scraper, contact, start, over, rate, want, size):
    open('s.yaml', 'w').write(f'''rasp: 1
{scraper}motion: {{path: still, duration: 0.05 s}}
contact: {{{contact}}}
{start}accuracy: {{oversampling: {over}}}
output: {{quantity: force, sample_rate: {rate}, ramp: 0, tail: 20 ms, encoding: float64, level: {{full_scale: {FULL}}}}}
''')
    run = subprocess.run(['rasp', 'render', 's.yaml', '-o', 's.wav'], capture_output=True, text=True)
    if run.returncode:
        return print(what, run.returncode, run.stderr)
    if 'faded' in run.stderr:
        print(what, 'is told as faded in, without a ramp:', run.stderr)
    made, x = force('s.wav')
    got = sum(x) / made
    if made != rate or not abs(got - want) < 1e-6 * size:
        print(f'{what}: {got} N s in place of {want}:', open('s.yaml').read())

random.seed(24)
rates = [8000, 22050, 44100, 47999, 48000, 96000, 192000]
for k in range(40):
    rate, over = random.choice(rates), random.choice([1, 2, 3, 4, 7, 16, 64])
    pulse, stiffness = random.choice(['half_sine', 'hertz']), 10 ** random.uniform(5, 13)
    m, v, e = 10 ** random.uniform(-3, -1), random.uniform(0.1, 4), random.choice([1, 1, 0.01, random.uniform(0.01, 1)])
    first = random.choice([0, random.random(), random.randrange(5), 5 * random.random()]) / rate
    strike = f'pulse: {pulse}, stiffness: {stiffness!r}, speed: {v!r} m/s, first: {first!r} s'
    strike += f', count: 1, restitution: {e!r}' if e < 1 else ''
    start, want = random.choice(['', '', 'start: 3.3 ms\n']), m * v * (1 + e)
    mass = f'scraper: {{mass: {m!r} kg}}\n'
    off('strike', mass, f'model: strike, strike: {{{strike}}}', start, over, rate, want, want)
for k in range(20):
    rate, over = random.choice(rates), random.choice([1, 4, 16])
    t, f, rows = [0], [random.uniform(1, 3)], random.randrange(1, 5)
    for i in range(rows):
        t.append(t[-1] + 10 ** random.uniform(-6, -2.2))
        f.append(random.uniform(-1, 3))
    open('f.csv', 'w').write('time_s,force_n\n' + ''.join(f'{a!r},{b!r}\n' for a, b in zip(t, f)))
    parts = [(t[i + 1] - t[i]) * (f[i] + f[i + 1]) / 2 for i in range(rows)]
    off('table', '', 'model: given, given: {file: f.csv}', '', over, rate, sum(parts), sum(map(abs, parts)))
for k in range(20):
    rate, n = random.choice(rates), random.randrange(1, 400)
    given = random.choice([44100, 48000, 51200, 96000, 12345.678])
    x = [random.uniform(0.2, 1) for i in range(n)]
    head = "{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }" % n
    head = b'\x93NUMPY\x01\x00' + struct.pack('<H', 118) + head.ljust(117).encode() + b'\n'
    open('f.npy', 'wb').write(head + struct.pack('<%dd' % n, *x))
    want = sum(x) / given
    off('samples', '', f'model: given, given: {{file: f.npy, rate: {given}}}', '', 4, rate, want, want)
END
python3 momentum.py

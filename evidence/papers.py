"""The acoustics of a rendered set by a factor: median centroid of the power spectrum (2^15 samples from a quarter of the sound on, Hann), and the gain that brought
each sound to its loudness, median and range. papers.py FOLDER FACTOR"""
import cmath, csv, math, statistics, sys


def samples(name):
    "Of a mono 24-bit WAV."
    d = open(name, "rb").read()
    at = d.index(b"data")
    raw = d[at + 8:at + 8 + int.from_bytes(d[at + 4:at + 8], "little")]
    return int.from_bytes(d[24:28], "little"), [int.from_bytes(raw[i:i + 3], "little", signed=True) / 2**23
                                                for i in range(0, len(raw) - 2, 3)]


def transform(x):
    "In place, of 2^k complex numbers."
    n, j = len(x), 0
    for i in range(1, n):
        bit = n >> 1
        while j & bit:
            j, bit = j ^ bit, bit >> 1
        j |= bit
        if i < j: x[i], x[j] = x[j], x[i]
    size = 2
    while size <= n:
        turn = [cmath.exp(-2j * math.pi * k / size) for k in range(size // 2)]
        for start in range(0, n, size):
            for k in range(size // 2):
                a, b = x[start + k], x[start + k + size // 2] * turn[k]
                x[start + k], x[start + k + size // 2] = a + b, a - b
        size *= 2
    return x


def centroid(name):
    rate, x = samples(name)
    n = min(1 << 15, 1 << (len(x) * 3 // 4).bit_length() - 1)
    x = x[len(x) // 4:][:n]
    power = [abs(v)**2 for v in transform([v * (0.5 - 0.5 * math.cos(2 * math.pi * i / n)) + 0j for i, v in enumerate(x)])[1:n // 2]]
    return sum((k + 1) * p for k, p in enumerate(power)) / sum(power) * rate / n


def main(folder, factor):
    told = {}
    for row in csv.DictReader(open(f"{folder}/manifest.csv")):
        told.setdefault(row[factor], []).append((centroid(f"{folder}/{row['file_name']}"), float(row["gain_db"])))
    print(f"| {factor} | sounds | centroid, Hz | gain to -26 LUFS, dB |\n|---|---|---|---|")
    for level, of in told.items():
        c, g = ([v[k] for v in of] for k in (0, 1))
        print(f"| {level} | {len(of)} | {statistics.median(c):.0f} ({min(c):.0f} to {max(c):.0f}) | "
              f"{statistics.median(g) + 0:.1f} ({min(g):.0f} to {max(g):.0f}) |")


main(*sys.argv[1:])

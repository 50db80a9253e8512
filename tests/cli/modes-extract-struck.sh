# What is wrong with a strike does not reach the modes: a hammer that bounces, a clipped strike that rings on into the next, a hum
# that comes and goes, one beside a mode and louder, an object that rests anew and rings 0.3 % higher or lower each time,
# a place where nothing can be fitted; and errors between strikes are those that the strikes show.
. "$ROOT/tests/cli/modes-extract-make.inc"
cat > struck.py << 'END'
import json, math, random, struct, sys
rate, modes = 16000, [(431, 6, 1.0), (1187, 15, 0.7), (3020, 40, 0.5)]
if sys.argv[1] == "judge": # NAME.json: three modes; frequency and decay within 5 se, gains within SHARE of those of "plain"
    found, plain = (sorted(json.load(open(f + ".json"))["modes"], key=lambda m: m["frequency_hz"]) for f in (sys.argv[2], "plain"))
    wrong = ["%d modes" % len(found)] * (len(found) != 3)
    for m, p, (f, d, _) in zip(found, plain, modes):
        wrong += ["frequency %g" % m["frequency_hz"]] * (abs(m["frequency_hz"] - f) > (4e-3 * f if sys.argv[2] == "moved" else 5 * m["frequency_se"] + 1e-9 * f))
        wrong += ["decay %g" % m["decay_per_s"]] * (abs(m["decay_per_s"] - d) > 5 * m["decay_se"])
        wrong += ["gain %g" % m["places"][0]["gain"]] * (abs(m["places"][0]["gain"] / p["places"][0]["gain"] - 1) > float(sys.argv[3]))
        if sys.argv[2] == "moved":
            wrong += ["between %g" % m["frequency_se_between"]] * (not 1e-3 < m["frequency_se_between"] / f < 8e-3)
        else:
            wrong += ["between %g" % m["frequency_se_between"]] * (m["frequency_se_between"] > 10 * m["frequency_se"])
    sys.exit("%s: %s" % (sys.argv[2], ", ".join(wrong)) if wrong else print(sys.argv[2], "as it should be"))
case, n, scale, clip = sys.argv[1], 48000, 1.0, 0.9
random.seed(int(sys.argv[2]))
strikes = [(0.4, 1.0, 1.0), (1.2, 0.8, 1.0), (2.0, 0.9, 1.0)] # s, peak force, how the gains of the first and the third mode differ
if case == "bounced":
    strikes += [(at + 0.04, 0.5 * force, 1.02) for at, force, _ in strikes]
if case == "clipped": # by a factor of 4; what rings on is a third of the next strike's first mode
    strikes, scale = [(0.4, 6.0, 1.0), (0.9, 0.8, 1.0), (2.0, 0.9, 1.0)], 2.0
if case == "late":
    strikes, n = [(0.4, 1.0, 1.0)], 6400 + 163
if case == "long": # 20 dB above the noise: that it decays is not known
    modes.append((2111, 0.01, 0.004))
force, sound, drive, turns = [0.0] * n, [0.0] * n, [[0.0] * n for _ in modes], {}
for number, (at, peak, factor) in enumerate(strikes):
    turns[int(at * rate)] = 1 + 0.003 * (0, 1, -1)[number] if case == "moved" else 1
    for i in range(12):
        f = peak * math.sin(math.pi * (i + 0.5) / 12)
        force[int(at * rate) + i] += f
        for k, (_, _, gain) in enumerate(modes):
            drive[k][int(at * rate) + i] += f * gain * (1 + (factor - 1) * (k - 1))
for k, (f, d, _) in enumerate(modes):
    re, im, p = 0.0, 0.0, math.exp(-d / rate)
    for t in range(n):
        if t in turns:
            c, s = (p * x(2 * math.pi * f * turns[t] / rate) for x in (math.cos, math.sin))
        if t >= min(turns):
            re, im = c * re - s * im + drive[k][t], s * re + c * im
        sound[t] += 0.02 * im
for t in range(n):
    sound[t] += random.gauss(0, 1e-4)
    if case == "hum":
        sound[t] += 0.02 * (1 + 0.3 * math.sin(2 * math.pi * 0.7 * t / rate + 1)) * math.sin(2 * math.pi * 60 * t / rate)
    if case == "beside":
        sound[t] += 0.15 * math.sin(2 * math.pi * 435.5 * t / rate)
save = lambda x: max(-32768, min(32767, round(32767 * x)))
data = b"".join(struct.pack("<hh", save(scale * x), save(f / 8)) for x, f in zip(sound, force))
open(case + ".wav", "wb").write(b"RIFF" + struct.pack("<I", 36 + len(data)) + b"WAVEfmt " +
    struct.pack("<IHHIIHH", 16, 1, 2, rate, 4 * rate, 4, 16) + b"data" + struct.pack("<I", len(data)) + data)
END
judge() { python3 struck.py "$1" "$seed"; extract "$1.wav" --force-channel 2 --json "${@:3}" -f -o "$1.csv" > "$1.json"; python3 struck.py judge "$1" "$2"; }
for seed in 1 2; do
    judge plain 0
    judge bounced 0.03
    judge hum 0.01
    judge beside 0.01
    judge moved 0.03
    judge clipped 0.01 --scale 0.5 --force-scale 1 # the level of the others
done
python3 struck.py long 1
extract long.wav --force-channel 2 --json -o long.csv > long.json
python3 - << 'END'
import json
d = json.load(open("long.json"))
print("long", [round(m["frequency_hz"]) for m in sorted(d["modes"], key=lambda m: m["frequency_hz"])], [w for w in d["warnings"] if "longer" in w])
END
python3 -c 'import json; print([s["left_out"] for s in json.load(open("clipped.json"))["places"][0]["strikes"]])'
tail -1 < <(rasp modes list plain.csv) | cut -c -60

echo "Places:"
python3 struck.py late 1
try extract plain.wav@0,0 late.wav@1cm,0 --force-channel 2 -o places.csv
try extract plain.wav --force-channel 2 --strikes 4 -f -o places.csv
for option in --impulse "--force-channel 2"; do
    # shellcheck disable=SC2086
    try extract plain.wav $option --delay 1e30s -o delay.csv
done
try extract plain.wav --force-channel 2 --residual r.wav --resynthesis ./r.wav -o twins.csv
ls ./*.csv

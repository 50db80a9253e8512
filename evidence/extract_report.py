"""Parts of evidence/extract.md, from the reports (OBJECT.NAME.json, .code, .time, .err, .csv) that evidence/extract.sh
made of OBJECTS. NAME is all, or odd and even (fitted to every other strike), or a kind of OpenBLAS's kernels (KINDS).

  python3 extract_report.py halves OBJECT   the two lists of strikes, one a line
  python3 extract_report.py flip OBJECT N   in place of OBJECT.wav one with the last bit of 40 samples flipped
  python3 extract_report.py PART            strikes, modes, apart, halves_agree, flips, kinds, order, lines, said
"""
import hashlib, json, math, os, random, struct, sys

OBJECTS, KINDS = os.environ["OBJECTS"].split(), os.environ.get("KINDS", "").split()

def load(o, name="all"):
    try:
        with open(f"{o}.{name}.json") as f:
            return json.load(f)
    except ValueError:
        return None

def told(o, name="all"):
    """What was said instead of a report."""
    with open(f"{o}.{name}.err") as f, open(f"{o}.{name}.code") as code:
        return f"exit code {code.read().strip()}: " + f.read().strip().split("\n")[0].replace("|", "\\|")[:200]

def spent(o, name="all"):
    """CPU seconds and MB, as GNU time says them: user, system, kB."""
    with open(f"{o}.{name}.time") as f:
        user, system, size = map(float, f.read().split()[-3:])
    return f"{user + system:.1f}", f"{size / 1024:.0f}"

def pick(of, *names):
    return next((of[n] for n in names if of.get(n) is not None), math.nan)

def median(v):
    v = sorted(v)
    return (v[(len(v) - 1) // 2] + v[len(v) // 2]) / 2 if v else math.nan

def spread(v):
    return f"{median(v):.0f}, {min(v):.0f}, {max(v):.0f}" if v else "-"

def table(*cells):
    print("|" + "|".join("---" if c == "---" else f" {c} " for c in cells) + "|")

def head(*cells):
    table(*cells)
    table(*["---"] * len(cells))

def strikes_of(report):
    return report["places"][0]["strikes"]

def halves(o):
    used = [i + 1 for i, s in enumerate(strikes_of(load(o))) if s["used"]]
    print(",".join(map(str, used[0::2])))
    print(",".join(map(str, used[1::2])))

def strikes():
    head("object", "strikes", "used", "clipped", "doubled", "explained: median, least, most (%)",
         "sound after force (ms)", "band (Hz)", "median momentum over full scale (ms)")
    for o in OBJECTS:
        r = load(o)
        if not r:
            table(o, told(o), *[""] * 7)
            continue
        p, s = r["places"][0], strikes_of(r)
        table(o, len(s), *(sum(k[what] for k in s) for what in ("used", "clipped", "doubled")),
              spread([100 * k["explained"] for k in s if k["used"] and k["explained"] is not None]),
              f"{1e3 * p['delay_s']:.2f}", f"{p['low_hz']:.0f} to {p['high_hz']:.0f}",
              f"{1e3 * median([k['momentum'] for k in s]):.3f}")

def modes():
    head("object", "modes", "of two slopes", "energy held (%)", "third octaves: mean, worst (dB), at (Hz)",
         "log-spectral distance (dB)", "median decay by energy, of all (1/s)", "faster than 300/s", "CPU (s)",
         "memory (MB)")
    for o in OBJECTS:
        r = load(o)
        if not r:
            table(o, told(o), *[""] * 6, *spent(o))
            continue
        d, of = r["places"][0]["distance"], r["modes"]
        table(o, len({m["mode"] for m in of}), sum(m["slope"] == 2 for m in of),
              f"{100 * r['places'][0]['explained']:.1f}",
              f"{d['third_octave_mean_db']:.1f}, {d['third_octave_worst_db']:.1f}, {d['third_octave_worst_hz']:.0f}",
              f"{d['log_spectral_db']:.1f}", f"{r['median_decay_by_energy_per_s']:.1f}, {r['median_decay_per_s']:.1f}",
              sum(m["decay_per_s"] > 300 for m in of), *spent(o))

def apart():
    """Strikes that were not fitted."""
    head("object", "fitted to", "modes", "those strikes, explained: median, least, most (%)",
         "the others, not fitted (%)", "the same ones when all are fitted (%)")
    for o in OBJECTS:
        all_used = load(o)
        for name in ("odd", "even"):
            r = load(o, name)
            if not r or not all_used:
                table(o, f"every other, {name}", told(o, name), "", "", "")
                continue
            share = lambda report, rows: spread([100 * strikes_of(report)[i]["explained"] for i in rows
                                                 if strikes_of(report)[i]["explained"] is not None])
            fitted = [i for i, s in enumerate(strikes_of(r)) if s["used"]]
            others = [i for i, s in enumerate(strikes_of(all_used)) if s["used"] and i not in fitted]
            table(o, ", ".join(str(i + 1) for i in fitted), len({m["mode"] for m in r["modes"]}), share(r, fitted),
                  share(r, others), share(all_used, others))

def matched(a, b):
    """Pairs of modes of two reports, nearest first: within half of the wider one's width, decays in a factor of 2."""
    pairs = []
    for x in a:
        for y in b:
            width = max(x["decay_per_s"], y["decay_per_s"]) / (2 * math.pi)
            off = abs(x["frequency_hz"] - y["frequency_hz"]) / width
            if off < 1 and 0.5 < x["decay_per_s"] / y["decay_per_s"] < 2:
                pairs.append((off, x, y))
    out = []
    for _, x, y in sorted(pairs, key=lambda p: p[0]):
        if not any(x is p or y is q for p, q in out):
            out.append((x, y))
    return out

def halves_agree():
    head("object", "modes: odd, even strikes", "in both", "their share of the energy (%)",
         "frequencies within 2 standard errors between strikes (%)", "... of the fit (%)", "decays, the same two (%)",
         "median difference: Hz, decay (%)")
    for o in OBJECTS:
        a, b = load(o, "odd"), load(o, "even")
        if not a or not b:
            table(o, told(o, "odd" if not a else "even"), *[""] * 6)
            continue
        pairs = matched(a["modes"], b["modes"])
        energy = lambda m: m["places"][0]["gain"] ** 2 / (4 * m["decay_per_s"])
        held = sum(energy(x) + energy(y) for x, y in pairs) / sum(map(energy, a["modes"] + b["modes"]))
        def within(value, *names):
            z = [abs(x[value] - y[value]) / math.hypot(pick(x, *names), pick(y, *names)) for x, y in pairs]
            z = [v for v in z if not math.isnan(v)]
            return f"{100 * sum(v < 2 for v in z) / len(z):.0f} (of {len(z)})" if z else "-"
        table(o, f"{len(a['modes'])}, {len(b['modes'])}", len(pairs), f"{100 * held:.0f}",
              within("frequency_hz", "frequency_se_between"), within("frequency_hz", "frequency_se", "frequency_error"),
              within("decay_per_s", "decay_se_between") + "; " + within("decay_per_s", "decay_se", "decay_error"),
              f"{median([abs(x['frequency_hz'] - y['frequency_hz']) for x, y in pairs]):.3f}, "
              f"{median([100 * abs(x['decay_per_s'] / y['decay_per_s'] - 1) for x, y in pairs]):.1f}")

def flip(o, n):
    with open(f"{o}.wav", "rb") as f:
        b = bytearray(f.read())
    at = 12
    while b[at:at + 4] != b"data": # chunks of even length before it
        at += 8 + struct.unpack_from("<I", b, at + 4)[0]
    size = struct.unpack_from("<I", b, at + 4)[0]
    random.seed(int(n))
    for k in random.sample(range(size // 2), 40): # 16 bits
        b[at + 8 + 2 * k] ^= 1
    os.remove(f"{o}.wav")
    with open(f"{o}.wav", "wb") as f:
        f.write(b)

def flips():
    names = ["all", "flip1", "flip2", "flip3", "flip4"]
    head("object", "modes", "median decay by energy (1/s)", "explained (%)", "strong ones there, of 40")
    for o in OBJECTS:
        of = [load(o, name) for name in names]
        if not all(of):
            table(o, *["refused" if not r else "" for r in of][:4])
            continue
        there = 0
        for a in sorted(of[0]["modes"], key=lambda m: -m["share"])[:10]:
            for r in of[1:]:
                there += any(abs(a["frequency_hz"] - b["frequency_hz"]) < max(a["decay_per_s"], b["decay_per_s"]) / 2 / math.pi
                             and 1 / 1.5 < a["decay_per_s"] / b["decay_per_s"] < 1.5 for b in r["modes"])
        table(o, ", ".join(str(len(r["modes"])) for r in of),
              ", ".join(f"{r['median_decay_by_energy_per_s']:.3g}" for r in of),
              ", ".join(f"{100 * r['places'][0]['explained']:.2f}" for r in of), there)

def kinds():
    head("object", *KINDS, "different tables")
    for o in OBJECTS:
        cells, sums = [], set()
        for kind in KINDS:
            r = load(o, kind)
            cells.append(f"{len(r['modes'])}: {r['median_decay_by_energy_per_s']:.6g}" if r else told(o, kind))
            if r:
                with open(f"{o}.{kind}.csv", "rb") as f:
                    sums.add(hashlib.md5(f.read()).hexdigest())
        table(o, *cells, len(sums))

def order():
    """metal < ceramic < plastic and wood."""
    head("", *OBJECTS, "metal < ceramic < plastic and wood")
    for what in ("median by energy", "plain, of the 10 strongest", "plain, of all"):
        of = {}
        for o in OBJECTS:
            r = load(o)
            if r:
                plain = [m["decay_per_s"] for m in r["modes"] if m["slope"] == 1]
                of[o] = median(plain[:10] if "10" in what else plain)
                if "energy" in what:
                    of[o] = r["median_decay_by_energy_per_s"]
        whole = all(o in of for o in ("steel", "ceramic", "polycarb", "wood"))
        kept = whole and of["steel"] < of["ceramic"] < min(of["polycarb"], of["wood"])
        verdict = "-" if not whole else "kept" if kept else "NOT KEPT"
        table(what, *(f"{of[o]:.1f}" if o in of else "-" for o in OBJECTS), verdict)

def lines():
    head("object", "the five strongest, with two standard errors")
    for o in OBJECTS:
        r = load(o)
        of = [m for m in r["modes"] if m["slope"] == 1][:5] if r else []
        table(o, "; ".join(f"{m['frequency_hz']:.1f} ± {2 * pick(m, 'frequency_se', 'frequency_error'):.1g} Hz, "
                           f"{m['decay_per_s']:.3g} ± {2 * pick(m, 'decay_se', 'decay_error'):.1g}/s" for m in of))

def said():
    for o in OBJECTS:
        r = load(o)
        for text in r["warnings"] if r else [told(o)]:
            if "level is relative" not in text:
                print(f"- {o}: {text.split('/')[-1] if '.wav: ' in text else text}")

globals()[sys.argv[1]](*sys.argv[2:])

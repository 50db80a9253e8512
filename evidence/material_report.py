#!/usr/bin/env python3
# material_report.py FOLDER: the tables of evidence/materials.md from FOLDER's *.fits (evidence/material_judge.c) and *.paper (rasp modes material --json).
import glob
import json
import math
import os
import re
import sys

folder = sys.argv[1]
TRUE_NU = {"steel": 0.29, "glass": 0.22, "porcelain": 0.19, "pvc": 0.38, "beech": 0.33}
rows, without, seconds = [], [], []
for name in ("plate", "bar", "ring", "bowl", "mug", "bracket"):
    path = os.path.join(folder, name + ".fits")
    for line in open(path) if os.path.exists(path) else []:
        w = line.split()
        solid, material, snr, place = w[0].split("-")
        if len(w) < 18 or w[1] in ("refused:", "no-table"):
            without.append((w[0], "no table of modes" if w[1] == "no-table" else "fewer than three modes match"))
            continue
        modes, matched, missing, sure = map(int, w[1:5])
        error = [abs(float(w[k])) for k in (7, 10, 13, 16)]
        error[1] *= TRUE_NU[material]
        seconds.append(float(w[27]))
        alpha = [float(w[k]) for k in (23, 24)]
        half = math.log(alpha[1] / alpha[0]) / 2 if alpha[1] > 0 and alpha[0] > 0 else math.nan
        rows.append((solid, material, snr, place, modes, matched, sure, error, [int(w[k]) for k in (8, 11, 14, 17)], w[18], half))


def share(hits):
    given = [h for h in hits if h >= 0]  # -1: the figure is not determined, and has no interval
    return "%d of %d" % (sum(given), len(given)) if given else "-"


def worst(values, form, scale=1.0):
    s = sorted(values)
    return "%s, %s" % (form % (scale * s[len(s) // 2]), form % (scale * s[-1])) if s else "-"


print("| solid | SNR | fits | with intervals | modes matched (least, median) | E/density, % (median, worst) | nu (median, worst) "
      "| alpha, % | half of alpha's interval, in logarithms, % | beta, % | intervals hold: E/density | nu | alpha | beta |")
print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
for snr, joint in (("60", False), ("30", False), ("60", True), ("30", True)):
    for solid in ("all",) if joint else ("plate", "bar", "ring", "bowl", "mug", "bracket", "all"):
        all_ = [r for r in rows if r[2] == snr and solid in (r[0], "all") and joint == (r[3] == "both")]
        sure = [r for r in all_ if r[6]]
        if not all_:
            continue
        matched = sorted(r[5] for r in all_)
        print("| %s | %s dB | %d | %d | %d, %d | %s | %s | %s | %s | %s | %s |" % (
            "all, of both places together" if joint else solid, snr, len(all_), len(sure), matched[0], matched[len(matched) // 2],
            worst([r[7][0] for r in sure], "%.3f", 100), worst([r[7][1] for r in sure], "%.4f"),
            worst([r[7][2] for r in sure], "%.1f", 100),
            worst([r[10] for r in sure if not math.isnan(r[10])], "%.1f", 100), worst([r[7][3] for r in sure], "%.1f", 100),
            " | ".join(share([r[8][k] for r in sure]) for k in range(4))))
for snr, wanted in (("60", 0.1), ("30", 0.3)):
    given = [r for r in rows if r[2] == snr and r[6]]
    narrow = [r for r in given if r[10] <= wanted]
    print("%sAt %s dB alpha is within %.0f %% in %d of %d; its interval is narrower than that in %d, and in these alpha is within it in %d." % (
        "\n" if snr == "60" else "", snr, 100 * wanted, sum(r[7][2] <= wanted for r in given), len(given), len(narrow),
        sum(r[7][2] <= wanted for r in narrow)))
unsure = [r for r in rows if not r[6]]
print("\n%d fits gave no interval, of which E/density was off by more than 1 %% in %d and by more than 0.1 %% in %d. %d recordings gave no fit%s" % (
    len(unsure), sum(r[7][0] > 0.01 for r in unsure), sum(r[7][0] > 0.001 for r in unsure), len(without),
    ": " + "; ".join("%s: %s" % w for w in without) + "." if without else "."))
wrong = [r for r in rows if r[6] and r[7][0] > 0.005]
print("With an interval, E/density was off by more than 0.5 %% in %d of %d%s" % (
    len(wrong), len(rows) - len(unsure), ": " + ", ".join("-".join(r[:4]) for r in wrong) + "." if wrong else "."))
print("A fit took %.1f s (median), %.1f s at most, after the finite elements." % (sorted(seconds)[len(seconds) // 2], max(seconds)))
laws = {}
for r in rows:
    laws[r[9]] = laws.get(r[9], 0) + 1
print("The law of least BIC was %s; the recordings all have Rayleigh's damping." % ", ".join("%s %d times" % (k, v) for k, v in sorted(laws.items(), key=lambda x: -x[1])))
papers = sorted(glob.glob(os.path.join(folder, "*.paper")))
if papers:
    print("\n| the paper's search, ten starts | true E/density | of its starts within 1 % | the best start's E/density | image, feature | metric computed |")
    print("|---|---|---|---|---|---|")
    total = 0
    for path in papers:
        try:
            r = json.load(open(path))
        except ValueError:
            continue
        truth = float(re.search(r"_([0-9.e+]+)\.paper$", path).group(1))
        ends = [e["youngs_modulus_per_density"] for e in r["endings"]]
        hits = sum(abs(x / truth - 1) < 0.01 for x in ends)
        total += hits
        print("| %s | %.4g | %d of %d | %.5g | %.3g, %.3g | %d times |" % (
            os.path.basename(path).split("_")[0], truth, hits, len(ends), r["youngs_modulus_per_density"]["value"],
            r["metric_image"], r["metric_feature"], r["evaluations"]))
    print("\n%d of the paper's %d starts land within 1 %% of the true E/density." % (total, 10 * len(papers)))

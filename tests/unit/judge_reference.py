#!/usr/bin/env python3
"""Reference values of test_anova.c and test_choices.c by NumPy, SciPy and statsmodels: prints judge_reference.h.
tests/cli/judge-scipy.sh holds the header against it. Data are drawn as drawn() draws, in C too."""
import textwrap

import numpy as np
import pandas as pd
from scipy import stats
from statsmodels.stats.anova import AnovaRM
from statsmodels.stats.proportion import proportion_confint
from statsmodels.stats.weightstats import ttost_paired


def drawn(seed, n):
    """Sums of three uniform numbers of Lehmer's generator, minus their mean."""
    x, out = seed, []
    for _ in range(n):
        total = 0.0
        for _ in range(3):
            x = x * 48271 % 2147483647
            total += x / 2147483647
        out.append(total - 1.5)
    return np.array(out)


def table(people, levels, seed):
    """[people][levels...]: noise, an effect of the first factor and an interaction of the last two, listeners' own offsets."""
    y = 10 * drawn(seed, people * int(np.prod(levels))).reshape([people] + levels)
    for at in np.ndindex(*y.shape):
        y[at] += 2.0 * at[1] + at[-1] * at[-2] + at[0] * (1 + 0.25 * at[-1])
    return y


def row(name, values):
    text = "static const double reference_%s[] = {%s};" % (name, ", ".join("%.17g" % v for v in values))
    print(textwrap.fill(text, 120, subsequent_indent="    "))


def epsilon(y, mask):
    """Greenhouse and Geisser's, from orthonormal contrasts."""
    contrast = np.ones((1, 1))
    for k, n in enumerate(y.shape[1:]):
        q, _ = np.linalg.qr(np.column_stack([np.ones(n), np.eye(n)[:, : n - 1]]))
        contrast = np.kron(contrast, q[:, 1:] if mask >> k & 1 else q[:, :1])
    s = np.atleast_2d(np.cov(y.reshape(len(y), -1) @ contrast, rowvar=False))
    return np.trace(s) ** 2 / (len(s) * np.trace(s @ s))


def anova(name, people, levels, seed):
    y = table(people, levels, seed)
    names = "abcdef"[: len(levels)]
    rows = [dict(zip("p" + names, at), y=y[at]) for at in np.ndindex(*y.shape)]
    found = AnovaRM(pd.DataFrame(rows), "y", "p", within=list(names)).fit().anova_table
    out = []
    for mask in range(1, 1 << len(levels)):
        r = found.loc[":".join(n for k, n in enumerate(names) if mask >> k & 1)]
        e = epsilon(y, mask)
        out += [r["Num DF"], r["Den DF"], r["F Value"], r["Pr > F"], e, stats.f.sf(r["F Value"], e * r["Num DF"], e * r["Den DF"])]
    row("anova_" + name, out)
    mean = y.reshape(people, -1, levels[-1]).mean(1)
    row("means_" + name, np.concatenate([mean.mean(0), stats.sem(mean, axis=0)]))


print("/* Made by judge_reference.py, which says how; tests/cli/judge-scipy.sh holds it against that. */\n#ifndef JUDGE_REFERENCE_H\n#define JUDGE_REFERENCE_H\n")
anova("four", 17, [2, 2, 3, 3], 7)
anova("two", 14, [5, 2], 11)
cases = [(q, k, df) for k, df in ((2, 1), (3, 2), (5, 52), (9, 64), (7, 234), (4, np.inf)) for q in (0.5, 3.5, 6.0)]
row("range", [v for q, k, df in cases for v in (q, k, df if df < np.inf else 0, stats.studentized_range.sf(q, k, df))])
row("wilson", [v for k, n in ((0, 16), (1, 71), (6, 16), (41, 62), (116, 116), (90, 183)) for v in (k, n) + proportion_confint(k, n, 0.05, "wilson")])
d = 20 * drawn(5, 12) + 3
exact = stats.permutation_test((d,), np.mean, permutation_type="samples", n_resamples=np.inf, alternative="two-sided")
tost = ttost_paired(d, np.zeros(12), -10, 10)
half = stats.sem(d) * stats.t.ppf(0.95, 11)
row("tests", [exact.pvalue, d.mean(), d.mean() - half, d.mean() + half, tost[0]])
chi = stats.chi2_contingency([[36, 34, 1], [57, 47, 4]], correction=False)
row("chi", [chi[0], chi[2], chi[1]])
m, o = (drawn(s, 25).reshape(5, 5) for s in (21, 22))
row("norms", [1 - np.linalg.norm(m - o, p) / np.linalg.norm(m, p) for p in (2, "fro")])
print("\n#endif")

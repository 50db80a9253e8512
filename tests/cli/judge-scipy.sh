# The reference values of test_anova.c and test_choices.c are what NumPy, SciPy and statsmodels give.
. "$ROOT/tests/lib/test.sh"
python=
for p in python3 /usr/bin/python3; do
    "$p" -c 'import numpy, pandas, scipy.stats, statsmodels.api' 2> /dev/null && python=$p && break
done
[ -n "$python" ] || skip "NumPy, SciPy and statsmodels are not installed"
"$python" -B "$ROOT/tests/unit/judge_reference.py" > made.h || fail "judge_reference.py failed"
# numbers one a line; other versions of these programs differ by rounding
numbers() { grep -v '^/\*' "$1" | grep -oE '[-+]?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?' > "$2"; }
numbers made.h made
numbers "$ROOT/tests/unit/judge_reference.h" kept
awk 'NR == FNR { kept[++n] = $1; next } { m++; d = $1 - kept[m]; if (d < 0) d = -d; a = kept[m] < 0 ? -kept[m] : kept[m]
        if (!(d <= 1e-9 * (a > 1 ? a : 1))) { print "number " m ": " kept[m] " is kept, " $1 " is right"; bad = 1 } }
    END { if (m != n || n < 100) { print n " numbers are kept, " m " are made"; bad = 1 } exit bad }' kept made || fail "the header is not what judge_reference.py prints"
rm -f made.h made kept
finish

# pandas and R read every table of an export without loss: names, labels and 64-bit seeds as texts, numbers to the last bit.
# shellcheck disable=SC1091
for python in python3 /usr/bin/python3; do $python -c 'import pandas' 2> /dev/null && break; python=; done
[ -n "$python" ] || { echo "no python3-pandas"; exit 77; }
command -v Rscript > /dev/null || { echo "no Rscript"; exit 77; }
. "$ROOT/tests/cli/export-make.inc"
for design in rate choose compare; do
    rasp export $design.yaml set_$design --for psychopy -o $design > /dev/null
    rasp export $design.yaml set_$design --for bids -o $design.bids > /dev/null
    rasp export $design.yaml set_$design --for audiofolder -o $design.audio > /dev/null
done
find . -path './*/*' \( -name '*.tsv' -o -name '*.csv' \) ! -name participants.tsv ! -path './set_*' | sort > tables
cat > read.R << 'END'
# Each table as R reads it by itself, each cell as a line: numbers in hexadecimal, so that no digit is lost.
for (f in readLines("tables")) {
    t <- if (grepl("tsv$", f)) read.delim(f, quote = "", check.names = FALSE) else read.csv(f, check.names = FALSE)
    for (n in names(t)) for (v in t[[n]]) cat(if (is.numeric(v)) sprintf("%.17g", v) else v, "\n", sep = "", file = paste0(f, ".R"), append = TRUE)
}
END
Rscript --vanilla read.R
cat > read.py << 'END'
import csv, pandas
seeds = 0
for f in open("tables").read().split():
    tabs = f.endswith("tsv")
    raw = list(csv.DictReader(open(f, encoding="utf-8"), delimiter="\t" if tabs else ",", quoting=csv.QUOTE_NONE if tabs else csv.QUOTE_MINIMAL))
    t = pandas.read_csv(f, sep="\t" if tabs else ",", quoting=3 if tabs else 0, float_precision="round_trip")
    r = iter(open(f + ".R", encoding="utf-8").read().split("\n"))
    assert list(t.columns) == list(raw[0]) and len(t) == len(raw), f
    for name in t.columns:
        for row, got in zip(raw, t[name]):
            want, also = row[name], next(r)
            if isinstance(got, str):
                assert got == want and also == want, (f, name, want, got, also)
            elif want == "n/a":
                assert pandas.isna(got) and also == want, (f, name, got, also)
            else:
                assert float(want) == float(got) == float(also) and name != "seed", (f, name, want, got, also)
            seeds += name == "seed" and int(want.lstrip("sn/a") or 0) > 2 ** 53
assert seeds > 10
print(len(open("tables").read().split()), "tables,", "seeds beyond 2^53 among them")
END
$python read.py

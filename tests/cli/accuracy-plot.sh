# rasp accuracy --plot: a picture in either format, whole; a scene whose settings all sound the same has one, too.
. "$ROOT/tests/lib/test.sh"
command -v gnuplot > /dev/null || skip "gnuplot is not installed"
cat > scene.yaml <<'YAML'
rasp: 1
title: it's a "scrape"
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], duration: 0.05 s}
output: {sample_rate: 16 kHz, quantity: force}
YAML
expect_exit 0 rasp accuracy scene.yaml --runs 1 --plot a.png --json
expect_exit 0 rasp accuracy scene.yaml --runs 1 --plot a.svg --csv a.csv --knobs
head -c 8 a.png | cmp - <(printf '\211PNG\r\n\032\n') || fail "a.png is no PNG"
expect_text a.svg '</svg>'
expect_text a.svg 'asked errors'
expect_text a.svg 'draft'
# Numbers at both horizontal axes: text in the middle of its place, which those of the other axis and of the curves are not.
numbers() { grep -A 1 'text-anchor="middle"' "$1" | grep -oE '>[0-9.]+<'; }
[ "$(numbers a.svg | wc -l)" -ge 6 ] || fail "the axes have fewer than three numbers each: $(numbers a.svg)"
# Labels of points, 10 pixels high: no two on one another.
overlaps() {
    awk -F'[(,)]' '
        /font-size="10.00"/ { x = $2; y = $3; next }
        /<text>/ && x != "" { gsub(/.*<text>|<\/text>.*/, ""); n++; X[n] = x; Y[n] = y; W[n] = 6 * length($0); T[n] = $0; x = "" }
        END {
            for (i = 1; i <= n; i++) for (k = 1; k < i; k++)
                if (X[i] < X[k] + W[k] && X[k] < X[i] + W[i] && (Y[i] - Y[k])^2 < 100) print T[i] " lies on " T[k]
            if (n < 6) print "only " n " labels"
        }' "$1"
}
[ -z "$(overlaps a.svg)" ] || fail "$(overlaps a.svg)"
expect_exit 0 rasp accuracy scene.yaml --runs 1 --set gain=0.5 --plot b.svg
rm -f a.png a.svg a.csv b.svg
expect_exit 73 rasp accuracy scene.yaml --runs 1 --csv a.csv --plot nowhere/a.png
expect_files scene.yaml
PATH=$BUILD expect_exit 69 "$BUILD/rasp" accuracy scene.yaml --runs 1 --csv a.csv --plot a.png
expect_files scene.yaml
finish

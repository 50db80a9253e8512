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
expect_exit 0 rasp accuracy scene.yaml --runs 1 --plot a.svg --csv a.csv
head -c 8 a.png | cmp - <(printf '\211PNG\r\n\032\n') || fail "a.png is no PNG"
expect_text a.svg '</svg>'
expect_text a.svg 'oversampling'
expect_text a.svg 'draft'
# Numbers under the axis: text in the middle of its place, which those of the other axis and of the curves are not.
numbers() { grep -A 1 'text-anchor="middle"' "$1" | grep -oE '>[0-9.]+<' | tr -d '<>' | sort -gu; }
[ "$(numbers a.svg | wc -l)" -ge 2 ] || fail "the axis has fewer than two numbers: $(numbers a.svg)"
expect_exit 0 rasp accuracy scene.yaml --runs 1 --set gain=0.5 --plot b.svg
rm -f a.png a.svg a.csv b.svg
expect_exit 73 rasp accuracy scene.yaml --runs 1 --csv a.csv --plot nowhere/a.png
expect_files scene.yaml
PATH=$BUILD expect_exit 69 "$BUILD/rasp" accuracy scene.yaml --runs 1 --csv a.csv --plot a.png
expect_files scene.yaml
finish

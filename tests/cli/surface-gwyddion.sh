# What rasp writes, Gwyddion opens, with its size and heights; what Gwyddion writes, rasp reads. Compared are all heights: rasp turns each .gwy that
# Gwyddion made into CSV.
command -v gwyddion > /dev/null || { echo "gwyddion is not installed"; exit 77; }
. "$ROOT/tests/cli/surface-make.inc"
export HOME=$PWD
gwy() { timeout 120 gwyddion --convert-to-gwy="$2" "$1" > gwyddion.log 2>&1 || { echo "gwyddion does not open $1"; cat gwyddion.log; exit 1; }; }
map > map.csv
rasp surface convert -q --pitch 20um --height-scale 1um map.csv map.npy
rasp surface convert -q --pitch 20um map.npy exact.csv

# compare NAME LIMIT: the largest difference of heights, in nm, is at most LIMIT; how large, is said to two digits
compare() {
    rasp surface convert -q "$1.gwy" "$1.csv"
    head -n 1 "$1.csv"
    paste -d '\n' exact.csv "$1.csv" | awk -F, -v limit="$2" -v name="$1" '/^#/ { next }
        ++n % 2 { split($0, a, ","); next }
        { for (i = 1; i <= NF; i++) { d = ($i - a[i]) * 1e9; if (d < 0) d = -d; if (d > worst) worst = d } }
        END { print name ": " n / 2 " rows", worst <= limit ? "as written" : "differ by " worst " nm" }'
}

rasp surface convert -q --pitch 20um map.npy gsf.gsf && gwy gsf.gsf gsf.gwy && compare gsf 0.0003      # float32 of 9 um: half of 2^-20 um
rasp surface convert -q --pitch 20um map.npy binary.sdf && gwy binary.sdf binary.gwy && compare binary 1e-9
rasp surface convert -q --text --pitch 20um map.npy text.sdf && gwy text.sdf text.gwy && compare text 1e-9
rasp surface convert -q --pitch 20um map.npy own.gwy && mv own.gwy rasp.gwy && gwy rasp.gwy own.gwy && compare own 0
rasp surface convert -q --pitch 20um map.npy grey.png && gwy grey.png grey.gwy && compare grey 0.15    # half a step of 65535

echo "-- missing points"
awk 'NR == 5 { sub(/^[^,]*/, "nan") } { print }' map.csv > holed.csv
for name in holed.gsf holed.gwy; do
    rasp surface convert -q --holes keep --pitch 20um --height-scale 1um holed.csv $name
    gwy $name back.gwy
    rasp surface info back.gwy | grep -e 'format' -e 'missing'
done

echo "-- a profile"
rasp surface convert -q --row 3 --pitch 20um map.npy profile.gsf
gwy profile.gsf profile.gwy
rasp surface info profile.gwy | grep -e samples -e pitch

# Mode tables of objects: places of every kind, quantities, recipe and scene, body, and what is refused; nothing half-written stays.
try() { local code=0; "$@" || code=$?; echo "exit code $code"; }
object() { rasp modes object "$@"; }
cat > bar.yaml << 'END'
title: a steel bar
source: made up
material: steel
object: {shape: bar, length: 30 cm, width: 2 cm, thickness: 5 mm, edges: supported}
END
cat > disk.yaml << 'END'
material: glass
object: {shape: disk, diameter: 20 cm, thickness: 2 mm, edges: clamped}
END
cat > scene.yaml << 'END'
rasp: 1
surface:
  material: oak
  object: {shape: plate, edges: supported, length: 30 cm, width: 20 cm, thickness: 5 mm, origin: [1 m, 2 m]}
scraper:
  mass: 5 g
  material: pvc
  object: {shape: rod, length: 20 cm, diameter: 8 mm, at: [2 cm, 0 cm]}
motion: {path: still, duration: 1 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}
END
# cells FILE COLUMN [WIDTH]: of the first place, cut to some digits
cells() { awk -F, -v c="$2" '!/^#/ && $1 == 1 { printf "%.6g ", $c } END { print "" }' "$1"; }

object bar.yaml --top 5kHz --at 15cm,1cm -o bar.csv
cat bar.csv
echo "supported bar, struck in the middle: modes 2, 4, 6 are silent; f ~ k^2; gain 2/m = $(awk 'BEGIN { printf "%.6g", 2 / (7850 * 0.3 * 0.02 * 0.005) }')"
cells bar.csv 5
cells bar.csv 7
for quantity in displacement velocity acceleration; do
    object bar.yaml --modes 2 --at 10cm,1cm --quantity $quantity -q -o $quantity.csv
    grep -E 'quantity|normal' $quantity.csv
    cells $quantity.csv 7
    cells $quantity.csv 8
done
object bar.yaml --line 0,0,30cm,0 --places 5 --modes 1 --listen 15cm,0 -q -o line.csv
awk -F, '!/^#/ { print $1, $2, $3, $7 != "gain" ? sprintf("%.6g", $7) : $7 }' line.csv
object disk.yaml --grid 5,5 --modes 3 --top 2kHz -o grid.csv
object disk.yaml --modes 3 --top 2kHz -o standard.csv
object scene.yaml --grid 2,3 --modes 1 -o plate.csv
awk -F, '!/^#/ { print $2, $3 }' plate.csv
object scene.yaml --body scraper -o rod.csv
grep -E '^# (object|material)' rod.csv
object scene.yaml --set surface.object.thickness=2mm --modes 1 -q -f -o plate.csv
cells plate.csv 5
rasp modes list bar.csv
rasp modes list --modes 2 scene.yaml
rasp modes list --modes 3 --body scraper scene.yaml

echo refused >&2
try object bar.yaml
try object bar.yaml -o bar.csv
try object missing.yaml -o x.csv
try object bar.yaml --at 40cm,1cm -o x.csv
try object bar.yaml --at 1cm -o x.csv
try object bar.yaml --at 1kg,0 -o x.csv
try object bar.yaml --at 1cm,0 --grid 3,3 -o x.csv
for grid in 1,3 3 3,3,3 '3,3 ' x,3 3,1001; do try object bar.yaml --grid "$grid" -o x.csv; done
try object bar.yaml --places 3 -o x.csv
try object bar.yaml --listen 1m,0 -o x.csv
try object bar.yaml --quantity pressure -o x.csv
try object bar.yaml --modes 0 -o x.csv
try object bar.yaml --top 1s -o x.csv
try object bar.yaml --top 1Hz -o x.csv
try object bar.yaml --body scraper -o x.csv
try object bar.yaml --body floor -o x.csv
try object bar.yaml --set surface.object.thickness=null -o x.csv
try object bar.yaml --set surface.object=null -o x.csv
try object bar.yaml -o nowhere/x.csv
try rasp modes
try rasp modes objetc bar.yaml
try rasp modes distil bar.yaml
try rasp modes list --grid 3,3 bar.yaml
try rasp modes list bar.csv bar.csv
try rasp modes list --set surface.object=null bar.yaml
ls x.* 2> /dev/null || true

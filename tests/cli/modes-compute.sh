# Solids by finite elements: shapes, what holds them, places of every kind, mesh files, a table that is current, and what is refused; nothing half-written stays.
try() { local code=0; "$@" || code=$?; echo "exit code $code"; }
compute() { rasp modes compute "$@"; }
# column FILE COLUMN DIGITS: of the first place
column() { awk -F, -v c="$2" -v d="$3" '!/^#/ && $1 == 1 { printf "%.*g ", d, $c } END { print "" }' "$1"; }
bar=bar:length=30cm,width=2cm,thickness=1cm,fineness=1

rasp modes compute --shape help
compute --shape $bar --material steel --modes 8 --at 0,1cm -o bar.csv
grep '^#' bar.csv | grep -v -e content -e inputs
echo "free bar, thin-bar theory for the first two of each direction: $(awk 'BEGIN {
    pi = atan2(0, -1); c = sqrt(210e9 / 7850); split("4.730040745 7.853204624", k)
    for (i = 1; i <= 2; i++) for (h = 0.01; h < 0.03; h += 0.01) printf "%.4g ", k[i] ^ 2 / 0.09 * c * h / sqrt(12) / (2 * pi) }') Hz"
column bar.csv 5 5
echo "at its end on the axis a bending mode has phi^2 = 4/m = $(awk 'BEGIN { printf "%.4g", 4 / (7850 * 0.3 * 0.02 * 0.01) }'), a turning one nothing"
column bar.csv 7 4

echo '== order: 2 is stiffer, 4 no more than 0.05 % below 3'
for order in 2 3 4; do
    compute --shape $bar --order $order --material steel --modes 2 --at 0,1cm -q --force -o order.csv
    column order.csv 5 5
    grep '^# holds' order.csv
done

echo '== estimate: free ball of order 2, closed form w R/c_s = 2.50113 (5 times), 2.646217 (5 times)'
compute --shape sphere:diameter=10cm --order 2 --youngs-modulus 200GPa --poisson 0.3 --density 7850 --loss 1e-6 --modes 10 --top 1MHz --at 1cm,2cm --estimate -o ball.csv
grep '^# estimate' ball.csv
echo "true errors, %:$(awk -F, '/^1,/ { f = $5 / (sqrt(200e9 / 2.6 / 7850) / 0.05 / 8 / atan2(1, 1)); printf " %+.2g", 100 * (f / ($4 < 6 ? 2.50113 : 2.646217) - 1) }' ball.csv)"
compute --shape sphere:diameter=10cm --order 2 --youngs-modulus 200GPa --poisson 0.3 --density 7850 --loss 1e-6 --modes 10 --top 1MHz --at 1cm,2cm --estimate -o ball.csv
try compute --shape sphere:diameter=10cm,fineness=1 --material steel --modes 10 --top 1MHz --at 1cm,2cm --estimate -o x.csv

echo '== held'
compute --shape $bar --material steel --clamp x0 --modes 3 --at 30cm,1cm -q -o clamped.csv
echo "clamped at one end: $(awk 'BEGIN { pi = atan2(0, -1); for (h = 0.01; h < 0.03; h += 0.01) printf "%.4g ", 1.875104069 ^ 2 / 0.09 * sqrt(210e9 / 7850) * h / sqrt(12) / (2 * pi) }') Hz"
column clamped.csv 5 5
grep -E '^# (clamped|supported)' clamped.csv
compute --shape $bar --material steel --support x0 --support x1 --modes 3 --at 15cm,1cm -q -o hinged.csv
echo "hinged at both: $(awk 'BEGIN { pi = atan2(0, -1); for (h = 0.01; h < 0.03; h += 0.01) printf "%.4g ", pi ^ 2 / 0.09 * sqrt(210e9 / 7850) * h / sqrt(12) / (2 * pi) }') Hz"
column hinged.csv 5 5
grep -E '^# (clamped|supported)' hinged.csv

echo '== places'
ring=ring:diameter=10cm,width=1cm,thickness=1cm,fineness=1
places() { awk -F, '!/^#/ && $1 ~ /^[0-9]+$/ && !($1 in seen) { seen[$1]; n++; if (n <= 2) printf "(%.4g, %.4g) ", $2, $3 } END { print n, "places" }' "$1"; }
compute --shape $ring --material glass --modes 4 --grid 17,9 -q -o grid.csv
places grid.csv
compute --shape $ring --material glass --modes 4 --circle 4.5cm --places 8 -q -o circle.csv
places circle.csv
for shape in "$ring" bowl:diameter=10cm,height=4cm,thickness=5mm,fineness=1; do # rings, of a bowl to its lip
    compute --shape $shape --material glass --order 2 --modes 10 -q --force -o round.csv
    awk '/^# rings: / { rings++ } /^# interpolation_error: / { told = $3 } END { exit !(rings == 1 && told <= -40) }' round.csv ||
        echo "$shape: $(grep '^# rings\|^# interpolation' round.csv)"
done
compute --shape $ring --material glass --modes 4 --face around --line 0,5mm,10cm,5mm --places 5 --origin 1m,2m -q -o around.csv
places around.csv
grep '^# places' around.csv
printf 'x_m,y_m,z_m,u_m,v_m\n0.05,0,0.005,0,0\n0,0.05,0.005,0.01,0\n' > points.csv
compute --shape $ring --material glass --modes 4 --points points.csv --listen 5cm,0,5mm -q -o points-table.csv
places points-table.csv
grep heard points-table.csv
echo 'the first of the two is heard at itself, the second where the first is, a quarter round: gains of the same size, for two modes in the plane'
awk -F, '!/^#/ && $4 ~ /^[0-9]/ { printf "%.3f ", $7 < 0 ? -$7 : $7 } $4 == 4 { print "" }' points-table.csv
compute --shape $ring --material glass --modes 1 --at 4.5cm,0 --quantity acceleration -q -o acceleration.csv
grep -E 'quantity|normalisation' acceleration.csv

echo '== damping'
compute --shape $bar --youngs-modulus 3GPa --poisson 0.4 --density 1400 --alpha 3000 --beta 0 --modes 6 --at 0,1cm -o slack.csv
grep -E '^# (material|damping|source)' slack.csv
echo "decays are alpha/2:$(awk -F, '!/^#/ && $1 == 1 { printf " %.9g", $6 }' slack.csv)"
compute --shape plate:length=30cm,width=5cm,thickness=1cm,fineness=1 --material oak --modes 2 --at 0,1cm -q -o oak.csv
grep '^# material' oak.csv

echo '== a table that is current'
cp bar.csv before.csv
compute --shape $bar --material steel --modes 8 --at 0,1cm -o bar.csv
cmp bar.csv before.csv
try compute --shape $bar --material steel --modes 7 --at 0,1cm -o bar.csv
sed -i 's/,588/,589/' bar.csv
try compute --shape $bar --material steel --modes 8 --at 0,1cm -o bar.csv
compute --shape $bar --material steel --modes 8 --at 0,1cm -q --force -o bar.csv
cmp bar.csv before.csv

echo '== mesh files'
# cubes NX NY NZ SIZE: cells of a box, each of six tetrahedra round its diagonal, as MSH 2.2
cubes() {
    awk -v X="$1" -v Y="$2" -v Z="$3" -v size="$4" 'function node(x, y, z) { return 1 + x + (X + 1) * (y + (Y + 1) * z) }
        BEGIN {
            print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" (X + 1) * (Y + 1) * (Z + 1)
            for (z = 0; z <= Z; z++) for (y = 0; y <= Y; y++) for (x = 0; x <= X; x++) print node(x, y, z), x * size, y * size, z * size
            print "$EndNodes\n$Elements\n" 6 * X * Y * Z
            split("xyz xzy yxz yzx zxy zyx", way, " ")
            for (z = 0; z < Z; z++) for (y = 0; y < Y; y++) for (x = 0; x < X; x++) for (w = 1; w <= 6; w++) {
                at["x"] = x; at["y"] = y; at["z"] = z
                line = node(x, y, z)
                for (i = 1; i <= 3; i++) { at[substr(way[w], i, 1)]++; line = line " " node(at["x"], at["y"], at["z"]) }
                if (w == 2 || w == 3 || w == 6) { split(line, p, " "); line = p[1] " " p[3] " " p[2] " " p[4] }
                print ++n, 4, 2, 0, 1, line
            }
            print "$EndElements"
        }'
}
cubes 10 2 1 1 > bar.msh
try compute bar.msh --material steel --modes 3 --at 0,1cm -o mesh.csv
compute bar.msh --unit cm --material steel --modes 3 --at 0,1cm -o mesh-cm.csv
column mesh-cm.csv 5 5
grep '^# note' mesh-cm.csv
cp bar.msh "$(printf 'a\033b.msh')"
compute "$(printf 'a\033b.msh')" --unit cm --material steel --modes 3 --at 0,1cm -o "$(printf 'a\033b.csv')"
try compute bar.msh --unit cm --material steel --modes 3 --at 0,1cm --estimate -o x.csv
compute bar.msh --unit cm --material steel --modes 3 --at 0,1cm --order 3 --estimate -o mesh-cm.csv --force
grep '^# estimate' mesh-cm.csv
sed 's/ 4 2 0 1 \([0-9]*\) \([0-9]*\)/ 4 2 0 1 \2 \1/' bar.msh > turned.msh
compute turned.msh --unit cm --material steel --modes 3 --at 0,1cm -o turned.csv
sed '/^7 4 2/s/ 4 2 0 1 \([0-9]*\) \([0-9]*\)/ 4 2 0 1 \2 \1/' bar.msh > one.msh
try compute one.msh --unit cm --material steel -o one.csv
sed -e '/^3[1-6] 4 2/d' -e '/^9[1-6] 4 2/d' -e 's/^120$/108/' bar.msh > split.msh
try compute split.msh --unit cm --material steel -o x.csv
head -50 bar.msh > short.msh
try compute short.msh --material steel -o short.csv

echo '== refused'
try compute -o x.csv
try compute --shape $bar -o x.csv
try compute --shape $bar --material wodo -o x.csv
try compute --shape $bar --material bronze -o x.csv
try compute --shape brick:length=1m --material steel -o x.csv
try compute --shape bar:length=30cm,width=2cm --material steel -o x.csv
try compute --shape bar:length=30cm,width=2cm,thickness=-1mm --material steel -o x.csv
try compute --shape $bar --material steel --poisson 0.5 -o x.csv
try compute --shape $bar --material oak --poisson 0.3 -o x.csv
try compute --shape $bar --youngs-modulus 3GPa --poisson 0.4 --density 1400 -o x.csv
try compute --shape $bar --material steel --clamp x2 -o x.csv
try compute --shape $bar --material steel --order 5 -o x.csv
try compute --shape $bar --material steel --top 100Hz -o x.csv
try compute --shape $bar --material steel --at 40cm,0 -o x.csv
try compute --shape $bar --material steel --face side -o x.csv
try compute --shape $bar --material steel --listen 1m,1m,1m -o x.csv
try compute --shape $bar --material steel --points points.csv --line 0,0,1cm,0 -o x.csv
try compute --shape $bar --youngs-modulus 3GPa --poisson 0.4 --density 1400 --alpha 1e6 -o x.csv
try compute --shape $bar --material steel
try compute bar.msh $bar --material steel -o x.csv
try compute missing.msh --material steel -o x.csv
try compute scene.yaml --material steel -o x.csv
[ ! -e x.csv ]
rm -f ./*.csv ./*.msh

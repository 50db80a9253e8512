# `rasp modes compute`, what is given by mistake: wrong units, outputs that are inputs or no files, places twice, lists of points without their own places, hollow solids' size.
try() { local code=0; timeout -k 5 60 rasp modes "$@" || code=$?; echo "exit code $code"; }
bar=bar:length=30cm,width=2cm,thickness=1cm,fineness=1
steel() { try compute --material steel --modes 2 "$@"; }
# tetrahedron SIZE: one, as MSH 2.2; tetrahedron SIZE surface: its faces alone
tetrahedron() {
    printf '%s\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$Nodes' 4 '1 0 0 0' "2 $1 0 0" "3 0 $1 0" "4 0 0 $1" '$EndNodes' '$Elements'
    if [ "${2-}" ]; then printf '%s\n' 2 '1 2 2 1 1 1 3 2' '2 2 2 1 1 1 2 4'; else printf '%s\n' 1 '1 4 2 0 1 1 2 3 4'; fi
    echo '$EndElements'
}

echo '== points without u_m,v_m, with both, with one of them'
printf 'x_m,y_m,z_m\n0.1,0.01,0.01\n0.2,0.01,0.01\n' > points.csv
printf 'x_m,y_m,z_m,v_m,u_m\n0.1,0.01,0.01,3,1\n0.2,0.01,0.01,3,2\n' > both.csv
printf 'x_m,y_m,z_m,u_m\n0.1,0.01,0.01,1\n' > u.csv
printf 'x_m,y_m,z_m,v_m\n0.1,0.01,0.01,1\n' > v.csv
for list in points both u v; do
    steel --shape $bar --points $list.csv -q -o $list-table.csv
    [ ! -e $list-table.csv ] || grep -v '^#' $list-table.csv | cut -d , -f 1-4
done

echo '== radius_m of a hollow ball: of its outside, as of a shell; and of a solid one'
printf 'material: steel\nobject: {shape: shell, diameter: 12 cm, thickness: 2 mm}\n' > shell.yaml
try object shell.yaml --at 0,0 -q -o shell.csv
steel --shape sphere:diameter=12cm,wall=2mm,fineness=1 --at 0,0 -q -o hollow.csv
steel --shape sphere:diameter=12cm,fineness=1 --top 1MHz --at 0,0 -q -o solid.csv
for ball in shell hollow solid; do awk '/^# radius_m/ { printf "%.3f m\n", $3 }' $ball.csv; done

echo '== units'
tetrahedron 80 > mm.msh
tetrahedron 4 > large.msh
steel mm.msh -o x.csv
steel mm.msh --unit mm --top 1MHz --at 2cm,2cm -q -o mm.csv
steel large.msh --at 1,1 -o large.csv
grep '^# note: the solid' large.csv
steel --shape bar:length=300,width=20,thickness=10 -o x.csv
steel --shape bar:length=0.3mm,width=0.02mm,thickness=0.01mm -o x.csv
steel --shape $bar --density 7.85 --at 0,0 --top 1MHz -o light.csv
steel --shape $bar --density 0.785 -o x.csv
steel --shape $bar --youngs-modulus 210 -o x.csv
steel --shape $bar --youngs-modulus 1e-300 -o x.csv
steel --shape $bar --youngs-modulus 1e14 -o x.csv
steel --shape $bar --poisson 0.4999999 -o x.csv
tetrahedron 0.08 surface > surface.msh
steel surface.msh -o x.csv

echo '== outputs that are no files, or inputs'
mkfifo pipe
steel --shape $bar -o pipe
steel --shape $bar -f -o pipe
steel --shape $bar -f -o /dev/zero
steel --shape $bar -f -o /dev/full
steel --shape $bar -o nowhere/x.csv
ln mm.msh link.msh
cp mm.msh before.msh
steel mm.msh --unit mm -f -o ./mm.msh
steel mm.msh --unit mm -f -o link.msh
cmp mm.msh before.msh
printf '4 3 0 0\n1 0 0 0\n2 0.1 0 0\n3 0 0.1 0\n4 0 0 0.1\n' > t.node
printf '1 4 0\n1 1 2 3 4\n' > t.ele
steel t.node -f -o t.ele
steel --shape $bar --points points.csv -f -o points.csv
try object shell.yaml --at 0,0 -f -o shell.yaml
printf '%s\n' 'rasp: 1' 'surface: {recipe: shell.yaml}' 'scraper: {mass: 1 g}' 'motion: {path: still, duration: 1 s}' \
    'contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}' > scene.yaml
try object scene.yaml --at 0,0 -f -o shell.yaml
head -qn 1 shell.yaml points.csv t.ele

echo '== places twice, too many, beside the axis'
printf 'x_m,y_m,z_m\n0.1,0.01,0.01\n0.2,0.01,0.01\n0.1,0.01,0\n' > twice.csv
steel --shape $bar --points twice.csv -o x.csv
steel --shape $bar --line 0,0,0,0 -o x.csv
try object shell.yaml --line 0,0,0,0 -o x.csv
steel --shape $bar --grid 1000,1000 -o x.csv
steel --shape $bar --grid 1000,101 -o x.csv
steel --shape $bar --face around -o x.csv
steel --shape ring:diameter=10cm,width=1cm,thickness=1cm,fineness=1 --face inside --at 0,5cm -o x.csv

echo '== heavy damping: the least and the greatest frequency, not those of the first and the last mode'
try compute --shape $bar --material steel --beta 5.1e-5 --modes 8 --at 0,0 -o slack.csv
awk -F, '/^1,/ { f = $5; low = low && low < f ? low : f; high = high > f ? high : f } END { printf "%.6g to %.6g, last %.6g Hz\n", low, high, f }' slack.csv

echo '== a title of two lines is one'
steel --shape $bar --title "$(printf 'a\nplace,x_m')" --at 0,0 -q -o title.csv
grep '^# title' title.csv
grep -c '^place' title.csv
[ ! -e x.csv ]
rm -f ./*.csv ./*.msh ./*.yaml t.node t.ele pipe

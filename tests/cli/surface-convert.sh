# Through every format and back: the heights stay the same to the bit, where the format has the bits.
. "$ROOT/tests/cli/surface-make.inc"
map > map.csv
rasp surface convert --pitch 20um --height-scale 1um map.csv a.gsf
rasp surface convert a.gsf b.gwy
rasp surface convert b.gwy c.sdf
rasp surface convert --text c.sdf d.sdf
rasp surface convert d.sdf e.npy
rasp surface convert --pitch 20um e.npy f.csv
rasp surface convert --pitch 20um f.csv g.gsf
cmp a.gsf g.gsf
head -n 15 d.sdf
rasp surface convert a.gsf h.png
rasp surface convert --pitch 20um --height-range 10um h.png i.csv
rasp surface convert -q a.gsf j.GSF
cmp a.gsf j.GSF

echo "-- parts"
rasp surface convert --pitch 1mm --height-scale 1um map.csv part.csv --crop 10mm,5mm,3mm,2mm
cat part.csv
rasp surface convert --pitch 1mm --height-scale 1um map.csv row.csv --row 7
rasp surface convert --pitch 1mm row.csv end.csv --crop 3.6cm,4mm --levelling mean
cat end.csv

echo "-- holes"
printf '1,2,3,4\n2,,4,5\n3,4,5,6\n4,5,6,7\n' > holed.csv
rasp surface convert --pitch 20um --height-scale 1um holed.csv x.gsf || echo "exit code $?"
ls x.gsf 2> /dev/null || echo "nothing written"
rasp surface convert --pitch 20um --height-scale 1um --holes fill holed.csv filled.csv
cat filled.csv
for name in k.gsf k.gwy k.sdf k.npy k.csv; do
    rasp surface convert -q --pitch 20um --height-scale 1um --holes keep holed.csv $name
    case $name in k.npy | k.csv) pitch="--pitch 20um" ;; *) pitch= ;; esac
    rasp surface info $pitch $name | grep 'missing points  '
done

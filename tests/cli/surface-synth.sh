# Procedural surfaces as files: a profile and a map of the same recipe, seeds, the scene's keys, every format, and what is refused.
try() { local code=0; "$@" || code=$?; echo "exit code $code"; }
synth() { rasp surface synth --pitch 5um "$@"; }
cat > wood.yaml << 'END'
title: wood
source: made up
roughness: {rms: 4 um, exponent: -2.4}
END
synth --size 5mm --seed 3 wood.yaml a.gsf
synth --size 1mmx0.5mm wood.yaml b.gwy
synth --size 5mm --along plane --set surface.roughness.grain=3 wood.yaml c.npy
synth --size 5mm --quiet --seed 3 wood.yaml again.gsf
cmp a.gsf again.gsf
synth --size 5mm --quiet --seed 4 wood.yaml other.gsf
cmp -s a.gsf other.gsf || echo "seed 4 is another surface"
rasp surface info a.gsf b.gwy | grep -E 'samples|size|pitch|[SR]q'
cat > scene.yaml << 'END'
rasp: 1
seed: 3
surface: {recipe: wood.yaml}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], speed: 10 cm/s}
output: {diagnostics: {}}
END
synth --size 5mm --quiet scene.yaml same.gsf
rasp surface convert a.gsf a.csv --quiet
rasp surface convert same.gsf same.csv --quiet
cmp a.csv same.csv
for shape in sine round groove; do
    synth --size 2mm --set surface.roughness=null --set "surface.ridges={spacing: 0.5 mm, shape: $shape}" wood.yaml $shape.csv
done
synth --size 2mmx1mm --set surface.roughness=null --set 'surface.grit={density: 20 /mm^2}' wood.yaml grit.sdf
rasp surface synth --size 1mmx1mm --pitch 10um --set surface.roughness.skewness=-1 --set surface.roughness.kurtosis=5 wood.yaml valleys.gsf
echo "roughness: {like: a.gsf, grain: 2}" > like.yaml
synth --size 5mm --along plane like.yaml like.gsf

echo refused >&2
try synth wood.yaml x.gsf
try synth --size 5kg wood.yaml x.gsf
try synth --size 10um wood.yaml x.gsf
try synth --size 10mx10m wood.yaml x.gsf
try synth --size 5mm wood.yaml x.tif
try synth --size 5mm missing.yaml x.gsf
try synth --size 5mmx5mm --along path wood.yaml x.gsf
try synth --size 5mm --along sideways wood.yaml x.gsf
try synth --size 5mm --row 3 wood.yaml x.gsf
try synth --size 5mmx5mm --set surface.roughness.exponent=2 wood.yaml x.gsf
try synth --size 5mm --set surface.roughness.skewness=2 wood.yaml x.gsf
try synth --size 5mm --set surface.roughness=null wood.yaml x.gsf
try synth --size 5mm --set surface.roughness=null --set 'surface.grit={density: 1e12}' wood.yaml x.gsf
try synth --size 5mm --set surface.height_map=a.gsf wood.yaml x.gsf
ls x.* 2> /dev/null
true

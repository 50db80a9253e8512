# A recipe's keys stand under the scene's own; the effective scene holds them all, names the recipe only among its inputs, and is the
# effective scene of itself, also when the recipe has gone (but is then missing).
try() { local code=0; "$@" || code=$?; echo "$code"; }
mkdir recipes
cat > recipes/paper.yaml << 'END'
title: sandpaper
source: made up
roughness: {rms: 2 um, exponent: -3}
grit: {density: 30 /mm^2, height: 50 um}
END
cat > scene.yaml << 'END'
rasp: 1
surface: {recipe: recipes/paper.yaml, roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: polyline, points: [[0, 0], [3 cm, 1 cm], [5 cm, 0]], corner: 5 mm, speed: 10 cm/s, law: two_thirds}
output: {diagnostics: {}}
END
rasp explain scene.yaml > effective.yaml
grep -n 'recipe\|rms\|exponent\|density\|points\|law\|sha256' effective.yaml
rasp explain effective.yaml | cmp - effective.yaml
rasp explain --set surface.grit=null scene.yaml | grep -c grit || true
echo 'rouhgness: {}' >> recipes/paper.yaml
try rasp explain scene.yaml
rm recipes/paper.yaml
try rasp explain scene.yaml
rasp explain effective.yaml | grep -A 1 'paper.yaml'

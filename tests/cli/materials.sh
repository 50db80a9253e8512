# Materials of a scene's own: the same bytes as the object's own constants; an effective scene; impacts; what is refused.
try() { local code=0; "$@" || code=$?; echo "exit code $code"; }
cat > mine.yaml << 'END'
materials:
  pane: {youngs_modulus: 68 GPa, poisson: 0.21, density: 2480 kg/m^3, alpha: 4 1/s, beta: 3e-8 s, loss: 1e-4, source: fitted}
  light: {wave_speed: 5200 m/s, poisson: 0.3, alpha: 7 1/s}
  board: {youngs_modulus: 12 GPa, density: 600 kg/m^3, like: oak, loss: 0.01}
END
scene() { # scene FILE SURFACE-LINES...
    local file=$1
    shift
    {
        echo 'rasp: 1'
        echo 'include: [mine.yaml]'
        echo 'surface:'
        printf '  %s\n' "$@"
        echo 'scraper: {mass: 4 g, radius: 5 mm, material: steel}'
        echo 'motion: {path: still, at: [4 cm, 3 cm], duration: 0.1 s}'
        echo 'contact: {model: strike, strike: {speed: 1 m/s}}'
        echo 'output: {level: {peak: -3 dB}, tail: 0.2 s}'
    } > "$file"
}
sizes='shape: plate, length: 30 cm, width: 20 cm, thickness: 4 mm'
scene named.yaml 'material: pane' "object: {$sizes}"
scene figures.yaml "object: {$sizes, youngs_modulus: 68 GPa, poisson: 0.21, density: 2480, alpha: 4, beta: 3e-8, loss: 1e-4}"
rasp render named.yaml -q -o named.wav
rasp render figures.yaml -q -o figures.wav
cmp named.wav figures.wav && echo 'by name as by figures'
rasp explain named.yaml > effective.yaml
sed -n '/^materials:/,/^[^ m]/p' effective.yaml | head -9
rasp render effective.yaml -q -o effective.wav
cmp named.wav effective.wav && echo 'effective scene: the same'

# The density of the object makes the modulus of a material whose speed of waves is known.
scene light.yaml 'material: light' "object: {$sizes, density: 2000}"
scene heavy.yaml "object: {$sizes, youngs_modulus: 54.08 GPa, poisson: 0.3, density: 2000, alpha: 7}"
rasp render light.yaml -q -o light.wav
rasp render heavy.yaml -q -o heavy.wav
cmp light.wav heavy.wav && echo 'wave_speed: E = density x wave_speed^2'
# A wood keeps the ratios of its moduli; an object's own figures win.
scene board.yaml 'material: board' "object: {$sizes, loss: 0.02}"
rasp modes object board.yaml --top 500Hz --at 4cm,3cm -o board.csv -q
grep -E '^# (material|damping)' board.csv
rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material mine.yaml:board --modes 4 -q -o bar.csv
grep '^# material' bar.csv

# A ball's mass, and the stiffness of a contact on a surface that rings from a table.
sed -e 's/^scraper.*/ball: {radius: 5 mm, material: pane}/' -e 's/model: strike, .*/model: roll}/' -e 's/still, at.*dur/line, from: [4 cm, 3 cm], to: [6 cm, 3 cm], dur/' named.yaml > ball.yaml
sed -i 's/^surface:/surface:\n  roughness: {rms: 2 um}/' ball.yaml
rasp explain ball.yaml | grep -E '^  (mass|material)'

for say in 's/material: pane/material: pain/' 's/^include.*/materials: {pane: 3}/' 's/^include.*/materials: [pane]/' \
    's/^include.*/materials: {pane: {youngs_modulus: 68, poisson: 0.2, beta: -1, hue: 2}}/' \
    's/^include.*/materials: {steel: {youngs_modulus: 68 GPa, poisson: 0.2, alpha: 1}}/' \
    's/^include.*/materials: {pane: {youngs_modulus: 68 GPa, alpha: 1}}/' \
    's/^include.*/materials: {pane: {youngs_modulus: 68 GPa, poisson: 0.2}}/' \
    's/^include.*/materials: {pane: {poisson: 0.2, alpha: 1}}/' \
    's/^include.*/materials: {pane: {youngs_modulus: 68 GPa, poisson: 0.2, like: steel, alpha: 1}}/' \
    's/material: pane/material: light/'; do
    sed "$say" named.yaml > bad.yaml
    try rasp check bad.yaml
done
try rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material mine.yaml --modes 4 -q -o bar2.csv
try rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material mine.yaml:light --modes 4 -q -o bar2.csv
try rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material mine.yaml:glas --modes 4 -q -o bar2.csv
try rasp modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material named.yaml --modes 4 -q -o bar2.csv

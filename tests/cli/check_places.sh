# What is found only when the files are opened is told with the place of the key that names them: in the scene, in a file it includes, on the command
# line; of one of several contacts.
cat > a.yaml <<'X'
rasp: 1
surface:
  response: t.csv
  gammatone: 2
motion: {path: line, from: [0, 0], to: [10 cm, 0], duration: 0.1 s}
scraper: {mass: 10 g}
contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}
X
table() {
    printf '# poles: %s\n# pairing: ids\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n' "$1"
    printf '1,0,0,1,440,%s,1,0\n2,0.1,0,1,%s,%s,1,0\n' "$2" "$3" "$2"
}
tell() {
    local code=0
    rasp check "$@" || code=$?
    echo "$code"
}
table shared 5 440 > t.csv
tell --set surface.moving=fixed a.yaml
tell --set surface.convolution=nodes a.yaml
tell --set surface.extrapolate=error --set motion.to='[20 cm, 0]' a.yaml
table shared 0 440 > t.csv
tell a.yaml
table separate 0 450 > t.csv
tell a.yaml
rasp plan a.yaml || echo plan "$?"
rasp render a.yaml -o out/ || echo render "$?"
table separate 5 450 > t.csv
tell --set surface.convolution=resonators a.yaml
tell --set surface.moving=fixed a.yaml
rm t.csv
tell a.yaml

# a given force that is not there is told before the scale that it needs
table shared 5 440 > t.csv
printf 'rasp: 1\ninclude: [part.yaml]\ncontacts:\n- name: rod\n  contact:\n    model: given\n    given: {file: no.wav}\n  motion: {path: still, duration: 1 s}\n' > b.yaml
printf 'output:\n  tail: 0\n' > part.yaml
printf '  surface: {response: gone.csv}\n' >> b.yaml
tell b.yaml

# from an included file
printf 'surface:\n  response: t.csv\n' > part.yaml
printf 'rasp: 1\ninclude: [part.yaml]\nmotion: {path: line, from: [0, 0], to: [10 cm, 0], duration: 0.1 s}\nscraper: {mass: 10 g}\ncontact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}\n' > c.yaml
echo 'no table' > t.csv
tell c.yaml

# a word and a knob that are no longer there, with what to write instead
printf 'rasp: 1\nsurface:\n  object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 2.5 mm, edges: supported}\n  material: steel\n' > d.yaml
printf '  convolution: nodes\nmotion: {path: line, from: [1 cm, 2 cm], to: [10 cm, 2 cm], duration: 0.1 s}\nscraper: {mass: 10 g}\ncontact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}\n' >> d.yaml
printf 'accuracy: {preset: high, morph_error: -80, overlap_hop: 3 ms}\n' >> d.yaml
tell d.yaml

# An object, and the table of its modes at the place that is struck: the same sound, whichever quantity the table holds. (Tables hold 12 digits, errors of up to 5e-13 in a frequency: over 0.2 s some -190 dB.)
cat > object.yaml << 'END'
rasp: 1
surface:
  material: poplar
  object: {shape: plate, edges: supported, length: 40 cm, width: 10 cm, thickness: 4 mm, origin: [1 cm, 2 cm]}
  modes: 10000
scraper: {mass: 5 g}
motion: {path: still, at: [15 cm, 3.7 cm], duration: 0.1 s}
contact: {model: strike, strike: {pulse: half_sine, speed: 0.3 m/s, stiffness: 1e6}}
output: {sample_rate: 48 kHz, encoding: float64, level: {full_scale: 1}, tail: 0.1 s}
END
for quantity in velocity displacement; do
    rasp render --quiet --set output.quantity=$quantity -o $quantity.wav object.yaml 2> /dev/null
    rasp modes object --at 14cm,1.7cm --top 23.95kHz --quantity $quantity -q -o $quantity.csv object.yaml
    sed "/^surface:/,/modes:/c\\surface: {response: $quantity.csv, modes: 10000}" object.yaml > table.yaml
    rasp render --quiet -o table.wav table.yaml
    rasp compare --snr 180 $quantity.wav table.wav | grep snr | cut -c1-10
done

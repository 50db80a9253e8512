# What is refused when stages are opened has its place, and says what to do: also where no key stands at the head of the message, or none of those that matter is given.
# scene NAME: of standard input, with the head that all have.
scene() { { echo 'rasp: 1'; cat; } > "$1.yaml"; }
tell() { rasp "$@" > log 2>&1 || grep error: log | cut -c1-260; }
scene ball << 'YAML'
surface: {roughness: {rms: 3 um, longest: 1 mm, shortest: 10 um}, along: plane}
ball: {radius: 40 cm, mass: 1 kg, patch: 20 um}
motion: {path: line, to: [5 cm, 0], speed: 10 cm/s}
contact: {model: roll, roll: {stiffness: 1e8}}
output: {quantity: force}
YAML
scene tip << 'YAML'
contacts:
  - name: pen
    surface: {roughness: {rms: 3 um, longest: 1 mm, shortest: 4 um}, along: plane}
    scraper: {mass: 10 g, patch: 1 um,
              radius: 10 cm}
    motion: {path: line, to: [5 cm, 0], speed: 10 cm/s}
output: {quantity: force}
YAML
printf '%s\n' time_s,x_m,y_m 0,0,0 0.0025,0.0005,0 0.005,0.001,0 > short.csv
scene ends << 'YAML'
surface: {roughness: {}}
scraper: {mass: 10 g}
motion: {path: recorded, file: short.csv, cutoff: 0 Hz}
load: {constant: 1 N,
       release: 10 ms}
output: {quantity: force}
YAML
sed 's/load:.*/load: {constant: 1 N}/; /release/d' ends.yaml > auto.yaml
scene late << 'YAML'
surface: {object: {shape: plate, length: 10 cm, width: 10 cm, thickness: 3 mm}, material: glass}
scraper: {mass: 10 g, radius: 5 mm, material: steel}
motion: {path: still, at: [5 cm, 5 cm],
         duration: 10 ms}
contact: {model: strike, strike: {first: 9.99 ms, speed: 1 m/s}}
YAML
scene off << YAML
surface: {height_map: $ROOT/surfaces/basswood.gsf, off_map: error}
scraper: {mass: 10 g}
motion: {path: line, to: [30 m, 0], speed: 10 m/s}
output: {quantity: force}
YAML
scene steps << 'YAML'
surface: {fractal: {maximum: 1 um}}
ball: {radius: 1 cm, mass: 10 g}
motion: {path: line, to: [5 cm, 0], speed: 10 cm/s}
contact: {model: roll_coupled, roll: {ground: rigid, stiffness: 1e17}}
output: {quantity: force}
YAML
{ cat steps.yaml; printf '%s\n' 'accuracy: {oversampling: 4,' '           contact_steps: 300}'; } > knob.yaml
scene small << 'YAML'
surface: {object: {shape: plate, length: 1 mm, width: 1 mm, thickness: 1 mm}, material: steel}
motion: {path: still, at: [0.4 mm, 0.3 mm], duration: 100 ms}
scraper: {mass: 10 g}
contact: {model: strike, strike: {stiffness: 1e6, pulse: half_sine, speed: 1 m/s}}
YAML
printf '%s\n' time_s,x_m,y_m 3,0,0 4,0.1,0 > motion.csv
printf '%s\n' time_s,force_n 0,0 3.5,1 4,0 > force.csv
scene early << 'YAML'
surface: {response: modes.csv}
motion: {path: recorded, file: motion.csv, cutoff: 0 Hz}
contact: {model: given, given: {file: force.csv}}
YAML
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
: > empty.gsf
scene empty << 'YAML'
surface: {height_map: empty.gsf}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
output: {quantity: force}
YAML
sed 's/a,0,0,1,1000,60,1,0/a,0,0,1,1000,60,1,0,5,5,5,5,5,5/' modes.csv > long.csv
sed 's/empty.gsf}/empty.gsf,\n          response: long.csv}/; s/height_map: empty.gsf/roughness: {}/; /^output/d' empty.yaml > cells.yaml
for name in ball tip ends auto late off steps knob small early empty cells; do
    echo "-- $name"
    tell check $name.yaml
done
echo "-- from the command line, an include, a set"
tell render late.yaml --set 'motion.duration=9.995 ms'
sed '/^motion/,/duration/d; s/^rasp: 1/&\ninclude: [part.yaml]/' late.yaml > including.yaml
sed -n '/^motion/,/duration/p' late.yaml > part.yaml
tell plan including.yaml
printf '%s\n' 'rasp-design: 1' 'base: late.yaml' 'factors: {motion.duration: [9.995 ms, 1 s]}' > set.yaml
tell batch set.yaml --dry-run
echo "-- a stem beyond what 32-bit floating point holds"
printf '%s\n' time_s,force_n 0,0 0.5,1e39 1,0 > force.csv
sed 's/file: motion.csv, cutoff: 0 Hz/from: 0/; s/path: recorded, from: 0/path: still, duration: 1 s/' early.yaml > huge.yaml
echo 'output: {encoding: float64, stems: [force]}' >> huge.yaml
tell render huge.yaml
ls huge.*

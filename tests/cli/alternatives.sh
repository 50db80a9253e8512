# Where two texts give alternatives, the later one takes the other's place: a scene that includes another, a design, --set. Within one text they contradict.
try() { local code=0; "$@" || code=$?; echo "$code"; }
rasp new stroke -o stroke.yaml
echo "-- --set"
rasp render -q stroke.yaml -o a.wav --set surface.response="$ROOT/irs/oak_plank.csv" --set 'motion.speed=10 cm/s'
grep -E '^  (response|object|duration|speed):' a.scene.yaml | sed "s|: .*/|: |"
echo "-- the last of two"
rasp check stroke.yaml --set 'motion.speed=10 cm/s' --set 'motion.duration=1 s'
echo "-- a scene that includes it"
printf 'include: [stroke.yaml]\nsurface: {response: %s}\noutput: {level: {rms: -30 dB}}\n' "$ROOT/irs/glass_plate.csv" > over.yaml
rasp render -q over.yaml
grep -E '^  (response|object):|rms: -30' over.scene.yaml | sed "s|: .*/|: |"
echo "-- a design: both ways to say how fast"
printf 'rasp-design: 1\nbase: stroke.yaml\nfactors: {motion.speed: [10 cm/s, 20 cm/s]}\n' > set.yaml
rasp batch set.yaml --dry-run | cut -d ' ' -f 1-4 | head -n 3
echo "-- an alternative that does not apply takes no place"
try rasp check stroke.yaml --set motion.path=back_and_forth --set 'motion.to=[5 cm, 0 cm]' --set 'motion.rate=2 Hz' --set 'motion.law=harmonic' --set 'motion.speed=10 cm/s'
echo "-- one text"
printf 'include: [stroke.yaml]\nsurface: {response: a.csv, object: {shape: plate}}\n' > both.yaml
try rasp check both.yaml

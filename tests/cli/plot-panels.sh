# Which panels are drawn follows from what lies beside the sound; the picture is whole and has the size of its panels.
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
size() { od -A n -t u1 -j 16 -N 8 "$1" | awk '{ print $3 * 256 + $4, $7 * 256 + $8 }'; }
labels() { grep -o '<text>.*</text>' "$1" | sed 's/<[^>]*>//g; s/rms -[0-9.]* dBFS/rms ... dBFS/' | grep '[a-zα]' | sort; }

cat > 'a scene.yaml' << END
rasp: 1
title: it's \`one\` "stroke"
contacts:
  - name: rod
    surface: {roughness: {}, response: modes.csv}
    scraper: {mass: 10 g}
    motion: {path: line, to: [2 cm, 0 cm], speed: 20 cm/s}
    grip: {}
output: {tail: 50 ms, diagnostics: {rate: 1 kHz}}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' '# normalisation: none' '# source: made up for this test' \
    place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
rasp render -q 'a scene.yaml'
rasp plot 'a scene.wav'
size 'a scene.png'
rasp plot 'a scene.wav' --format svg --from 0.02 --to 0.06
labels 'a scene.svg'

echo "-- forces only"
rasp plot 'a scene.csv' -o forces.png --title 'only forces'
size forces.png

echo "-- no table beside it: the summary's title stays"
rm 'a scene.csv'
rasp plot 'a scene.wav' -o sound.svg
labels sound.svg

echo "-- no summary either"
rm 'a scene.json'
rasp plot 'a scene.wav' -o sound.svg
labels sound.svg

echo "-- two contacts, one without alpha"
rasp render -q 'a scene.yaml' -o two.wav --set 'contacts=[{name: rod, surface: {roughness: {}, response: modes.csv}, scraper: {mass: 10 g}, motion: {path: line, to: [2 cm, 0 cm], speed: 20 cm/s}}, {name: nail, surface: {roughness: {}}, scraper: {mass: 1 g}, motion: {path: line, to: [2 cm, 0 cm], speed: 10 cm/s}, contact: {limiter: {curve: none}}}]'
rasp plot two.wav -o two.svg
labels two.svg
ls

echo "-- the ground and the limited trajectory"
cp -r "$ROOT/surfaces" "$ROOT/scenes/limited_trajectory.yaml" .
sed -i 's|\.\./surfaces|surfaces|' limited_trajectory.yaml
rasp render -q limited_trajectory.yaml
rasp plot limited_trajectory.wav -o way.svg --panels trajectory --from 0.03 --to 0.06
labels way.svg
rasp plot two.wav -o none.svg --panels trajectory || echo "exit $?"
rasp check limited_trajectory.yaml --set contacts.firm.contact.force=paper --set contacts.firm.contact.leak=null || echo "exit $?"

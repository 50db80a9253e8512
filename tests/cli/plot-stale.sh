# Forces that are drawn are those of the sound: tables of another render are left out, and this is said.
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
cat > x.yaml << 'END'
rasp: 1
title: a stroke
contacts:
  - {name: rod, surface: {roughness: {}, response: modes.csv}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0 cm], speed: 20 cm/s}}
output: {tail: 50 ms, diagnostics: {rate: 1 kHz}}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
title() { grep -o '<text>.*a stroke' "$1" | sed 's/<[^>]*>//g' | grep . || echo "another title"; }
rasp render -q x.yaml
cp x.csv first.csv
rasp plot x.wav

echo "-- the latest render has no table"
rasp render -q x.yaml --set output.diagnostics=null 2> /dev/null
rasp plot x.wav
rasp plot x.csv -o table.svg && title table.svg

echo "-- the table is of another render"
rasp render -q x.yaml --seed=3
cp x.csv right.csv
cp first.csv x.csv
rasp plot x.wav -o x.svg && title x.svg

echo "-- renamed together"
for ending in wav json; do mv x.$ending y.$ending; done
mv right.csv y.csv
rasp plot y.wav

echo "-- no summary, and one that does not list its files"
mv y.json kept.json
rasp plot y.wav
printf '{"scene": "old", "contacts": [{"name": "rod"}]}\n' > y.json
rasp plot y.wav
mv kept.json y.json

echo "-- two contacts, one table changed, one of an earlier render with one contact"
cp first.csv two.csv
rasp render -q x.yaml -o two.wav --set 'contacts=[{name: rod, surface: {roughness: {}, response: modes.csv}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0], speed: 0.2}}, {name: nail, surface: {roughness: {}}, scraper: {mass: 1 g}, motion: {path: line, to: [1 cm, 0], speed: 0.1}}]'
echo 1,1 >> two.nail.csv
rasp plot two.wav -o two.svg
grep -o '<text>.*</text>' two.svg | sed 's/<[^>]*>//g' | grep 'peak$' | sort

echo "-- the latest render makes no sound"
rasp render -q x.yaml -o y.wav --set contacts.rod.surface.response=null 2> /dev/null
rasp plot y.wav -o y.svg && title y.svg

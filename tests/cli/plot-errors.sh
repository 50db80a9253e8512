# What cannot be drawn leaves nothing behind and says why.
try() { "$@" || echo "exit code $?" >&2; }

printf 'time_s,speed_m_per_s\n0,1\n0.001,1\n' > speeds.csv
printf 'time_s,force_rms_n\n0,1\n0.001,one\n' > wrong.csv
printf 'time_s,force_rms_n\n0,1\n0.001,2\n0.002,3\n' > good.csv
printf 'x,y\n0,1\n' > other.csv
echo no sound > no.wav
try rasp plot
try rasp plot nothing.wav
try rasp plot nothing.csv
try rasp plot no.wav
try rasp plot scene.yaml
try rasp plot speeds.csv
try rasp plot wrong.csv
try rasp plot other.csv
printf 'stimulus_id,file_name\na,a.wav\n' > manifest.csv
try rasp plot manifest.csv
try rasp plot good.csv -o picture.pdf
try rasp plot good.csv -o picture.png --format svg
try rasp plot good.csv --format gif
try rasp plot good.csv --from 1
try rasp plot good.csv --to 0.004
try rasp plot good.csv --from 0.002 --to 0.001
try rasp plot good.csv -o nowhere/picture.png

echo "-- nor over what it shows, or what lies beside it"
mkdir over
printf '%s\n' 'rasp: 1' 'surface: {roughness: {rms: 5 um}}' 'scraper: {mass: 10 g}' 'motion: {path: line, to: [1 cm, 0], duration: 0.05 s}' 'output: {quantity: force, sample_rate: 8 kHz, diagnostics: {rate: 1 kHz}}' > over/s.yaml
rasp render over/s.yaml -o over/one.wav -q
for ending in wav csv json scene.yaml; do
    ln -s one.$ending over/two.png
    try rasp plot over/one.wav -o over/two.png
    rm over/two.png
done
ln over/one.wav over/one.png
try rasp plot over/one.wav

echo "-- without gnuplot, and with one that fails"
mkdir empty broken
try env PATH="$PWD/empty" "$(command -v rasp)" plot good.csv
printf '#!/bin/sh\ncat > /dev/null\necho "cannot find a font" >&2\nexit 1\n' > broken/gnuplot
chmod +x broken/gnuplot
try env PATH="$PWD/broken:$PATH" rasp plot good.csv
printf '#!/bin/sh\ncat > /dev/null\necho half a picture\n' > broken/gnuplot
try env PATH="$PWD/broken:$PATH" rasp plot good.csv
echo "-- nor where a terminal's signal reached gnuplot alone so far"
printf '#!/bin/sh\nkill -INT $$\n' > broken/gnuplot
try env PATH="$PWD/broken:$PATH" rasp plot good.csv
ls

# Panels that are chosen; mode tables; what is drawn of modes and of the motion.
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
size() { od -A n -t u1 -j 16 -N 8 "$1" | awk '{ print $3 * 256 + $4, $7 * 256 + $8 }'; }
labels() { grep -o '<text>.*</text>' "$1" | sed 's/<[^>]*>//g' | grep '[a-zα0-9]' | sort -u | tr '\n' ';' && echo; }
try() { "$@" || echo "exit code $?"; }
cat > x.yaml << 'END'
rasp: 1
title: a stroke
surface: {roughness: {}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0.5 cm], speed: 10 cm/s}
output: {tail: 50 ms}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' '# title: two modes' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad \
    a,0,0,1,1000,60,1,0 a,0,0,2,3000,600,0.1,0 b,0.02,0.01,1,1000,60,1,0 b,0.02,0.01,2,3000,600,0.1,0 c,0.02,0,1,1000,60,1,0 c,0.02,0,2,3000,600,0.1,0 > modes.csv
rasp render -q x.yaml
rasp plot x.wav --panels motion,modes -o a.svg
labels a.svg
rasp plot x.wav -p motion
size x.png
rasp plot x.wav --panels waveform,decays
size x.png
echo "-- a mode table; the weaker mode is 20 dB below, the times of decay are 3 ln 10 over 60/s and 600/s"
rasp plot modes.csv
head -c 8 modes.png | od -A n -c | tr -d ' '
size modes.png
rasp plot modes.csv -o b.svg --panels modes
labels b.svg
echo "-- an object: its edges, and the ball's modes"
rasp render -q "$ROOT/scenes/marble_drop.yaml" -o ball.wav --set 'motion.duration=0.1 s' --set output.tail=0 2> warnings
rasp plot ball.wav --panels motion,modes -o c.svg
grep -c "fill = 'rgb(244, 239, 230)'\|fill *= *'rgb(244,239,230)'\|rgb(244, 239, 230)" c.svg
echo "-- what cannot be"
try rasp plot x.wav --panels waveform,force
try rasp plot x.wav --panels normal
try rasp plot modes.csv --panels motion
try rasp plot modes.csv --from 1
try rasp plot x.wav --panels spectogram
try rasp plot x.wav --panels ""
echo '# changed' >> x.scene.yaml
try rasp plot x.wav
rm modes.csv
rasp render -q x.yaml -o y.wav 2> log || echo "no render without its modes"
ls

# output.duration: the file is exactly that long. Longer than the sound: it rings on; shorter: it is cut under the ramp, and that is told when something is cut off.
. "$ROOT/tests/cli/batch-make.inc"
frames() { python3 -c 'import sys, wave; print(*(wave.open(f).getnframes() for f in sys.argv[1:]))' "$@"; }
for d in 0.1 0.3 0.35 2; do rasp render tiny.yaml -q -o d$d.wav --set output.duration="$d s" --set output.level.full_scale='1 m/s'; done
rasp render tiny.yaml -q -o tail.wav --set output.tail='1.7 s' --set output.level.full_scale='1 m/s'
frames d0.1.wav d0.3.wav d0.35.wav d2.wav
rasp render d0.35.scene.yaml -q -o again.wav && cmp again.wav d0.35.wav
echo "-- what is not cut has the samples that a tail gives"
python3 -c '
import wave
a, b = (wave.open(f).readframes(48000) for f in ("d2.wav", "tail.wav"))
print(a == b)'
rasp check tiny.yaml --set 'output.duration=0 s' || echo "exit $?" >&2

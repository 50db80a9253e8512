# Limits that are met and missed; together all must be met.
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 0 16384 -16384 8192 > a.wav
wav 8000 1 0 16384 -16387 8192 > b.wav
rasp compare --lsb 3 --snr 78.2 --third-octave 0.004 a.wav b.wav | tail -n 4
rasp compare --lsb 2.9 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --snr 78.3 --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --third-octave 0.003 --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --exact --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"
# A band 50 dB below the loudest counts unless --within leaves it out.
tones() { awk -v soft="$1" 'BEGIN { for (i = 0; i < 8000; i++) printf "%d ", 16384 * sin(2 * 3.14159265358979 * 1000 * i / 8000) + soft * sin(2 * 3.14159265358979 * 250 * i / 8000) + 0.5 }'; }
# shellcheck disable=SC2046
wav 8000 1 0 $(tones 50) > tones.wav
# shellcheck disable=SC2046
wav 8000 1 0 $(tones 100) > louder.wav
rasp compare --third-octave 1 tones.wav louder.wav | grep FAIL || echo "exit $?"
rasp compare --third-octave 1 --within 40 tones.wav louder.wav | grep FAIL || echo "exit $?"
rasp compare --within 40 tones.wav louder.wav || echo "exit $?"

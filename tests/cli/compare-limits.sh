# Limits that are met and missed; together all must be met.
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 0 16384 -16384 8192 > a.wav
wav 8000 1 0 16384 -16387 8192 > b.wav
rasp compare --lsb 3 --snr 78.2 --third-octave 0.004 a.wav b.wav | tail -n 4
rasp compare --lsb 2.9 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --snr 78.3 --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --third-octave 0.003 --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"
rasp compare --exact --lsb 3 a.wav b.wav | grep FAIL || echo "exit $?"

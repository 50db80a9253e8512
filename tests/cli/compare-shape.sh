# Sounds of different rate, channels and length: said by how much, what both have compared, never equal.
# shellcheck disable=SC2046 # lists of samples are to be split
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 0 16384 -16384 8192 > a.wav
wav 8000 1 0 16384 -16384 > short.wav
wav 8000 2 0 16384 -16384 8192 > stereo.wav
wav 4000 1 0 16384 -16384 8192 > slow.wav
for b in short stereo slow; do
    rasp compare --snr 0 a.wav $b.wav | grep -Ev 'third|sha256' || echo "exit $?"
done
# Different rates: every criterion by samples fails with that reason.
rasp compare --exact --snr 0 --lsb 9 a.wav slow.wav | grep -E 'FAIL|ok' || echo "exit $?"
# Third-octave bands alone: rates may differ when lengths in seconds do not.
wav 8000 1 $(printf '16384 0 -16384 0 %.0s' $(seq 200)) > a.wav
wav 8000 1 $(printf '16384 0 -16384 0 %.0s' $(seq 201)) > longer.wav
wav 16000 1 $(printf '16384 11585 0 -11585 -16384 -11585 0 11585 %.0s' $(seq 200)) > fast.wav
rasp compare -q --third-octave 0.1 a.wav fast.wav
rasp compare -q --third-octave 0.1 a.wav longer.wav | grep 'FAIL form' || echo "exit $?"
rasp compare -q --third-octave 0.1 --snr 0 a.wav fast.wav | grep 'FAIL form' || echo "exit $?"
rasp compare --third-octave 0.1 a.wav fast.wav | grep -Ev 'third-octave|sha256'

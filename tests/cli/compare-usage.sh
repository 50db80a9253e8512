# What cannot be asked.
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 1 2 3 > a.wav
printf 't,v\n0,1\n' > a.csv
cp a.wav sound
try() { rasp compare "$@" || echo "exit $?: $*"; }
try a.wav a.csv
try sound a.csv
try --abs 1 a.wav a.wav
try --snr 1 a.csv a.csv
try --exact --rel 0 a.csv a.csv
try --column v=1 a.csv a.csv
try --column v=1,-1 a.csv a.csv
try --lsb -1 a.wav a.wav
try --lsb x a.wav a.wav
try --column 'v=w=0,0' a.csv a.csv
try -q --column 'v=0,0' a.csv a.csv
try -q sound a.wav

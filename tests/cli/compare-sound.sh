# Equal sounds, sounds that differ, and what -q keeps quiet.
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 2 0 100 16384 -100 -16384 100 8192 -100 > a.wav
wav 8000 2 0 100 16384 -100 -16387 100 8192 -99 > b.wav
rasp compare a.wav a.wav
rasp compare a.wav b.wav || echo "exit $?"
rasp compare -q a.wav a.wav
rasp compare -q --lsb 3 a.wav b.wav
rasp compare -q a.wav b.wav > quiet || echo "exit $?"
rasp compare a.wav b.wav > loud || cmp loud quiet

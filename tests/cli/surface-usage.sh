# What surface says to a wrong command line, and its exit code; nothing is written.
. "$ROOT/tests/cli/surface-make.inc"
try() { "$@" || echo "exit code $?" >&2; }
map > map.csv
try rasp surface
try rasp surface inof map.csv
try rasp surface draw map.csv
try rasp surface info
try rasp surface convert map.csv
try rasp surface convert map.csv a.gsf b.gsf
try rasp surface convert map.csv a.tif
try rasp surface convert map.csv a.gsf
try rasp surface convert --json map.csv a.gsf
try rasp surface info --row 3 map.csv
try rasp surface info --pitch 1s map.csv
try rasp surface info --pitch 2m map.csv
try rasp surface info --pitch 20um --holes plug map.csv
try rasp surface info --pitch 20um --levelling flat map.csv
try rasp surface info --pitch 20um map.csv
try rasp surface info --pitch 20um --height-range 1um map.csv
try rasp surface convert --pitch 20um --height-scale 1um --text map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --row 24 map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop 1mm,1mm map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop 1mm,0,1mm,1mm map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop 0,0,1um,1um,1um map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop 1um,1um,1um,1um map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop 1s,0,1mm,1mm map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um --crop=-1mm,0,1mm,1mm map.csv a.gsf
try rasp surface convert --pitch 20um --height-scale 1um map.csv nowhere/a.gsf
ls

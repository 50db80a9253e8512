# What surface info says: of a profile that ships, of a map that is tilted, has a hole and is stored in coarse steps.
. "$ROOT/tests/cli/surface-make.inc"
rasp surface info "$ROOT/surfaces/ridged_plate.gsf"
map > map.csv
rasp surface info --pitch 20um --height-scale 1um --levelling plane map.csv
awk -F, '{ for (i = 1; i <= NF; i++) printf "%s%s", NR == 3 && i == 5 ? "nan" : int($i * 4) / 4, i < NF ? "," : "\n" }' map.csv > coarse.csv
rasp surface info --pitch 20um --height-scale 1um coarse.csv
rasp surface info --pitch 20um --height-scale 1um --holes fill coarse.csv | grep missing
awk 'BEGIN { for (i = 0; i < 200; i++) printf "5 "; print "" }' > flat.csv
rasp surface info --pitch 2um --height-scale 1um flat.csv missing.csv || echo "exit code $?"

# Every starter scene renders as it is: forces in a CSV, and a sound; none warns of anything, whatever the material. The starter design renders, too.
for kind in $(rasp new --list | cut -d ' ' -f 1); do
    rasp new $kind -o $kind.yaml
    if [ $kind = design ]; then continue; fi
    rasp render --quiet --set output.tail=0 $kind.yaml
    ls $kind.wav $kind*.csv
done
for material in $(rasp explain surface.material | sed -n "/^  words/,\$ s/^    \([a-z]*\) .*/\1/p" | grep -v custom); do
    rasp render --quiet scrape.yaml -o x.wav --set surface.material="$material" --set motion.duration='0.5 s'
done
rasp batch design.yaml -o out -q
ls out
# and what is off in it is right, too
cp out/oak_1Hz_1.wav real.wav
sed -E 's/^# (exclude:|order:|recordings:|  - )/\1/' design.yaml > all.yaml
{ diff design.yaml all.yaml || true; } | grep -c '^>'
rasp check all.yaml
rasp batch all.yaml --dry-run | cut -d ' ' -f 1-4 | sed -n 2,8p

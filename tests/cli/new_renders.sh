# Every starter scene renders as it is: forces in a CSV, and a sound where an object rings; none warns of anything. The starter design renders, too.
ln -s "$ROOT/irs" irs
for kind in $(rasp new --list | cut -d ' ' -f 1); do
    rasp new $kind -o $kind.yaml
    if [ $kind = design ]; then continue; fi
    rasp render --quiet --set output.tail=0 $kind.yaml
    ls $kind*.csv
done
rasp batch design.yaml -o out -q
ls out

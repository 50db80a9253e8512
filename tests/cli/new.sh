# Every starter scene is written once, is not overwritten by mistake, and passes the check.
try() { local code=0; "$@" || code=$?; echo "$code"; }
rasp new --list
ln -s "$ROOT/irs" irs
for kind in $(rasp new --list | cut -d ' ' -f 1); do
    rasp new $kind -o $kind.yaml
    rasp check $kind.yaml
done
rasp new | cmp - scrape.yaml
echo mine > mine.yaml
try rasp new -o mine.yaml
cat mine.yaml
rasp new --force -o mine.yaml
cmp mine.yaml scrape.yaml
try rasp new -o no/such/folder/a.yaml
try rasp new -o -
echo "-- a design by a program whose folder would end a text between braces"
mkdir -p 'a, b: {c} #d/bin' && cp -r irs/ 'a, b: {c} #d/irs' && cp "$(command -v rasp)" 'a, b: {c} #d/bin'
cd 'a, b: {c} #d' || exit
bin/rasp new -o scrape.yaml
bin/rasp new design -o set.yaml
grep -c '"irs/oak_plank.csv"\|: irs/oak_plank.csv' set.yaml
mv 'irs' kept && mkdir @x && mv kept @x/irs && mv bin @x
@x/bin/rasp new design -o outside.yaml
rasp check outside.yaml
mkdir far && cd far || exit
../@x/bin/rasp new -o scrape.yaml
../@x/bin/rasp new design -o ../../set.yaml
cp scrape.yaml ../..
cd ../..
rasp check set.yaml

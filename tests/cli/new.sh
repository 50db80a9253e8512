# Every starter scene is written once, is not overwritten by mistake, and passes the check.
try() { local code=0; "$@" || code=$?; echo "$code"; }
rasp new --list
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

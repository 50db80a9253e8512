# Files that a scene names must be there (66), must not have changed since an effective scene was written (65), and a scene must ask for
# something (65).
try() { local code=0; "$@" || code=$?; echo "$code"; }
rasp new -o a.yaml
try rasp check --set surface.response=no.csv --set scraper.response=nor_this.csv a.yaml
mkdir folder
try rasp check --set surface.response=folder a.yaml
cp "$ROOT/irs/basswood_plank.csv" plank.csv
rasp explain --set surface.response=plank.csv --set surface.extrapolate=nearest a.yaml > effective.yaml
try rasp check effective.yaml
echo '# changed' >> plank.csv
try rasp check effective.yaml 2> err
sed 's/[0-9a-f]\{64\}/SHA256/g' err
try rasp check --set output.diagnostics=null --set surface.object=null a.yaml

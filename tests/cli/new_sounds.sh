# With the # before responses and weights taken away, every starter that has them sounds at once, wherever it was written; an installed rasp names its own folder.
for at in tree/build usr/bin; do mkdir -p $at && cp "$(command -v rasp)" $at; done
cp -r "$ROOT/irs" tree/
mkdir -p usr/share/rasp tree/out far/away && cp -r "$ROOT/irs" usr/share/rasp/
PATH=$PWD/tree/build:$PATH
uncovered() { sed -E 's/#(response|weight):/\1:/'; }
for kind in $(rasp new --list | cut -d ' ' -f 1); do
    rasp new "$kind" -o tree/out/"$kind".yaml
    uncovered < tree/out/"$kind".yaml > far/away/"$kind".yaml
    cp far/away/"$kind".yaml tree/out/
    if [ "$kind" = design ]; then continue; fi
    grep -q '^ *-* *response:' tree/out/"$kind".yaml || continue
    rasp render --quiet --set output.tail=0 tree/out/"$kind".yaml -o tree/out/ 2> told.txt || { echo "$kind: exit $?"; cat told.txt; }
    grep -v 'its WAV response does not say' told.txt || true
    ls tree/out/"$kind".wav
done
echo "-- seen from other folders, and installed"
rasp new | grep response:
(cd tree/out && rasp new | grep response:)
rasp new -o far/away/mine.yaml && grep response: far/away/mine.yaml
usr/bin/rasp new | grep response: | sed "s|$PWD|HERE|"
echo "-- no responses there: the names say which they are"
mv tree/irs tree/other
rasp new | grep response:

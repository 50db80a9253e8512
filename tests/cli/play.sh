# rasp play renders into a folder that goes, and hands the sound to the first player there is; -o - writes it to standard output.
try() { local code=0; "$@" || code=$?; echo "$code"; }
mkdir bin scratch
export TMPDIR=$PWD/scratch
for program in play aplay; do
    printf '#!/bin/sh\necho "%s $*" | sed "s|$TMPDIR.*/|FOLDER/|"\nhead -c 4 "$2"; echo\nexit $CODE\n' $program > bin/$program
    chmod +x bin/$program
done
mine=$(command -v rasp) && ln -s "$mine" bin/rasp
own() { PATH=$PWD/bin:/usr/bin:/bin CODE=${CODE:-0} "$@"; }
rasp new -o scrape.yaml
rasp render -q scrape.yaml -o kept.wav
echo "-- scenes and sounds, one after another"
own rasp play scrape.yaml kept.wav --set surface.material=steel 2>&1
rasp new pen | own rasp play /dev/stdin 2>&1
echo "-- what a player cannot play; no scene; nothing that sounds; no player"
CODE=2 try own rasp play kept.wav
try own rasp play none.yaml
try own rasp play scrape.yaml --set surface.object=null --set output.quantity=force > force.txt && cat force.txt
try own rasp play scrape.yaml --set surface.object=null
PATH=$(dirname "$mine") try rasp play kept.wav
echo "-- to standard output: the bytes of the file, whole"
rasp render scrape.yaml -o - | cmp - kept.wav
rasp new | rasp render /dev/stdin -o - | cmp - kept.wav
try rasp render scrape.yaml scrape.yaml -o -
try rasp render scrape.yaml -o - --json
rasp render scrape.yaml -o - > /dev/full || echo $?
echo "-- and nothing is left"
ls scratch

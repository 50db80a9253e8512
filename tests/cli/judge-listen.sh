# A program listens: bursts of noise, two takes of each number of them; what is played by one condition as the templates are, by the other with all bursts alike.
. "$ROOT/tests/cli/judge-make.inc"
. "$ROOT/tests/cli/compare-make.inc"
mkdir sounds
printf 'file_name,motion,condition,note\n' > sounds/manifest.csv
# shellcheck disable=SC2046
sound() { # NAME BURSTS FIRST
    wav 4000 1 $(draw "BEGIN { x = $3; for (i = 0; i < 2000; i++) { s = sin(3.14159265 * $2 * i / 2000); printf \"%d \", 12000 * s * s * normal() } }") > "sounds/$1.wav"
}
for bursts in 1 2 3; do
    for take in 1 2; do
        sound "clear_${bursts}_$take" $bursts $((100 * bursts + take))
        sound "even_${bursts}_$take" 2 $((200 * bursts + take))
        printf '%s\n' "clear_${bursts}_$take.wav,bursts_$bursts,clear,t$take" "even_${bursts}_$take.wav,bursts_$bursts,even,t$take" >> sounds/manifest.csv
    done
done
try rasp judge listen sounds --templates sounds --where condition=clear --reference clear -o heard.csv
cut -c1-40 heard.csv
try rasp judge similarity heard.csv --reference clear --paper "$ROOT/evidence/papers.csv" --item 000_2 | tail -n 8
# what is struck: tones that fade, the dull ones faster; those of one material are not quite alike
echo file_name,material > sounds/struck.csv
# shellcheck disable=SC2046
for tone in wood,400,20 wood,500,28 glass,1500,3 glass,1700,4; do
    IFS=, read -r material f d <<< "$tone"
    wav 8000 1 $(draw "BEGIN { for (i = 0; i < 8000; i++) printf \"%d \", 30000 * exp(-$d * i / 8000) * sin(6.2831853 * $f * i / 8000) }") > "sounds/struck_$f.wav"
    echo "struck_$f.wav,$material" >> sounds/struck.csv
done
try rasp judge listen sounds/struck.csv --templates sounds/struck.csv --factor material --by material
try rasp judge listen sounds --templates sounds --by ear
# by one take of each there is no telling how far apart takes are
try rasp judge listen sounds --templates sounds --where condition=clear --where note=t1
try rasp judge listen sounds --templates sounds --where condition=clear --where note=t1 --spread 0.3
grep -v bursts_3 sounds/manifest.csv > sounds/two.csv
try rasp judge listen sounds --templates sounds/two.csv
try rasp judge listen sounds --templates sounds --where condition=loud
try rasp judge listen sounds --templates sounds --where condition
try rasp judge listen sounds --templates sounds --where motion=bursts_1
{ echo file_name,motion && seq -f 'clear_1_1.wav,%g' 101; } > sounds/many.csv
try rasp judge listen sounds/many.csv --templates sounds/many.csv
try rasp judge listen sounds --templates sounds --factor path
sed 's/clear_2_1.wav/none.wav/' sounds/manifest.csv > sounds/gone.csv
try rasp judge listen sounds/gone.csv --templates sounds
sed 's/clear_2_1.wav/n\/a/' sounds/manifest.csv > sounds/gone.csv
try rasp judge listen sounds/gone.csv --templates sounds
grep -v 'bursts_2,even' sounds/manifest.csv > sounds/gone.csv
try rasp judge listen sounds/gone.csv --templates sounds
# shellcheck disable=SC2046
wav 4000 1 $(awk 'BEGIN { for (i = 0; i < 2000; i++) print 0 }') > sounds/clear_2_1.wav
try rasp judge listen sounds --templates sounds

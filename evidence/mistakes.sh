#!/bin/bash
# Makes evidence/mistakes.md: 60 mistakes of a person's first days with rasp, and what it says to each. Needs sox.
# A row below: what is wrong ~ FILE: the edit of a starter, as sed takes it (-: none) ~ the command ~ what names the cause:
# @ the line that was edited, else words of the message.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/mistakes.md}")
export LC_ALL=C
command -v sox > /dev/null || { echo "sox is not installed: skipped"; exit 0; }
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
mkdir "$WORK/ready"
cd "$WORK/ready"

# What each mistake begins with: starters, two sets, a list of golden sounds, recordings, a table of modes.
for name in scrape strike circle grip marble_on_wood impacts; do rasp new $name -o $name.yaml; done
rasp new design -o set.yaml
sed '/^  surface.material/d; s/^  motion.rate: .*/  motion.rate: {uniform: [1 Hz, 4 Hz]}/; s/^replicates: 2.*/samples: 3/; /^name:/d; /^text:/d' \
    set.yaml > sampled.yaml
sed 's/oak, glass/oak, steel/' set.yaml > other.yaml
rasp batch -q other.yaml -o others
rasp render -q scrape.yaml
echo scrape.yaml > sounds.txt
rasp golden update sounds.txt > /dev/null
cp "$ROOT/irs/oak_plank.csv" .
sox -n -r 48k -b 24 silence.wav trim 0 2
printf 'surface.material,rate\noak,1 Hz\n' > rows.csv

cat > ../table << 'END'
## A perception researcher writes a scene
a section is misspelt ~ scrape: s/^motion:/moton:/ ~ rasp render scrape.yaml ~ @
a word is misspelt ~ scrape: s/path: back_and_forth/path: back_and_forht/ ~ rasp render scrape.yaml ~ @
a bracket is not closed ~ scrape: s/8 cm, 0 cm\]/8 cm, 0 cm/ ~ rasp render scrape.yaml ~ opens on line 51
a material has a name that rasp does not use ~ scrape: s/: oak/: wood/ ~ rasp check scrape.yaml ~ @
a key has the name that another program gives it ~ scrape: s/rate: 2 Hz/frequency: 2 Hz/ ~ rasp render scrape.yaml ~ @
a key begins with a capital letter ~ scrape: s/mass: 20 g/Mass: 20 g/ ~ rasp render scrape.yaml ~ @
a mass is in centimetres ~ scrape: s/20 g/20 cm/ ~ rasp render scrape.yaml ~ @
a unit is in small letters ~ scrape: s/rate: 2 Hz/rate: 2 hz/ ~ rasp render scrape.yaml ~ @
a number is no number ~ scrape: s/1.2 mm/5mm5/ ~ rasp render scrape.yaml ~ @
a number has a decimal comma ~ scrape: s/1.2 mm/1,2 mm/ ~ rasp render scrape.yaml ~ @
the mass is 20 kg in place of 20 g ~ scrape: s/20 g/20 kg/ ~ rasp render -q scrape.yaml ~ @
the unit of a length is left out ~ scrape: s/length: 16 cm/length: 16/ ~ rasp render -q scrape.yaml ~ @
the sample rate is 48 Hz ~ scrape: s/48 kHz/48 Hz/ ~ rasp render scrape.yaml ~ @
a key stands one space too far left ~ scrape: s/^  rate/ rate/ ~ rasp render scrape.yaml ~ @
a key stands one space too far right ~ scrape: s/^  rate/   rate/ ~ rasp render scrape.yaml ~ @
a colon is missing ~ scrape: s/rate: 2 Hz/rate 2 Hz/ ~ rasp render scrape.yaml ~ @
no space stands behind a colon ~ scrape: s/rate: 2 Hz/rate:2 Hz/ ~ rasp render scrape.yaml ~ @
a tab indents a key ~ scrape: s/^  rate/\trate/ ~ rasp render scrape.yaml ~ @
a list stands where a number goes ~ scrape: s/20 g/[20 g, 40 g]/ ~ rasp render scrape.yaml ~ @
a number stands where a place goes ~ scrape: s/^  to: .*/  to: 8 cm/ ~ rasp render scrape.yaml ~ @
a key is given twice ~ scrape: s/^  rate: 2 Hz/&\n  rate: 4 Hz/ ~ rasp render scrape.yaml ~ @
a section is given twice ~ scrape: s/^output:/surface: {material: glass}\n&/ ~ rasp render scrape.yaml ~ @
a hand's grip and a constant load ~ grip: s/^#contact:/load: {constant: 2 N}/ ~ rasp render grip.yaml ~ @
a circle is given ends ~ circle: s/^  radius: .*/  from: [0 cm, 0 cm]\n  to: [4 cm, 0 cm]/ ~ rasp render circle.yaml ~ @
the motion leaves the plate ~ scrape: s/^  to: .*/  to: [20 cm, 0 cm]/ ~ rasp render scrape.yaml ~ scrape.yaml:28:
the motion leaves the places of a table of modes ~ scrape: s/^  material: oak/  response: oak_plank.csv/; /^  object:/,/^    origin:/d; s/^  to: .*/  to: [50 cm, 0 cm]/ ~ rasp render scrape.yaml ~ @
a scraper is to roll ~ scrape: s/^output:/contact: {model: roll}\n&/ ~ rasp render scrape.yaml ~ @
an object rings twice ~ scrape: s/^  material: oak/&\n  response: oak_plank.csv/ ~ rasp render scrape.yaml ~ @
a response is not there ~ scrape: s/^  material: oak/  response: oak.wav/; /^  object:/,/^    origin:/d ~ rasp render scrape.yaml ~ @
the table of a response is no table of modes ~ scrape: s/^  material: oak/  response: rows.csv/; /^  object:/,/^    origin:/d ~ rasp render scrape.yaml ~ @
## A data-set engineer makes a set
a design goes to render ~ - ~ rasp render set.yaml ~ set.yaml:
a scene goes to batch ~ - ~ rasp batch scrape.yaml -o out ~ scrape.yaml
a factor is no key of scenes ~ set: s/motion.rate: \[/motion.tempo: [/ ~ rasp batch set.yaml -o out ~ @
a factor is misspelt in the name ~ set: s/^name:.*/name: "{material}_{motion.rate}_{replicate}"/ ~ rasp batch set.yaml -o out ~ @
names are not distinct ~ set: s/^name:.*/name: "{surface.material}_{replicate}"/ ~ rasp batch set.yaml -o out ~ @
a label is unknown ~ set: s/^# exclude:.*/exclude: [{surface.material: steel}]/ ~ rasp batch set.yaml -o out ~ @
a level is no value of its key ~ set: s/oak, glass/oak, glas/ ~ rasp batch set.yaml -o out ~ @
one value stands where levels go ~ set: s/\[oak, glass\]/oak/ ~ rasp batch set.yaml -o out ~ @
the base is not there ~ set: s/scrape.yaml  /scrap.yaml/ ~ rasp check set.yaml ~ @
the word for a loudness is another ~ set: s/{common.*}}/{each: {loudness: -23}}/ ~ rasp batch set.yaml -o out ~ @
samples are asked for, but nothing is drawn ~ set: s/^replicates: 2/samples: 1000/ ~ rasp batch set.yaml -o out ~ @
values are drawn, but samples is left out ~ sampled: /^samples/d ~ rasp batch sampled.yaml -o out ~ sampled.yaml:
a range is upside down ~ sampled: s/1 Hz, 4 Hz/4 Hz, 1 Hz/ ~ rasp batch sampled.yaml -o out ~ @
a table of cells lacks a factor ~ set: s/\[.*/cells/; s/^# exclude:.*/cells: rows.csv/ ~ rasp batch set.yaml -o out ~ rows.csv
the folder holds another set ~ - ~ rasp batch set.yaml -o others ~ others
the folder is left out ~ - ~ rasp batch set.yaml ~ -o
a shard is beyond their number ~ - ~ rasp batch set.yaml -o out --shard 4/3 ~ --shard
## A sound designer tries things
--set without = ~ - ~ rasp render scrape.yaml --set motion.rate ~ --set
--set of a key that is not there ~ - ~ rasp render scrape.yaml --set surface.matrial=steel ~ --set
the output has no ending ~ - ~ rasp render scrape.yaml -o steel ~ steel
the command is left out ~ - ~ rasp scrape.yaml ~ scrape.yaml
an option is not there ~ - ~ rasp render scrape.yaml --rate 44100 ~ --rate
the scale lets the sound clip ~ scrape: s/^  encoding: pcm24/&\n  level: {full_scale: 1 um\/s}/ ~ rasp render scrape.yaml ~ @
a sound goes to render ~ - ~ rasp render scrape.wav ~ scrape.wav
silence is taken apart ~ - ~ rasp decompose silence.wav -o parts ~ silence.wav
a starter is not there ~ - ~ rasp new piano ~ piano
## A maintainer has CI check sounds
the list is not there ~ - ~ rasp golden check list.txt ~ list.txt
an option in the list is misspelt ~ sounds: s/$/ --snrr 60/ ~ rasp golden check sounds.txt ~ @
nothing is kept yet of a scene ~ sounds: s/$/\nstrike.yaml/ ~ rasp golden check sounds.txt ~ strike.yaml
a scene was changed ~ scrape: s/rms: 4 um/rms: 5 um/ ~ rasp golden check sounds.txt ~ scrape.yaml
END

# did FILE: the edited lines of FILE, old and new; their numbers go to ../lines.
did() {
    diff -U0 "../ready/$1" "$1" > ../diff || true
    sed -n 's/^@@ -.* +\([0-9]*\),\?\([0-9]*\) @@.*/\1 \2/p' ../diff |
        while read -r from count; do seq "$from" $((from + (${count:-1} > 1 ? count - 1 : 0))); done > ../lines
    sed -n '1,2d; /^[-+]/p' ../diff
}

n=0 told=0 named=0 cured=0
while IFS= read -r row; do
    if [[ $row == '## '* ]]; then printf '\n%s\n' "$row" >> ../entries; continue; fi
    what=${row%% ~ *} cause=${row##* ~ } row=${row#* ~ } row=${row% ~ *}
    edit=${row%% ~ *} command=${row#* ~ } code=0 n=$((n + 1))
    cp -r ../ready "../$n"
    cd "../$n"
    : > ../did
    if [ "$edit" != - ]; then
        file=${edit%%: *}.yaml
        [ -e "$file" ] || file=${edit%%: *}.txt
        sed -i "${edit#*: }" "$file"
        did "$file" > ../did
        [ -s ../did ] || { echo "mistakes: $what: the edit changes nothing" >&2; exit 1; }
    fi
    eval "$command" > ../said 2>&1 < /dev/null || code=$?
    sed -i "s|$WORK/$n/||g; s|/[^ ]*/rasp-golden-[^/]*/||g" ../said
    if [ "$cause" = @ ]; then sed "s/.*/$file:&:\n$file line &/" ../lines > ../causes; else echo "$cause" > ../causes; fi
    marks=("no cause named" "no cure")
    # The documented exit codes; those that only warn end with 0. Cures: instructions count, "Try: rasp X --help" does not.
    if [[ " 1 64 65 66 69 70 71 73 74 75 " == *" $code "* ]] || { [ $code = 0 ] && grep -q 'warning:' ../said; }; then
        told=$((told + 1))
    fi
    if grep -qFf ../causes ../said; then named=$((named + 1)) marks[0]="cause named"; fi
    if grep -qE '= help:|did you mean|are .* meant|write |move it|choose|must end in|is needed, as|makes (it|them)|a larger|lists? is|shows all' ../said; then
        cured=$((cured + 1)) marks[1]="cure said"
    fi
    {
        printf '\n### %d. %s\n\n```diff\n' "$n" "${what^}"
        cat ../did
        printf '```\n\n```text\n$ %s\n' "$command"
        cat ../said
        printf '```\n\nExit code %d; %s; %s.\n' "$code" "${marks[@]}"
    } | sed '/^```diff$/{N;/\n```$/{N;d}}' >> ../entries
    cd ../ready
done < ../table
[ "$n" = 60 ] || { echo "mistakes: $n in the table, not 60" >&2; exit 1; }

{
    cat << MD
# Sixty mistakes, and what rasp says

Made by \`evidence/mistakes.sh\` with $(rasp --version). People make these mistakes when they first use the program. Each scene and each design is a
starter of \`rasp new\`, with the edit that is shown: - is the line before it, + the line after it. Below it stand the command, all that it
prints, and its exit code. Only paths of temporary folders are taken away.

| of $n mistakes | |
|---|---|
| end with a documented exit code other than 0, or with a warning | $told |
| have their cause named: file and line, or the option or file of the command | $named |
| get a cure: a line of help, "did you mean", or an instruction | $cured |

The script counts these. It cannot judge whether a cure is the right one. Its list of words for cures, and for some rows the place that is asked
for, were written after the messages had been read. The warning of number 12 speaks of a consequence, not of the length.
MD
    cat ../entries
} > ../report.md
mv ../report.md "$REPORT"

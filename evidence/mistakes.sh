#!/bin/bash
# Makes evidence/mistakes.md: sixty mistakes that people make, each with what rasp says of it.
# Each row is "what was done | how": an edit of a starter for sed, which `rasp check` then reads, or after "$" a command.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
PATH=$BUILD:$PATH
export LC_ALL=C
REPORT=$(realpath -m "${REPORT:-$ROOT/evidence/mistakes.md}")
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK"
rasp new scrape > good.yaml
cp "$ROOT/irs/oak_plank.csv" .
printf 'surface: {material: oak}\n' > oak_plank.yaml
cat > study.yaml << 'END'
rasp-design: 1
base: good.yaml
factors:
  surface.material: [oak, glass]
  motion.rate: [1 Hz, 2 Hz]
level: {each: {lufs: -23}}
END
sed 's/motion.rate/scraper.mass/; s/1 Hz, 2 Hz/20 g, 30 g/' study.yaml > other.yaml
rasp render good.yaml -q -o good.wav
sox -n -r 44100 -b 16 silent.wav trim 0 1
sox -n -r 44100 -b 16 tone.wav synth 1 sine 440
touch empty.csv

mistakes() {
    cat << 'END'
a section misspelt | s/^motion:/moton:/
a key misspelt | s/  rate: 2 Hz/  rte: 2 Hz/
a word misspelt | s/back_and_forth/back_and_forht/
a material misspelt | s/oak/oka/
a word of another program | s/  rate: 2 Hz/  frequency: 2 Hz/
a capital letter | s/oak/Oak/
a unit of another dimension | s/mass: 20 g/mass: 20 cm/
a unit misspelt | s/mass: 20 g/mass: 20 gr/
two units | s/length: 16 cm/length: 16 cm 2 mm/
a comma for the decimal point | s/1.2 mm/1,2 mm/
a number and a letter too many | s/length: 16 cm/length: 1y6 cm/
kilograms where grams were meant | s/mass: 20 g/mass: 20 kg/
hertz where kilohertz were meant | s/48 kHz/48 Hz/
millimetres where micrometres were meant | s/rms: 4 um/rms: 4 mm/
a negative length | s/length: 16 cm/length: -16 cm/
no colon | s/mass: 20 g/mass 20 g/
no space after the colon | s/mass: 20 g/mass:20 g/
a tab | s/^  mass: 20 g/\tmass: 20 g/
a line that is indented too far | s/^  rate: 2 Hz/    rate: 2 Hz/
a line that is not indented | s/^  mass: 20 g/mass: 20 g/
a bracket that is not closed | s/to: \[8 cm, 0 cm\]/to: [8 cm, 0 cm/
quotes that are not closed | s/material: oak/material: "oak/
one number where a place goes | s/to: \[8 cm, 0 cm\]/to: 8 cm/
three numbers where a place goes | s/to: \[8 cm, 0 cm\]/to: [8 cm, 0 cm, 0 cm]/
a list where a number goes | s/mass: 20 g/mass: [20 g]/
the same key twice | s/^  mass: 20 g/  mass: 20 g\n  mass: 30 g/
two speeds at once | s/^  rate: 2 Hz/  rate: 2 Hz\n  speed: 20 cm\/s/
a response and an object at once | s/^  material: oak/  material: oak\n  response: oak_plank.csv/
no mass | s/^  mass: 20 g/  radius: 1 mm/
no version | s/^rasp: 1//
the version of a later program | s/^rasp: 1/rasp: 2/
a motion that leaves the object | s/to: \[8 cm, 0 cm\]/to: [80 cm, 0 cm]/
a motion that nothing is said of | s/^  path: back_and_forth//
a duration of nothing | s/duration: 2 s/duration: 0 s/
a file that is not there | s/^surface:/include: [oak_plnak.yaml]\nsurface:/
a key of the ball on a scraper | s/^scraper:/ball:/
an object without its thickness | s/^    thickness: 1.2 mm//
a key of a circle on a stroke | s/  path: back_and_forth/  path: back_and_forth\n  center: [0 cm, 0 cm]/
a preset that is none | s/^accuracy: standard/accuracy: best/
an error without its minus | s/^accuracy: standard/accuracy: {error: 60 dB}/
a file that is not there, of a command | $ rasp render goood.yaml -o out.wav
a command misspelt | $ rasp rendr good.yaml -o out.wav
an option misspelt | $ rasp render good.yaml --ouput out.wav
an option without its value | $ rasp render good.yaml -o
a name without an ending | $ rasp render good.yaml -o out
an ending of another kind | $ rasp render good.yaml -o out.mp3
a folder that is not there | $ rasp render good.yaml -o no/where/out.wav
an override without = | $ rasp render good.yaml --set scraper.mass -o out.wav
an override of no key | $ rasp render good.yaml --set mass=30g -o out.wav
a level that no file can hold | $ rasp render good.yaml --set output.level.rms=0 -o out.wav
a recorded sound as input and output | $ rasp render good.yaml --set surface.object=null --set surface.response=tone.wav -o tone.wav
a design given to render | $ rasp render study.yaml -o out.wav
a scene given to batch | $ rasp batch good.yaml -o out
a factor that is no key | $ sed 's/motion.rate/motion.rat/' study.yaml > s.yaml; rasp check s.yaml
a level of a factor that no scene can have | $ sed 's/glass/glas/' study.yaml > s.yaml; rasp check s.yaml
a base that is not there | $ sed 's/good.yaml/god.yaml/' study.yaml > s.yaml; rasp check s.yaml
a folder of another design | $ rasp batch study.yaml -q -o set > /dev/null; rasp batch other.yaml -o set
a picture of an empty table | $ rasp plot empty.csv -o empty.png
modes of silence | $ rasp modes extract silent.wav -o silent.csv
a table of modes that is empty | $ sed 's/^  object:/  response: empty.csv\n  o:/' good.yaml | sed '/^  o:/,/origin/d' > s.yaml; rasp check s.yaml
END
}

number=0 refused=0 warned=0 placed=0 cured=0
while IFS= read -r row; do
    what=${row%% | *} how=${row#* | } code=0
    number=$((number + 1))
    if [ "${how:0:2}" = '$ ' ]; then
        shown=${how:2}
        (eval "$shown") > said 2>&1 < /dev/null || code=$?
    else
        sed "$how" good.yaml > scene.yaml
        cmp -s good.yaml scene.yaml && { echo "mistakes.sh: nothing is edited by $how" >&2; exit 1; }
        shown="sed '$how' good.yaml > scene.yaml; rasp check scene.yaml"
        rasp check scene.yaml > said 2>&1 || code=$?
    fi
    if [ $code != 0 ]; then refused=$((refused + 1)); elif grep -q 'warning' said; then warned=$((warned + 1)); fi
    ! grep -Eq '^[^ ]+:[0-9]+:[0-9]+: |--?[a-z]+|rasp [a-z]*: error: [^ ]+' said || placed=$((placed + 1))
    ! grep -Eq '= help: |did you mean|use |write |give |name |ask for|run |must |choose |add |remove |rasp (check|render|batch)' said || cured=$((cured + 1))
    printf '## %d. %s\n\n```\n$ %s\n' "$number" "${what^}" "$shown"
    sed "s|$WORK/||g; s|$ROOT/||g" said
    printf '(exit code %d)\n```\n\n' "$code"
done < <(mistakes) > rows
cat > "$REPORT" << END
# Sixty mistakes, and what rasp says of them

Made by \`evidence/mistakes.sh\` with $(rasp --version | head -n 1 | cut -d ' ' -f 1,2). \`good.yaml\` is \`rasp new scrape\`, \`study.yaml\` a design of four stimuli over it.
Each mistake stands over its message and the exit code of the command.

Of $number mistakes $refused are refused and $warned warned of. $placed messages name the place: line and column, the option, or the file. $cured say what to do.

END
cat rows >> "$REPORT"

# The job that README.md shows: its line passes where all is as kept, and fails, leaving what differs, where it is not.
. "$ROOT/tests/cli/golden-make.inc"
job=$(sed -n 's/^      - run: \(rasp golden .*\)/\1/p' "$ROOT/README.md")
echo "$job"
mkdir sounds
mv stroke.yaml forces.yaml modes.csv sounds/
printf 'stroke.yaml\nforces.yaml\n' > sounds/list.txt
rasp golden update -q sounds/list.txt --kept sounds/golden
try sh -ec "$job"
flip sounds/golden/stroke/sound.wav 300
try sh -ec "$job"
find differs -type f | sort

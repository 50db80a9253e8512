# Lists and command lines that are wrong.
. "$ROOT/tests/cli/golden-make.inc"
printf '# nothing\n\n' > empty.txt
try rasp golden check empty.txt
try rasp golden check --tap empty.txt
try rasp golden update empty.txt
try rasp golden check gone.txt
try rasp golden check gone.yaml
try rasp golden
try rasp golden chek stroke.yaml
try rasp golden check
try rasp golden update stroke.yaml --snr 3
try rasp golden check stroke.yaml ./stroke.yaml
try rasp golden check stroke.yaml --hashes gone.sha256
try rasp golden check stroke.yaml --kept ""
try rasp golden check stroke.yaml --jobs 0
try rasp golden update stroke.yaml --kept nowhere/golden
cp stroke.yaml 'a stroke.yaml'
try rasp golden check 'a stroke.yaml'
line() {
    printf '%s\n' "forces.yaml" "$1" > list.txt
    try rasp golden check -q list.txt
}
line "stroke.yaml forces.yaml"
line "stroke.yaml --snr loud"
line "stroke.yaml --kept x"
line "stroke.yaml --name ../x"
line "stroke.yaml --name forces"
line "stroke.yaml 'open"
line "--help"
line "stroke.yaml --within 3"
line "stroke.yaml --tolerance gone.csv"
printf '0123\n' > bad.sha256
try rasp golden check stroke.yaml --hashes bad.sha256
try rasp golden check stroke.yaml --hashes stroke.yaml
ls

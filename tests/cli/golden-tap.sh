# Another program that reads the Test Anything Protocol agrees.
command -v prove > /dev/null || { echo "prove is not installed"; exit 77; }
. "$ROOT/tests/cli/golden-make.inc"
printf 'stroke.yaml\nforces.yaml\n' > list.txt
rasp golden update -q list.txt
printf '#!/bin/sh\nexec rasp golden check --tap list.txt\n' > golden.t
chmod +x golden.t
prove --exec sh golden.t | grep -E '^(Result|Files)' | sed 's/,.*//'
flip golden/stroke/sound.wav 300
echo x > golden/forces/more.csv
prove --exec sh golden.t > out 2>&1 || echo "prove fails"
grep -oE '(Failed tests?: .*|Result: .*)' out
: > list.txt
prove --exec sh golden.t > out 2>&1 || echo "prove fails"
grep -E '^(Bail|FAILED)' out

# accuracy.error keeps what it promises, and not absurdly more; it is chosen once, and the same every time.
scene() { # NAME: YAML without rasp and accuracy on standard input
    { echo 'rasp: 1'; cat; } > "$1.yaml"
}
BAR='material: steel, object: {shape: bar, length: 20 cm, width: 3 cm, thickness: 2 mm}'
scene scrape <<YAML
surface: {roughness: {rms: 5 um}, $BAR}
scraper: {mass: 20 g}
motion: {path: back_and_forth, from: [2 cm, 1 cm], to: [12 cm, 1 cm], rate: 2 Hz, duration: 0.5 s}
output: {tail: 0.2 s}
YAML
scene paper <<YAML
surface: {roughness: {rms: 5 um, shortest: 0.2 mm}, $BAR}
scraper: {mass: 20 g}
motion: {path: line, from: [2 cm, 1 cm], to: [12 cm, 1 cm], duration: 0.5 s}
contact: {force: paper}
output: {tail: 0.2 s}
YAML
scene plane <<YAML
surface: {roughness: {rms: 5 um, shortest: 0.1 mm}, $BAR}
scraper: {mass: 20 g}
motion: {path: circle, center: [8 cm, 1.5 cm], radius: 1 cm, turns: 2, duration: 0.5 s}
output: {tail: 0.2 s}
YAML
scene strike <<YAML
surface: {$BAR}
scraper: {mass: 5 g}
motion: {path: still, at: [3 cm, 1 cm], duration: 0.3 s}
contact: {model: strike, strike: {speed: 1 m/s, pulse: half_sine, stiffness: 5e6 N/m}}
output: {tail: 0.2 s}
YAML
# NAME ERROR: told, kept, and by no more than 45 dB too well where a knob was chosen above its least.
kept() {
    rasp render "$1.yaml" --set "accuracy.error=$2" --verify --json -o out.wav > said.json 2> /dev/null || fail "$1 at $2 dB: exit code $?"
    awk -v asked="$2" '
        /"(asked|predicted|measured)_db"/ { gsub(/[",:]/, ""); got[$1] = $2 }
        /"knob"/ { gsub(/[",:]/, ""); knob = $2 }
        /"value"/ { gsub(/[",:]/, ""); n++; raised += knob == "oversampling" && $2 > 1 }
        END {
            same = got["measured_db"] == "null"
            if (!n || got["asked_db"] != asked || got["predicted_db"] > asked || (!same && got["measured_db"] > asked) || (raised && (same || got["measured_db"] < asked - 45)))
                exit 1
        }' out.json || fail "$1 at $2 dB: $(grep _db out.json)"
}
. "$ROOT/tests/lib/test.sh"
for name in scrape paper plane strike; do
    kept $name -40
    kept $name -70
done
# The effective scene spells out all, and gives the same bytes.
rasp render scrape.yaml --set accuracy.error=-70 -o a.wav -q
rasp render a.scene.yaml -o b.wav -q
cmp a.wav b.wav || fail 'the effective scene gives other bytes'
cmp a.scene.yaml b.scene.yaml || fail 'the effective scene is chosen again'
rasp render scrape.yaml --set accuracy.error=-70 -o c.wav -q
cmp a.scene.yaml c.scene.yaml || fail 'the same scene is given other knobs'
grep -q '^  error: -70$' a.scene.yaml || fail 'the effective scene does not have the error'
# A knob that is said is kept; an error that is not kept is told.
rasp render scrape.yaml --set accuracy.error=-40 --set accuracy.oversampling=5 -o d.wav -q
grep -q '^  oversampling: 5$' d.scene.yaml || fail 'a knob that is said is not kept'
sed 's/^  oversampling: .*/  oversampling: 1/' a.scene.yaml > broken.yaml
code=0
rasp render broken.yaml --verify -o e.wav > /dev/null 2> words || code=$?
[ $code = 1 ] || fail "exit code $code where the error is not kept"
grep -Eq '^rasp render: error: broken.yaml:[0-9]+:[0-9]+: accuracy.error: -70 dB is not kept: -[0-9.]* dB measured' words || fail "$(cat words)"
[ -f e.wav ] && [ -f e.json ] || fail 'files are gone'
# A knob as fine as the reference's is measured against twice that; one that has nothing finer is told.
scene tip <<YAML
surface: {roughness: {rms: 3 um, longest: 1 mm, shortest: 50 um}}
scraper: {mass: 8 g, radius: 0.3 mm, patch: 30 um}
motion: {path: circle, center: [5 cm, 5 cm], radius: 5 mm, turns: 0.1, duration: 0.05 s}
output: {quantity: force}
accuracy: reference
YAML
rasp render tip.yaml --verify -o f.wav > words 2>&1
grep -q 'accuracy: -[0-9.]* dB measured, against the reference; nothing of oversampling 64, as the reference has no finer than 64$' words || fail "$(cat words)"
rasp render tip.yaml --set accuracy.oversampling=32 --verify -o f.wav > words 2>&1
grep -q 'dB measured, against the reference$' words || fail "$(cat words)"
rasp render tip.yaml --set accuracy.oversampling=33 --verify -o f.wav > words 2>&1
grep -q '; less than all of oversampling 33, as the reference has no finer than 64$' words || fail "$(cat words)"
finish

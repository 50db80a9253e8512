# Scenes that are meant to do harm: refused with a message, before memory or time is taken; what the cases of faults/bad_inputs do not have.
. "$ROOT/tests/lib/test.sh"
ulimit -v 2000000 -t 20 # 2 GB, 20 s
sed "s|\.\./irs/|$ROOT/irs/|" "$ROOT/scenes/ceramic_stroke.yaml" > scene.yaml
repeat() { printf "%$1s" '' | sed "s/ /$2/g"; }

# Numbers far outside of what is meant, as is and with a unit.
for key in motion.duration output.duration output.tail output.sample_rate output.diagnostics.rate start scraper.mass load.constant surface.roughness.rms \
    surface.roughness.longest surface.roughness.shortest accuracy.oversampling output.level.peak gain; do
    for value in 1e308 -1e308 1e999 .nan nan -.inf 1e-320 0x1p1023; do
        case $key:$value in gain:1e-320 | load.constant:1e-320 | output.tail:1e-320 | start:1e-320 | output.level.peak:1e-320) continue ;; esac # as good as 0
        expect_exit 65 rasp render scene.yaml -o sound.wav --set "$key=$value"
        expect_text err "^--set $key: error: (the first number of )?$key "
    done
done
expect_files scene.yaml

# Names.
expect_exit 73 rasp render scene.yaml -o "$(repeat 5000 a).wav"
expect_text err 'the path is too long'
expect_exit 73 rasp render scene.yaml -o "$(repeat 300 a).wav"
expect_text err 'File name too long'
expect_exit 73 rasp render scene.yaml -o "$(repeat 2500 'a\/')a.wav"
expect_text err 'the path is too long'
for name in ../x a/b . .. "$(printf 'a\007b')" "$(printf 'a\033[31mb')"; do
    expect_exit 65 rasp check scene.yaml --set "name=$name"
    ! LC_ALL=C grep -q "$(printf '[\001-\011\013-\037]')" err || fail "a control character reaches the terminal"
done
expect_exit 66 rasp check "$(repeat 5000 a).yaml"

# Contacts by the thousand; a text as long as a file may be; what never ends.
{
    printf 'rasp: 1\ncontacts:\n'
    for i in $(seq 1001); do echo "  - {name: c$i}"; done
} > many.yaml
expect_exit 65 rasp check many.yaml
expect_text err 'contacts must be a list of 1 to 1000 contacts, not of 1001'
{ printf 'rasp: 1\ntitle: '; head -c 4000000 /dev/zero | tr '\0' 'a'; echo; } > long.yaml
expect_exit 65 rasp check long.yaml
[ "$(wc -c < err)" -lt 20000 ] || fail "a long text makes a long message"
printf 'rasp: 1\ninclude: [/dev/zero]\n' > zero.yaml
expect_exit 65 rasp check zero.yaml
expect_text err '/dev/zero: error: larger than 4 MiB'
finish

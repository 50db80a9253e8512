# Designs that are meant to do harm: each is refused with a message that names what is wrong, before memory or time is taken, and nothing is written outside of the output
# folder, or at all.
. "$ROOT/tests/lib/test.sh"
ulimit -v 2000000 -t 20 # 2 GB, 20 s
cp "$ROOT/scenes/ceramic_stroke.yaml" base.yaml
sed -i "s|\.\./irs/|$ROOT/irs/|" base.yaml

# design LINE...: what follows the head.
design() { printf '%s\n' 'rasp-design: 1' 'base: base.yaml' "$@" > design.yaml; }

# refused CODE PATTERN: by check, by batch, and by a batch that only lists.
refused() {
    expect_exit "$1" rasp check design.yaml
    expect_text err "$2"
    expect_exit "$1" rasp batch design.yaml -o folder --dry-run
    expect_text err "$2"
    expect_exit "$1" rasp batch design.yaml -o folder
    expect_text err "$2"
    [ ! -s out ] || fail "on standard output: $(head -n 1 out)"
    expect_files base.yaml design.yaml
}

repeat() { printf "%$1s" '' | sed "s/ /$2/g"; }

# Sizes.
{
    printf '%s\n' 'rasp-design: 1' 'base: base.yaml' 'a: &a [1,1,1,1,1,1,1,1,1]'
    before=a
    for name in b c d e f g h i; do
        echo "$name: &$name [*$before,*$before,*$before,*$before,*$before,*$before,*$before,*$before,*$before]"
        before=$name
    done
} > design.yaml
refused 65 'more than 100000 values after expanding aliases'
design "factors: $(repeat 100000 '[')"
refused 65 'nested more than 64 deep'
design "factors: $(repeat 100000 '{a: ')"
refused 65 'nested more than 64 deep'
design 'factors:'
for name in a b c d e f g h i j k l; do
    echo "  $name: [{label: l0}, {label: l1}, {label: l2}, {label: l3}, {label: l4}, {label: l5}, {label: l6}, {label: l7}, {label: l8}, {label: l9}]" >> design.yaml
done
refused 65 'this makes 1000000000000 stimuli; a design has at most 1000000'
for n in 2000000000 1e308 99999999999999999999 .nan -1; do
    design 'factors: {motion.duration: [1 s]}' "replicates: $n"
    refused 65 'replicates must be a whole number from 1 to 1000000'
done
design 'factors: {motion.duration: [1 s]}' 'length: 1e308 s'
refused 65 'length'
design 'factors: {motion.duration: [1 s, 1e308 s]}'
refused 65 'motion\.duration must be from .* not .1e308 s'
design 'factors: {output.sample_rate: [48 kHz, 1e12 Hz]}'
refused 65 'output\.sample_rate must be from .* not .1e12 Hz'
design 'factors: {load.constant: [1 N, .nan]}'
refused 65 'load\.constant .*finite'

# Names: out of the folder, of the set's own files, too long, with what a terminal would obey.
for name in '../{m}' '../../../../tmp/{m}' '{m}/../../x' './{m}' '.rasp/{m}' '.{m}'; do
    design 'factors: {m: [{label: a}, {label: b}]}' "name: \"$name\""
    refused 65 'has a part that begins with a dot: it would be hidden, or lie outside of the output folder'
done
for name in '/etc/{m}' '{m}//x' '{m}/'; do
    design 'factors: {m: [{label: a}, {label: b}]}' "name: \"$name\""
    refused 65 'the name .* has a folder without a name|must'
done
for label in .. . ../../etc/passwd .rasp; do
    design "factors: {m: [{label: $label}]}" 'name: "{m}"'
    refused 65 'has a part that begins with a dot'
done
for label in manifest timings; do
    design "factors: {m: [{label: $label}]}" 'name: "{m}"'
    refused 65 "the name '$label' .* is that of a table of the set"
done
design "factors: {m: [{label: $(repeat 5000 a)}]}"
refused 65 'label must be a text of 1 to 100 bytes in one line'
design "factors: {m: [{label: $(repeat 90 a)}], n: [{label: $(repeat 90 b)}], o: [{label: $(repeat 90 c)}]}" "name: '{m}{n}{o}'"
refused 65 'the name .* has a part of more than 200 letters'
design 'factors: {m: [{label: a}]}' "name: \"$(repeat 5000 a)\""
refused 65 'name must be a text of at most 1000 letters'
for label in 'a\x07b' 'a\nb' 'a\e[31mb' 'a\x7fb'; do
    design "factors: {m: [{label: \"$label\"}]}"
    refused 65 'label must be a text of 1 to 100 bytes in one line'
    ! LC_ALL=C grep -q "$(printf '[\001-\011\013-\037]')" err || fail "a control character reaches the terminal: $label"
done

# Files.
design 'factors: {m: [{label: a}]}' "recordings: [{file: /dev/zero, m: a}]"
expect_exit 66 rasp batch design.yaml -o folder
expect_text err '/dev/zero: is not a file'
printf '%s\n' 'rasp-design: 1' 'base: /dev/zero' 'factors: {motion.duration: [1 s]}' > design.yaml
expect_exit 65 rasp batch design.yaml -o folder
expect_text err '/dev/zero: error: larger than 4 MiB'
printf '%s\n' 'rasp-design: 1' 'base: design.yaml' 'factors: {motion.duration: [1 s]}' > design.yaml
expect_exit 65 rasp batch design.yaml -o folder
expect_files base.yaml design.yaml
finish

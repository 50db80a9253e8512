# A set that finds no room or no right to write: 73 or 74, a message, nothing half-written; with room again the same command makes of it what an undisturbed run makes.
. "$ROOT/tests/lib/test.sh"
cat > base.yaml << 'END'
rasp: 1
surface: {roughness: {rms: 4 um}, object: {shape: plate, length: 20 cm, width: 10 cm, thickness: 4 mm}, material: steel, modes: 5}
scraper: {mass: 5 g}
motion: {path: line, from: [2 cm, 2 cm], to: [4 cm, 3 cm], duration: 0.3 s}
output: {tail: 10 ms, diagnostics: {rate: 1 kHz}}
END
printf '%s\n' 'rasp-design: 1' 'base: base.yaml' 'factors: {motion.duration: [0.2 s, 0.3 s, 0.4 s]}' 'replicates: 2' > design.yaml
{ cat design.yaml; echo 'level: {common: {full_scale: 0.01}}'; } > known.yaml # no gain to wait for
expect_exit 0 rasp batch -q design.yaml -o right
mkdir deep # as far from the design as disk/set
expect_exit 0 rasp batch -q known.yaml -o deep/right_known
for i in 1 2; do
    expect_exit 0 rasp batch -q design.yaml -o shards --shard $i/2
done

# complete FOLDER [RIGHT]: as if nothing had been. Timings hold times.
complete() {
    local left
    diff -r -q -x timings.csv "${2:-right}" "$1" > differs || { fail "$1 is not what an undisturbed run leaves"; cat differs; }
    left=$(find "$1" -name '*.part')
    [ -z "$left" ] || fail "left behind: $left"
}

# whole FOLDER [RIGHT]: what is there under its own name is as it should be.
whole() {
    local file
    while read -r file; do
        cmp -s "$1/$file" "${2:-right}/$file" || fail "half-written: $1/$file"
    done < <(cd "$1" && find . -name '*_r[12].wav' -o -name '*_r[12].csv' -o -name SHA256SUMS)
}

# Called through expect_exit.
# shellcheck disable=SC2317
limited() { (ulimit -f "$1" && trap '' XFSZ && exec "${@:2}"); }

# Files of at most so many KiB: not even whose the folder is; a record does not fit; a sound does not; a table does not.
expect_exit 73 limited 0 rasp batch -q design.yaml -o limited0
expect_exit 0 rasp batch -q design.yaml -o limited0
complete limited0
for most in 1 2 8 16; do
    expect_exit 74 limited $most rasp batch -q design.yaml -o "limited$most"
    expect_text err '^rasp batch: error: .*(File too large|cannot be written|disk)'
    [ ! -d "limited$most" ] || whole "limited$most"
    expect_exit 0 rasp batch -q design.yaml -o "limited$most"
    complete "limited$most"
done
cp -r shards limited
expect_exit 74 limited 2 rasp batch -q design.yaml -o limited --no-render
expect_exit 0 rasp batch -q design.yaml -o limited
complete limited

# Folders in which nothing can be made.
echo plain > file
for folder in file file/sub nowhere/sub; do
    expect_exit 73 rasp batch -q design.yaml -o $folder
    expect_text err "^rasp batch: error: .*$folder"
done
[ "$(cat file)" = plain ] || fail "the file was changed"
expect_exit 73 rasp batch -q design.yaml -o /proc/sets

# An output that is a symbolic link: what it points to is replaced, as rasp render does; links stay links. In a folder that is nobody's yet it may be anybody's.
mkdir linked
echo old > target
ln -s ../target linked/0.2s_r1.wav
expect_exit 73 rasp batch -q design.yaml -o linked
[ "$(cat target)" = old ] || fail "what a link points to was changed"
expect_exit 0 rasp batch -q design.yaml -o linked --replace
if [ ! -L linked/0.2s_r1.wav ] || ! cmp -s target right/0.2s_r1.wav; then fail "a link was not followed, or replaced"; fi

[ "$(id -u)" = 0 ] || finish
mkdir disk
mount -t tmpfs -o size=64k none disk 2> /dev/null || finish
expect_exit 73 rasp batch -q design.yaml -o disk/set
expect_text err '^rasp batch: error: .* GB are free, and the sounds take .* until the common level is known'
umount disk
for size in 12k 64k 160k; do
    mount -t tmpfs -o size=$size none disk
    expect_exit 74 rasp batch -q known.yaml -o disk/set
    expect_text err '^rasp batch: error: .*([Nn]o space|disk)'
    [ ! -d disk/set ] || whole disk/set deep/right_known
    mount -o remount,size=8m disk
    expect_exit 0 rasp batch -q known.yaml -o disk/set
    complete disk/set deep/right_known
    umount disk
done
mount -t tmpfs -o size=8m none disk
cp -r shards disk/set
mount -o remount,ro disk
expect_exit 73 rasp batch -q design.yaml -o disk/other
expect_text err 'Read-only file system'
expect_exit 73 rasp batch -q design.yaml -o disk/set
expect_text err 'Read-only file system'
umount disk
finish

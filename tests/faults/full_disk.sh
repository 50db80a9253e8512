# A disk that fills up while a render writes: exit code 74 (or 73), a message, and nothing half-written.
. "$ROOT/tests/lib/test.sh"
scene=$(short_scene)

# What fits nowhere: as root a file system of 64 KiB, else (and besides) a limit on the size of files.
limited() {
    (ulimit -f 8 && trap '' XFSZ && exec "$@") # 8 KiB
}

mkdir limit
cd limit || exit 1
expect_exit 74 limited rasp render "$scene" -o sound.wav
expect_text err '^rasp render: error: .*(sound|diagnostics|large|space|write)'
expect_files
cd ..

# Not a byte fits; what is said goes through a pipe, for there is no file for it either.
code=0
told=$(ulimit -f 0 && trap '' XFSZ && rasp render --quiet "$scene" -o none.wav --set 'output.level={full_scale: 10 m/s}' --set output.diagnostics=null 2>&1) || code=$?
[ "$code" = 73 ] && grep -q 'none.wav: the sound file cannot be begun, .*File too large; is the disk full' <<< "$told" || fail "exit $code, and $told"

mkdir disk
if [ "$(id -u)" = 0 ] && mount -t tmpfs -o size=64k none disk 2> /dev/null; then
    expect_exit 74 rasp render "$scene" -o disk/sound.wav
    expect_text err '^rasp render: error: .*([Nn]o space|full)'
    left=$(find disk -mindepth 1)
    [ -z "$left" ] || fail "left behind: $left"
    umount disk
fi
finish

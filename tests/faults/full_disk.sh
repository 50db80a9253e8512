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

mkdir disk
if [ "$(id -u)" = 0 ] && mount -t tmpfs -o size=64k none disk 2> /dev/null; then
    expect_exit 74 rasp render "$scene" -o disk/sound.wav
    expect_text err '^rasp render: error: .*([Nn]o space|full)'
    left=$(find disk -mindepth 1)
    [ -z "$left" ] || fail "left behind: $left"
    umount disk
fi
finish

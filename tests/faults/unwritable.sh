# Places where no file can be made: exit code 73 before any work, a message that names the place, and nothing left.
. "$ROOT/tests/lib/test.sh"
scene=$(short_scene)

echo plain > file
mkdir sealed

expect_exit 73 rasp render "$scene" -o file/sound.wav
expect_text err '^rasp render: error: .*file/sound\.'
expect_exit 73 rasp render "$scene" -o nowhere/sound.wav
expect_text err '^rasp render: error: .*nowhere/sound\.'
expect_exit 73 rasp render "$scene" -o file/
expect_text err '^rasp render: error: .*file'
expect_exit 73 rasp render "$scene" -o nowhere/deeper/
expect_text err '^rasp render: error: .*nowhere/deeper'
[ "$(cat file)" = plain ] || fail "the file was changed"
expect_files file sealed

# A folder without the right to write; root may always, except where the file system is read-only.
if [ "$(id -u)" != 0 ]; then
    chmod 555 sealed
    expect_exit 73 rasp render "$scene" -o sealed/sound.wav
    expect_text err 'Permission denied'
elif mount -t tmpfs -o ro none sealed 2> /dev/null; then
    expect_exit 73 rasp render "$scene" -o sealed/sound.wav
    expect_text err 'Read-only file system'
    umount sealed
fi
finish

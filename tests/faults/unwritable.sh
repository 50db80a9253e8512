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
# /proc is a folder, but none of files.
expect_exit 73 rasp render "$scene" -o /proc/
expect_text err '^rasp render: error: .*/proc/.*cannot be created: its folder is none in which files can be made'
printf 'rasp-design: 1\nbase: %s\nreplicates: 2\n' "$scene" > set.yaml
expect_exit 73 rasp batch set.yaml -o /proc
expect_text err '^rasp batch: error: the folder /proc/.rasp cannot be created: no folder can be made there'
expect_exit 73 rasp batch set.yaml -o nowhere/set
expect_text err 'its parent is not there'
rm set.yaml
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

# Inputs that are not there or cannot be read: exit code 66 and the name; damaged ones: 65. No output appears.
. "$ROOT/tests/lib/test.sh"

expect_exit 66 rasp render nothing.yaml -o sound.wav
expect_text err 'nothing\.yaml'
expect_exit 66 rasp compare nothing.wav nothing.wav
expect_text err 'nothing\.wav'
mkdir folder.yaml
expect_exit 66 rasp render folder.yaml -o sound.wav
expect_text err 'folder\.yaml'

head -c 4096 /dev/zero > zeros.yaml
expect_exit 65 rasp render zeros.yaml -o sound.wav
expect_text err 'zeros\.yaml'
head -c 4096 /dev/zero > zeros.wav
expect_exit 65 rasp compare zeros.wav zeros.wav
expect_text err 'zeros\.wav'
expect_files folder.yaml zeros.yaml zeros.wav
finish

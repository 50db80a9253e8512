# Standard output that takes nothing more: exit code 74 and a message, for each command that prints.
. "$ROOT/tests/lib/test.sh"
scene=$(short_scene)

# full COMMAND...: with stdout on /dev/full.
full() {
    local got=0
    "$@" > /dev/full 2> err < /dev/null || got=$?
    [ $got = 74 ] || fail "exit code $got instead of 74: $*"
    expect_text err 'cannot write to standard output'
}

full rasp --help
full rasp --version
full rasp explain
full rasp plan "$scene"
finish

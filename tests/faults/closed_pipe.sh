# A reader that stops early wants no more: the writer ends with 74 and without a word, and does not hang or crash.
. "$ROOT/tests/lib/test.sh"

# More is written than a pipe holds, or the reader is gone before the first byte.
rasp explain 2> err < /dev/null | : ; codes=("${PIPESTATUS[@]}")
case ${codes[0]} in
    74) ;;
    0) [ "$(rasp explain | wc -c)" -le 65536 ] || fail "exit code 0 though not everything was read" ;;
    *) fail "exit code ${codes[0]}: $(cat err)" ;;
esac
[ ! -s err ] || fail "something is said: $(cat err)"

# A pipe whose reader is gone for certain.
mkfifo pipe
exec 3<> pipe 4> pipe 3>&-
for command in explain "plan $ROOT/scenes/recorded.yaml" "render $ROOT/scenes/recorded.yaml -o -"; do
    got=0
    # shellcheck disable=SC2086
    rasp $command >&4 2> err < /dev/null || got=$?
    [ $got = 74 ] || fail "exit code $got instead of 74: rasp $command into a closed pipe"
    [ ! -s err ] || fail "rasp $command: something is said: $(cat err)"
done

# What was read before is right.
first=$(rasp explain 2> /dev/null | head -n 1)
[ "$first" = "$(rasp explain > all; head -n 1 all)" ] || fail "the first line through a pipe differs"

# Closed standard streams: no file takes their place.
got=0
rasp explain >&- 2> err || got=$?
[ $got = 74 ] || fail "exit code $got instead of 74: stdout closed"
finish

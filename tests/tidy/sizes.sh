# Sizes of src/: fails beyond 800 lines a file, 100 a function or 120 columns; names what is beyond 600 and 60 lines.
. "$ROOT/tests/lib/test.sh"
cd "$ROOT/src" || exit 1

# over FILE_LIMIT FUNCTION_LIMIT: what is longer.
over() {
    find . -name '*.[ch]' -printf '%P\n' | sort | xargs wc -l | awk -v limit="$1" '$2 != "total" && $1 > limit { print $2 ": " $1 " lines" }'
    find . -name '*.c' -printf '%P\n' | sort | ctags -L - -o - --languages=C --kinds-C=f --fields=ne --sort=no 2> /dev/null | awk -F '\t' -v limit="$2" '
        {
            first = last = 0
            for (i = 4; i <= NF; i++) {
                if ($i ~ /^line:/) first = substr($i, 6)
                if ($i ~ /^end:/) last = substr($i, 5)
            }
            if (last - first + 1 > limit) print $2 ": " $1 "() has " last - first + 1 " lines"
        }'
}

ctags --version 2> /dev/null | grep -q Universal || skip "universal-ctags is not installed"
[ -n "$(over 0 0 | grep '()')" ] || fail "sizes: ctags finds no functions"
wrong=$(over 800 100)
[ -z "$wrong" ] || fail "$wrong"
wide=$(find . -name '*.[ch]' -printf '%P\n' | xargs awk 'length > 120 { print FILENAME ":" FNR ": " length " columns" }')
[ -z "$wide" ] || fail "$wide"
warned=$(over 600 60)
[ -z "$warned" ] || printf 'long, not refused:\n%s\n' "$warned"
finish

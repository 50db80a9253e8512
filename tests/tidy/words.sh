# No tracked file holds a machine's paths, an e-mail address, or a note that something is not done. A Debian package must name an address: that one is at
# example.invalid, where by RFC 2606 nobody is.
. "$ROOT/tests/lib/test.sh"

# words FOLDER: every hit, as file:line:text. The patterns are split so that this file is none.
words() {
    (
        cd "$1" || exit
        { git ls-files -co --exclude-standard 2> /dev/null || find . -type f ! -path './build*' ! -path './out/*' -printf '%P\n'; } | grep -vx LICENSE |
            tr '\n' '\0' | xargs -0 -r grep -InE -e '(^|[^[:alnum:]._/$}-])/(ho''me|wo''rk|ro''ot|m''nt|Us''ers|op''t|var/fo''lders)/[[:alnum:]]' \
            -e '[[:alnum:]._%+-]+@[[:alnum:]-]+\.[[:alpha:]]{2,}' -e '\<(TO''DO|FIX''ME|XX''X|HA''CK|WI''P)\>' -e '\<[Ss]tu''b(bed|s)?\>' \
            -e '[Pp]lace''holder' -- |
            grep -v -e '^debian/[a-z]*:[0-9]*:.*<rasp@example\.invalid>'
    )
}

mkdir -p planted/debian
printf '%s\n' '/* TO''DO: later */' 'x = "/ho''me/someone/file"' 'mail some.one''@example.org' 'a stu''b' 'a fine line, 3/4 of it' > planted/file.c
printf '%s\n' 'Maintainer: <rasp@exam''ple.invalid>' 'Maintainer: <some.one''@example.org>' > planted/debian/control
[ "$(words "$PWD/planted" | wc -l)" = 5 ] || fail "words: planted words were not caught"

wrong=$(words "$ROOT")
[ -z "$wrong" ] || fail "$wrong"
finish

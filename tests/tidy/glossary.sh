# src/GLOSSARY.md: every file that it names is there, and the terms and equations that one looks for lead to it.
. "$ROOT/tests/lib/test.sh"
glossary=$ROOT/src/GLOSSARY.md
files=$(grep -o '`[a-z]*/[a-z_]*\.[ch]`' "$glossary" | tr -d '`' | sort -u)
[ -n "$files" ] || fail "glossary: it names no file"
for file in $files; do
    [ -f "$ROOT/src/$file" ] || fail "src/GLOSSARY.md names $file, which is not there"
done
for term in 'eq. 7' 'ARMA(1,1)' 'action space' 'residual' 'rolling curve' 'modified convolution'; do
    grep -qF "$term" "$glossary" || fail "src/GLOSSARY.md does not have '$term'"
done
finish

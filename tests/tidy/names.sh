# The home of every name is known from the name: what foo.o exports is called foo or foo_*.
. "$ROOT/tests/lib/test.sh"

# names OBJECT...: exported names that do not follow from the object's name. A clone's name continues after a dot. num/resample.c and num/fft.c take the
# place of libm's functions for the libraries, by their names; num/fft.c that of one of FFTW's, too.
names() {
    nm -A --defined-only --extern-only --format=posix "$@" | awk '
        { home = $1; sub(/.*\//, "", home); sub(/\.o:$/, "", home); $1 = $2; sub(/\..*/, "", $1) }
        home ~ /^main(_|$)/ && $1 == "main" { next }
        home == "resample" && $1 ~ /^(exp|log|log10|pow|sin|cos|asin)$/ { next }
        home == "fft" && $1 ~ /^(sincos|fftw_assertion_failed)$/ { next }
        $1 != home && index($1, home "_") != 1 && !seen[home, $1]++ { print home ".o exports " $1 }'
}

mkdir planted
echo 'int right(void); int right(void) { return 0; } int right_too; int wrong;' > planted/right.c
"${CC:-gcc}" -c -o planted/right.o planted/right.c
[ "$(names planted/right.o)" = "right.o exports wrong" ] || fail "names: a planted name was not caught"

objects=()
while read -r source; do
    object=$BUILD/${source%.c}.o
    [ -f "$object" ] || { fail "not built: $object"; continue; }
    objects+=("$object")
done < <(cd "$ROOT/src" && find . -name '*.c' -printf '%P\n')
[ ${#objects[@]} -gt 0 ] || fail "no objects in $BUILD"
wrong=$(names "${objects[@]}")
[ -z "$wrong" ] || fail "$wrong"
finish

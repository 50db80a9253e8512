# Which outside functions rasp's own objects call. Those of libm whose last bits depend on the CPU (its versions with and without
# fused multiply-add differ) would break "same scene, same bytes": num/real.h and num/vecmath.h stand in for them. Calls whose
# result cannot reach a sample are listed, with the reason, in libm.allow. Some others are never right here.
. "$ROOT/tests/lib/test.sh"

LIBM="exp exp2 exp10 expm1 pow10 log log2 log10 log1p pow sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh
      cbrt hypot lgamma tgamma erf erfc gamma j0 j1 jn y0 y1 yn cabs carg cexp clog cpow csqrt csin ccos ctan csinh ccosh ctanh"
NEVER="rand srand random srandom rand_r drand48 erand48 lrand48 time gettimeofday localtime ctime setlocale atof atoi atol strcpy
       strcat sprintf vsprintf gets strtok tmpnam mktemp scanf sscanf fscanf system"

# calls OBJECT...: undefined names that are not allowed anywhere, or not here.
calls() {
    nm -A --undefined-only --format=posix "$@" | awk -v build="$BUILD/" -v libm="$LIBM" -v never="$NEVER" '
        BEGIN {
            n = split(libm, name, /[ \n]+/)
            for (i = 1; i <= n; i++) { risky[name[i]]; risky[name[i] "f"]; risky[name[i] "l"] }
            n = split(never, name, /[ \n]+/)
            for (i = 1; i <= n; i++) { refused[name[i]]; refused["__isoc99_" name[i]] }
        }
        FILENAME != "-" { if (NF && !/^#/) allowed[$1 " " $2]; next }
        { object = index($1, build) == 1 ? substr($1, length(build) + 1) : $1; sub(/\.o:$/, ".c", object); $1 = $2 }
        $1 in refused { print object ": calls " $1 }
        $1 in risky && !((object " " $1) in allowed) { print object ": calls libm " $1 "(); use num/real.h or num/vecmath.h" }
    ' "$ROOT/tests/tidy/libm.allow" -
}

mkdir planted
echo 'double tanh(double); int rand(void); double f(double x); double f(double x) { return tanh(x) + rand(); }' > planted/p.c
"${CC:-gcc}" -O0 -fno-builtin -c -o planted/p.o planted/p.c
[ "$(calls planted/p.o | wc -l)" = 2 ] || fail "symbols: planted calls were not caught"

objects=()
while read -r source; do
    object=$BUILD/${source%.c}.o
    if [ -f "$object" ]; then objects+=("$object"); else fail "not built: $object"; fi
done < <(cd "$ROOT/src" && find . -name '*.c' -printf '%P\n')
wrong=$(calls "${objects[@]}")
[ -z "$wrong" ] || fail "$wrong"

# The list holds nothing that is not needed any more, and a reason on every line.
while read -r source name reason; do
    case $source in '' | '#'*) continue ;; esac
    [ -n "$reason" ] || fail "libm.allow: no reason for $source $name"
    nm --undefined-only --format=posix "$BUILD/${source%.c}.o" 2> /dev/null | grep -q "^$name " ||
        fail "libm.allow: $source does not call $name (any more)"
done < "$ROOT/tests/tidy/libm.allow"
finish

# Same scene, same bytes: the WAV and the CSV of every scene, and mode tables computed and extracted, have one sha256
# whatever the compiler, the optimisation, the instruction set and the functions libm picks for this CPU (golden tests
# render each scene twice).
# ISAS="v2 v3 v4" also builds all of rasp for each of these levels, OPTS="-O0 -O1 -O3" at each of these.
. "$ROOT/tests/lib/test.sh"
BUILDS=${BYTES:-$BUILD/bytes}
JOBS=${JOBS:-$(getconf _NPROCESSORS_ONLN)}

# build NAME VARIABLE=VALUE...: rasp in a folder of its own.
build() {
    local name=$1
    shift
    env -u MAKEFLAGS -u MAKELEVEL \
        make -s -C "$ROOT" -j"$JOBS" BUILD="$BUILDS/$name" "$@" all > log 2>&1 && return
    fail "the build '$name' fails:"
    tail -n 20 log
    return 1
}

# sums PROGRAM: sha256 of every file it makes of the scenes. Sound as float64: coarser encodings round most differences away.
sums() {
    rm -rf rendered && mkdir rendered
    printf '%s\n' "$ROOT"/scenes/*.yaml | xargs -P "$JOBS" -I{} "$1" render --quiet --set output.encoding=float64 -o rendered/ {} > log 2>&1 || cat log
    tables "$1" >> log 2>&1 || cat log
    (cd rendered && find . -type f \( -name '*.wav' -o -name '*.csv' \) -print0 | sort -z | xargs -0r sha256sum)
}

# tables PROGRAM: mode tables: modes of two solids with equal frequencies; those of a recording of strikes,
# with the response, what the modes make of it and what is left.
tables() {
    "$1" modes compute --shape sphere:diameter=20cm,fineness=1 --material steel --modes 20 --top 60kHz -q -o rendered/table_ball.csv &&
        "$1" modes compute --shape ring:diameter=14cm,width=1cm,thickness=6mm --material steel --modes 20 -q -o rendered/table_ring.csv &&
        "$1" modes extract strikes.wav --force-channel 2 -q -o rendered/table_strikes.csv \
            --resynthesis rendered/table_made.wav --residual rendered/table_left.wav &&
        "$1" modes material ring:diameter=14cm,width=1cm,thickness=6mm rendered/table_ring.csv --order 2 --modes 20 --json -f -o rendered/material.yaml > rendered/material.csv &&
        "$1" modes residual strikes.wav rendered/table_strikes.csv --force-channel 2 --strikes 1 -f -q -o rendered/residual
}

# same NAME PROGRAM: its sums must be those of the first program asked.
same() {
    sums "$2" > got
    [ -s want ] || cp got want
    cmp -s want got && echo "same bytes: $1" && return
    fail "other bytes: $1"
    diff want got
}

cpu_has() {
    case $1 in
        v2) grep -qw sse4_2 /proc/cpuinfo ;;
        v3) grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo ;;
        v4) grep -qw avx512vl /proc/cpuinfo && grep -qw avx512bw /proc/cpuinfo ;;
    esac
}

. "$ROOT/tests/cli/modes-extract-make.inc" # a plate that is struck
"$BUILD/rasp" render -q plate.yaml && python3 wav.py join plate.wav plate.force.wav strikes.wav 1e-6
same "gcc -O2, best of the CPU" "$BUILD/rasp"
scenes=("$ROOT"/scenes/*.yaml)
[ "$(wc -l < want)" -ge $((${#scenes[@]} + 6)) ] || fail "only $(wc -l < want) files of ${#scenes[@]} scenes and 2 solids and strikes"

# Without FMA and AVX the C library picks other exp, log, sin ...: the probe shows that it does.
hidden=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F
cat > probe.c << 'END'
#include <math.h>
#include <stdio.h>
int main(void)
{
    for (int i = 1; i < 10000; i++) /* every last bit: a sum would round the difference away */
        printf("%a\n", exp(i * 1e-3) * sin(i * 0.37));
}
END
"${CC:-gcc}" -O0 -o probe probe.c -lm || fail "the probe of libm does not compile"
if [ "$(./probe)" = "$(GLIBC_TUNABLES=$hidden ./probe)" ]; then
    echo "left out: this C library's functions are the same without FMA"
else
    GLIBC_TUNABLES=$hidden same "libm without FMA" "$BUILD/rasp"
fi

# Another compiler, another level of optimisation and another instruction set at once: the first program has chosen this
# CPU's best per hot loop, clang's is for any x86-64.
build clang-O1 CC=clang OPT=-O1 && same "clang -O1" "$BUILDS/clang-O1/rasp"
for opt in ${OPTS:-}; do
    build gcc$opt CC=gcc OPT=$opt && same "gcc $opt" "$BUILDS/gcc$opt/rasp"
done
for isa in ${ISAS:-}; do
    cpu_has $isa || { echo "left out: this CPU has no x86-64-$isa"; continue; }
    build gcc-$isa CC=gcc OPT=-O2 ISA=$isa && same "gcc -O2 for x86-64-$isa" "$BUILDS/gcc-$isa/rasp"
done
finish

# Another kind of CPU: rasp built for aarch64 by a cross compiler and run by qemu. It says its version, scenes that need no FFT and no
# eigenvalues have the bytes of the program built here, and one that does is that sound but for rounding: Debian's FFTW, GSL, libsoxr and
# libebur128 for aarch64 are compiled with fused multiply-add, and so is libm's hypot, which GSL calls. Built without it, they give the
# same bits. SYSROOT is a folder with the libraries for aarch64 (their packages unpacked); default: the system's own of that architecture.
. "$ROOT/tests/lib/test.sh"
HOST=aarch64-linux-gnu
BUILDS=${BYTES:-$BUILD/bytes}
JOBS=${JOBS:-$(getconf _NPROCESSORS_ONLN)}
SYSROOT=${SYSROOT:-}
SYSROOT=${SYSROOT%/}
LEAST=200 # dB of signal above the difference, where FFTW has a part in it: some 270

[ "$(uname -m)" != aarch64 ] || skip "this is an aarch64 machine: all tests are of it"
command -v $HOST-gcc > /dev/null || skip "no $HOST-gcc"
EMULATOR=$(command -v qemu-aarch64-static || command -v qemu-aarch64) || skip "no qemu-aarch64"

export PKG_CONFIG_SYSROOT_DIR=$SYSROOT PKG_CONFIG_LIBDIR=$SYSROOT/usr/lib/$HOST/pkgconfig:$SYSROOT/usr/share/pkgconfig
# OpenBLAS's header, which the library of all objects needs, lies in a folder of its own where packages are unpacked and not installed.
COMPILER="$HOST-gcc ${SYSROOT:+--sysroot=$SYSROOT} -idirafter $SYSROOT/usr/include/$HOST/openblas-pthread"

# emulated COMMAND...: runs a program for aarch64.
emulated() { "$EMULATOR" -L "${SYSROOT:-/}" "$@"; }

# The libraries: those that pkg-config knows, then what it does not, which also shows that the emulator finds and runs what was linked.
packages=$(sed -n 's/^PKGS = //p' "$ROOT/Makefile")
# shellcheck disable=SC2086 # one word per package
pkg-config --exists $packages 2> /dev/null || skip "no libraries for aarch64 ($packages)${SYSROOT:+ in SYSROOT}"
cat > probe.c << 'END'
#include <Random123/philox.h>
#include <cblas.h>
#include <lapacke.h>
#include <sleef.h>
#include <suitesparse/cholmod.h>
#include <zlib.h>
int main(void) { return zlibVersion()[0] == '\0' || Sleef_cinz_expd1_u10purec(0) != 1; }
END
# shellcheck disable=SC2086 # a command and its options
$COMPILER -D_GNU_SOURCE -o probe probe.c -lsleef -lz -lm 2> log || skip "no libraries for aarch64: $(grep -m 1 -E 'error|cannot find' log)"
emulated ./probe 2> log || skip "$EMULATOR does not run what $HOST-gcc makes: $(head -n 1 log)"

program=$BUILDS/aarch64/rasp
env -u MAKEFLAGS -u MAKELEVEL make -s -C "$ROOT" -j"$JOBS" BUILD="$BUILDS/aarch64" CC="$COMPILER" "$program" > log 2>&1 || {
    fail "the build for aarch64 fails:"
    tail -n 20 log
    finish
}

[ "$(emulated "$program" --version)" = "$(rasp --version)" ] || fail "rasp --version: $(emulated "$program" --version 2>&1)"
emulated "$program" --version --verbose > version || fail "rasp --version --verbose fails"
expect_text version '^built for +aarch64$'

# rendered FOLDER COMMAND...: the scenes by that program. Sound as float64: coarser encodings round differences away.
rendered() {
    local folder=$1 scene
    shift
    mkdir "$folder"
    for scene in "${SAME[@]}" "$ROUNDED"; do
        "$@" render --quiet --set output.encoding=float64 -o "$folder/" "$ROOT/scenes/$scene.yaml" > log 2>&1 || {
            fail "$scene does not render in $folder:"
            cat log
        }
    done
}

SAME=(bounce forces_only)
ROUNDED=ceramic_stroke
rendered here rasp
rendered there emulated "$program"
files=0
for scene in "${SAME[@]}"; do
    for file in here/"$scene".wav here/"$scene".csv; do
        [ -e "$file" ] || continue
        files=$((files + 1))
        cmp "$file" "there/${file#here/}" || fail "other bytes: ${file#here/}"
    done
done
[ $files -ge ${#SAME[@]} ] || fail "only $files files of ${#SAME[@]} scenes"
rasp compare --snr $LEAST here/$ROUNDED.wav there/$ROUNDED.wav > compared || {
    fail "another sound: $ROUNDED"
    cat compared
}
[ "$FAILURES" != 0 ] || echo "same bytes: ${SAME[*]}; $ROUNDED: $(sed -n 's/^SNR *\(.*\)/\1/p; s/^equal.*/same bytes/p' compared)"
finish

#!/bin/bash
# The tests that run OpenBLAS's code, once more by other kernels than those that it takes on this CPU, with which `make
# check` ran them: what they expect must not depend on a CPU's linear algebra.
#     tests/blas.sh             one other kind: the plainest, or where that is this CPU's own the next but two
#     KERNELS="..." tests/blas.sh   those kinds (OPENBLAS_CORETYPE); all: all that this CPU can run
# Unit tests are those of solids and materials; `rasp modes compute` takes one kind everywhere (cli/modes-compute-kernels),
# and nothing else of rasp links it.
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
cd "$ROOT"
. tests/lib/kernels.sh

mapfile -t tests < <(grep -lE '"(fem/(solid|grade)|analysis/material_(fit|metric)|meshes\.h|solids\.h)' tests/unit/test_*.c | sed 's|.*/|unit/|; s|\.c$||')
[ ${#tests[@]} -gt 3 ] || { echo "tests/blas.sh: only ${#tests[@]} tests: have their headers other names?" >&2; exit 1; }
own=$(OPENBLAS_VERBOSE=2 "$BUILD/rasp-modes" --version 2>&1 | sed -n 's/^Core: //p')
read -r -a can <<< "$(kernels)"
case ${KERNELS:-} in
    '') [ "$own" != "${can[0]:-}" ] && KERNELS=${can[0]:-} || KERNELS=${can[3]:-${can[1]:-}} ;;
    all) KERNELS=${can[*]} ;;
esac
echo "${#tests[@]} tests by kernels for: ${KERNELS:-(this CPU has one kind)}; its own: ${own:-(unknown)}"
code=0
for kind in $KERNELS; do
    case " ${can[*]} " in
        *" $kind "*) ;;
        *) echo "left out: this CPU cannot run kernels for $kind"; continue ;;
    esac
    echo "-- $kind"
    OPENBLAS_CORETYPE=$kind tests/run.sh "${tests[@]}" || code=1
done
exit $code

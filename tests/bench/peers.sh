#!/bin/bash
# The same job by what one would use instead: peers.py says which. REPEATS (5).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/../..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
command -v python3 > /dev/null || { echo "python3 is not installed: skipped"; exit 0; }
export ROOT BUILD
python3 -B "$ROOT/tests/bench/peers.py"

#!/bin/bash
# Timings of whole renders: pipeline.py says which. REPEATS (5), LONG seconds (600) of the longest sound, ONLY (a part of the jobs' names).
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/../..")
BUILD=$(realpath -m "${BUILD:-$ROOT/build}")
command -v python3 > /dev/null || { echo "python3 is not installed: skipped"; exit 0; }
export ROOT BUILD
python3 -B "$ROOT/tests/bench/pipeline.py"

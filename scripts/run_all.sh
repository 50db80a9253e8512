#!/bin/bash
# Runs what a folder holds, in order of name, and says which failed:  scripts/run_all.sh evidence|tests/bench
# Scripts are run as they are; a C file of tests/bench stands for the program that make
# built from it (those of evidence/ are judges, which their scripts build).
set -uo pipefail
cd "$(dirname "$0")/.." || exit
folder=$1
BUILD=$(realpath "${BUILD:-build}")
ROOT=$PWD
PATH=$BUILD:$PATH
export BUILD ROOT PATH LC_ALL=C

shopt -s nullglob
entries=("$folder"/*.sh)
[ "$folder" = tests/bench ] && entries+=("$folder"/*.c)
if [ ${#entries[@]} = 0 ]; then
    echo "$folder/ holds nothing to run" >&2
    exit 1
fi
failed=0
for entry in "${entries[@]}"; do
    echo "== $entry"
    start=$EPOCHREALTIME
    case $entry in
        *.sh) bash "$entry" ;;
        *.c) "$BUILD/${folder##*/}/$(basename "$entry" .c)" ;;
    esac || { echo "FAILED $entry"; failed=$((failed + 1)); }
    awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "   %.1f s\n", b - a }'
done
[ $failed = 0 ]

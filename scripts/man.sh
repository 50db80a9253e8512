#!/bin/bash
# Makes man/rasp.1 and man/rasp-scene.5 from their .in files: the lines .\" COMMANDS, KEYS and COLUMNS give way to what rasp itself says.
#     scripts/man.sh [FOLDER]        rasp from $BUILD (default build), else from PATH; pages go to FOLDER (default man)
set -euo pipefail
ROOT=$(realpath "$(dirname "$0")/..")
FOLDER=${1:-$ROOT/man}
PATH=$(realpath -m "${BUILD:-$ROOT/build}"):$PATH
PART=$(mktemp)
trap 'rm -f "$PART"' EXIT

# part MARK COMMAND...: puts what the command prints in place of the mark in $PAGE.
part() {
    local mark=$1
    shift
    "$@" > "$PART"
    sed -i -e "/^\.\\\\\" $mark\$/{r $PART
d}" "$PAGE"
}

# start NAME: copies NAME.in, with a remark.
start() {
    PAGE=$FOLDER/$1
    sed "1i .\\\\\" Made by scripts/man.sh from $1.in; edit that." "$ROOT/man/$1.in" > "$PAGE"
}

start rasp.1
part COMMANDS rasp help --man
start rasp-scene.5
part KEYS rasp explain --man=keys
part COLUMNS rasp explain --man=columns

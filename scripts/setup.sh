#!/bin/bash
# Installs the Debian packages of the named sections of ./packages that are not there yet (default: build).
#     scripts/setup.sh [--missing] [build|demo|test|heavy ...]
# --missing only lists them. With nothing missing it says nothing and touches nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

only_list=false
if [ "${1:-}" = --missing ]; then
    only_list=true
    shift
fi
[ $# -gt 0 ] || set -- build

for section; do
    grep -qx "\[$section\]" packages || { echo "setup: no section [$section] in ./packages" >&2; exit 64; }
done

wanted=$(awk -v sections=" $* " '/^\[/ { on = index(sections, " " substr($0, 2, length($0) - 2) " ") > 0; next }
                                 on && NF && !/^#/ { print $1 }' packages | LC_ALL=C sort -u)
[ -n "$wanted" ] || exit 0

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "setup: this is not a Debian system (no dpkg and apt-get). Install what these Debian packages hold, then run make:" >&2
    echo $wanted >&2
    exit 69
fi

# shellcheck disable=SC2086 # one word per package
installed=" "$(dpkg-query -W -f '${db:Status-Status} ${Package} ' $wanted 2> /dev/null || true)
missing=
for package in $wanted; do
    case $installed in *" installed $package "*) ;; *) missing+=" $package" ;; esac
done
[ -n "$missing" ] || exit 0
if $only_list; then
    printf '%s\n' $missing
    exit 0
fi

as_root=()
if [ "$(id -u)" != 0 ]; then
    command -v sudo > /dev/null || { echo "setup: as root, run: apt-get install" $missing >&2; exit 69; }
    as_root=(sudo)
fi
echo "setup: installing" $missing
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" < /dev/null > "$log" 2>&1; }
# shellcheck disable=SC2086
if ! { apt update && apt install --no-install-recommends $missing; }; then
    tail -n 20 "$log" >&2
    echo "setup: apt-get failed; install by hand:" $missing >&2
    exit 69
fi

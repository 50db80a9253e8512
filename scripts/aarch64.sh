#!/bin/bash
# Makes FOLDER (build/aarch64) a root with the libraries for aarch64 that rasp needs, and installs the cross compiler and the emulator:
#     scripts/aarch64.sh [FOLDER] && SYSROOT=FOLDER tests/run.sh bytes/aarch64
# Of Debian's packages for aarch64 none is installed: they are unpacked.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(realpath -m "${1:-build/aarch64}")
scripts/setup.sh aarch64
wanted=$(awk '/^\[/ { on = $0 == "[build]"; next } on && /^(lib|zlib|nettle)/ { print $1 }' packages)
mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial"
apt() {
    apt-get -q -y -o APT::Architecture=arm64 -o APT::Architectures::=arm64 -o Dir::State="$folder/apt" -o Dir::State::status=/dev/null \
        -o Dir::Cache="$folder/apt/cache" -o Debug::NoLocking=1 "$@" < /dev/null > "$folder/apt/log" 2>&1 ||
        { tail -n 20 "$folder/apt/log" >&2; exit 69; }
}
apt update
# shellcheck disable=SC2086 # one word per package
apt install --download-only --no-install-recommends $wanted
for package in "$folder"/apt/cache/archives/*.deb; do
    dpkg-deb -x "$package" "$folder"
done
rm -rf "$folder/apt"

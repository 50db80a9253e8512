#!/bin/bash
# Packs rasp with the libraries that it loads, to be unpacked and run on any x86-64 Linux whose glibc is as new as this machine's, without installing anything.
#     scripts/bundle.sh ARCHIVE.tar.gz        rasp from $BUILD (default: build/ of this tree)
# It is no static binary: Debian has no archives of libsndfile, libebur128, libsoxr and libsleef. Left out are rasp-modes (finite elements: CHOLMOD and BLAS),
# gnuplot (rasp plot), and the programs that play sounds.
set -euo pipefail
cd "$(dirname "$0")/.."
BUILD=$(realpath -m "${BUILD:-build}")
archive=$(realpath -m "${1:?ARCHIVE.tar.gz}")
export LC_ALL=C
umask 022
name=$(basename "$archive" .tar.gz)
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
mkdir -p "$stage/$name/bin" "$stage/$name/lib" "$stage/$name/share/rasp" "$(dirname "$archive")"
# The program's own search path comes first, and libraries find each other by it, too (DT_RPATH, which is inherited).
make --no-print-directory -s BUILD="$BUILD" all
make --no-print-directory -s BUILD="$BUILD" RPATH='$$ORIGIN/../lib' PROGRAM="$stage/$name/bin/rasp" program
ldd "$BUILD/rasp" | awk '$3 ~ /^\// { print $3 }' | grep -Ev '/lib(c|m|pthread|dl|rt)\.so' | while read -r library; do
    cp -L "$library" "$stage/$name/lib/"
done
cp -R scenes surfaces irs scripts/rasp.py "$stage/$name/share/rasp/"
mkdir -p "$stage/$name/share/man/man1" "$stage/$name/share/man/man5" "$stage/$name/share/man/man7"
for page in man/*.[157]; do cp "$page" "$stage/$name/share/man/man${page##*.}/"; done
cp README.md LICENSE CHANGELOG.md CITATION.cff "$stage/$name/"
chmod -R u+rwX,go+rX,go-w "$stage/$name"
tar -c -C "$stage" --sort=name --format=ustar --owner=0 --group=0 --numeric-owner --mtime="@${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2> /dev/null || echo 0)}" "$name" |
    gzip -n -9 > "$archive"

#!/bin/bash
# Packs the source tree: the files that git does not ignore, as they are here, and REVISION, which says what they were made from.
#     scripts/dist.sh ARCHIVE.tar.gz
# The same files of the same revision make the same bytes: order, owners, modes and times do not depend on the machine. All times are the revision's
# (or $SOURCE_DATE_EPOCH). An unpacked archive can be packed again.
set -euo pipefail
cd "$(dirname "$0")/.."
archive=$(realpath -m "${1:?ARCHIVE.tar.gz}")
export LC_ALL=C
umask 022
name=$(basename "$archive" .tar.gz)
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
mkdir -p "$stage/$name" "$(dirname "$archive")"

if [ -f REVISION ]; then
    { read -r revision && read -r date; } < REVISION
    find . -type f ! -path './build*' ! -path './out/*' ! -path './debian/rasp/*' ! -path './debian/.debhelper/*' ! -path './debian/*debhelper*' \
        ! -path './debian/*.substvars' ! -path ./debian/files -printf '%P\0' > "$stage/files"
else
    revision=$(git describe --always --dirty --abbrev=12)
    date=$(git log -1 --format=%ct)
    git ls-files -z -co --exclude-standard > "$stage/files"
fi
date=${SOURCE_DATE_EPOCH:-$date}
sort -z "$stage/files" | while IFS= read -r -d '' file; do [ ! -f "$file" ] || printf '%s\0' "$file"; done |
    tar -c --null --no-recursion --files-from=- | tar -x -C "$stage/$name"
printf '%s\n' "$revision" "$date" > "$stage/$name/REVISION"
chmod -R u+rwX,go+rX,go-w "$stage/$name"
tar -c -C "$stage" --sort=name --format=ustar --owner=0 --group=0 --numeric-owner --mtime="@$date" "$name" | gzip -n -9 > "$archive"
echo "$archive"

#!/bin/bash
# Builds the Debian source package from the source archive, the package from that, and tries it.
#     scripts/deb.sh [FOLDER [--install]]      default: build/deb, where the .dsc with its archive, the .deb and the build's log are left
# Both are checked by lintian (an error ends this); the package is unpacked, and run from there. --install, as root: it is installed, a scene that it brings is rendered, and it
# is purged, which leaves nothing. Its tools are those of `scripts/setup.sh build package`. A few minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(realpath -m "${1:-build/deb}")
version=$(dpkg-parsechangelog -S Version)
rm -rf "$folder"
mkdir -p "$folder"
scripts/dist.sh "$folder/rasp-$version.tar.gz" > /dev/null
tar -xzf "$folder/rasp-$version.tar.gz" -C "$folder"
(cd "$folder/rasp-$version" && dpkg-buildpackage -us -uc -S -d) > "$folder/log" 2>&1 || { tail -n 30 "$folder/log"; exit 1; }
lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs "$folder"/rasp_*_source.changes
rm -rf "$folder/rasp-$version"
dpkg-source --no-check -x "$folder/rasp_$version.dsc" "$folder/rasp-$version" >> "$folder/log" 2>&1 || { tail -n 30 "$folder/log"; exit 1; }
(cd "$folder/rasp-$version" && DEB_BUILD_OPTIONS="parallel=$(getconf _NPROCESSORS_ONLN)" dpkg-buildpackage -us -uc -b) >> "$folder/log" 2>&1 || { tail -n 30 "$folder/log"; exit 1; }
deb=$folder/rasp_${version}_amd64.deb
lintian --fail-on error --suppress-tags initial-upload-closes-no-bugs "$folder"/rasp_*_amd64.changes

# try COMMAND ROOT: what is under ROOT/usr runs with its scenes.
try() {
    local out
    out=$(mktemp -d)
    "$1" --version --verbose > "$out/version"
    "$1" check "$2"/usr/share/rasp/scenes/*.yaml > "$out/checked"
    "$1" render "$2/usr/share/rasp/scenes/basswood_scrape.yaml" --set 'motion.duration=0.5 s' -o "$out/sound.wav" > "$out/rendered"
    "$1" modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material steel --order 2 --modes 3 --quiet --at 1cm,1cm -o "$out/bar.csv" > "$out/computed"
    ls -l "$out"/sound.wav "$out"/bar.csv | awk '{ sub(".*/", "", $NF); print "made: " $NF ", " $5 " bytes" }'
    rm -rf "$out"
}
dpkg -x "$deb" "$folder/root"
try "$folder/root/usr/bin/rasp" "$folder/root"
rm -rf "$folder/root" "$folder/rasp-$version"
if [ "${2:-}" = --install ]; then
    apt-get -q -y install "$deb" > "$folder/installed" 2>&1 || { tail "$folder/installed"; exit 1; }
    try rasp ""
    dpkg -L rasp | while IFS= read -r path; do [ -d "$path" ] || echo "$path"; done > "$folder/files"
    apt-get -q -y purge rasp > "$folder/purged" 2>&1
    while IFS= read -r path; do [ ! -e "$path" ] || { echo "left by purge: $path"; exit 1; }; done < "$folder/files"
    echo "installed, tried, purged: $(grep -c . "$folder/files") files"
fi
ls -l "$deb" | awk '{ sub(".*/", "", $NF); print $NF ", " $5 " bytes" }'

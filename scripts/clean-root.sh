#!/bin/bash
# Proves that `packages` and the set-up are complete: makes a minimal Debian 12 in a folder, puts a copy of the tree in it, and runs
# make targets there, as a user with a fresh machine would.  As root:
#     scripts/clean-root.sh [FOLDER [TARGET...]]      default: /var/tmp/rasp-clean-root demo check
# Package sources and proxies are those of this machine's apt. The folder is kept (its packages are reused) unless KEEP=0.
set -euo pipefail
cd "$(dirname "$0")/.."
root=${1:-/var/tmp/rasp-clean-root}
shift $(($# > 0))
[ $# -gt 0 ] || set -- demo check
[ "$(id -u)" = 0 ] || { echo "clean-root: must be root (chroot)" >&2; exit 64; }
command -v debootstrap > /dev/null || { echo "clean-root: needs the package debootstrap" >&2; exit 69; }

# This machine's Debian sources, as lines "deb URI RELEASE COMPONENT".
sources=$(apt-get indextargets --format '$(ORIGIN) deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    sed -n 's/^Debian //p' | grep ' bookworm' | sort -u)
mirror=$(awk '$3 == "bookworm" { print $2; exit }' <<< "$sources")
[ -n "$mirror" ] || { echo "clean-root: this machine's apt knows no Debian 12 (bookworm)" >&2; exit 69; }

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "$@" < /dev/null; }
leave() {
    umount -l "$root/proc" "$root/dev/shm" "$root/dev" 2> /dev/null || true
    [ "${KEEP:-1}" = 1 ] || rm -rf --one-file-system "$root"
}

if [ ! -e "$root/.made" ]; then
    debootstrap --variant=minbase bookworm "$root" "$mirror" > "$root.log" 2>&1 || { tail "$root.log" >&2; exit 69; }
    echo "$sources" > "$root/etc/apt/sources.list"
    apt-config dump --no-empty --format '%f "%v";%n' Acquire::http::Proxy Acquire::https::Proxy > "$root/etc/apt/apt.conf.d/90proxy"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    inside apt-get -q -y update > "$root.log" 2>&1
    inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends make git ca-certificates >> "$root.log" 2>&1
    [ ! -f /etc/ssl/certs/ca-certificates.crt ] || cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    touch "$root/.made"
fi

trap leave EXIT
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/dev/shm"
rm -rf "$root/src/rasp"
mkdir -p "$root/src/rasp"
{ git ls-files -z -co --exclude-standard 2> /dev/null || find . -type f ! -path './build*' -print0; } |
    tar -c --null --files-from=- | tar -x -C "$root/src/rasp"
inside git -C /src/rasp init -q
inside git -C /src/rasp add -A
inside git -C /src/rasp -c user.name=clean -c user.email=clean commit -q -m "clean root"
echo "clean-root: $(inside dpkg-query -W | wc -l) packages in $root before set-up"
for target; do
    start=$SECONDS
    inside make -C /src/rasp "$target"
    echo "clean-root: make $target took $((SECONDS - start)) s"
done

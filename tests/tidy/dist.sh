# The source archive (make dist) has the same bytes twice, whatever the files' times and modes are, holds the tree, and can be packed again from itself.
. "$ROOT/tests/lib/test.sh"
command -v git > /dev/null || skip "git is not installed"

# A small tree of its own, as packing the whole takes seconds.
mkdir tree
cp -r "$ROOT/scripts" "$ROOT/Makefile" "$ROOT/man" tree/
mkdir -p tree/src/cmd tree/debian/rasp tree/debian/source
cp "$ROOT/src/cmd/version.c" tree/src/cmd/
echo '3.0 (native)' > tree/debian/source/format
echo built > tree/debian/rasp/built
printf 'debian/rasp/\nbuild*/\n' > tree/.gitignore
git -C tree init -q
git -C tree add -A
GIT_COMMITTER_DATE='@1700000000 +0000' git -C tree -c user.name=test -c user.email=test commit -q --date '@1700000000 +0000' -m tree
pack() { env -u MAKEFLAGS -u MAKELEVEL make -s -C "$1" dist BUILD="$2" > log 2>&1 || fail "make dist: $(cat log)"; }

pack tree "$PWD/first"
find tree -name .git -prune -o -type f -exec touch -d 2001-01-01 {} +
chmod -R g+w,o-r tree/man
(umask 077 && pack tree "$PWD/second")
archive=$(cd first && echo rasp-*.tar.gz)
version=$(sed -n 's/^#define VERSION "\(.*\)"/\1/p' "$ROOT/src/cmd/version.c")
[ "$archive" = "rasp-$version.tar.gz" ] || fail "the archive is called $archive"
cmp first/*.tar.gz second/*.tar.gz || fail "packed twice, other bytes"

tar -xzf "first/$archive" || fail "cannot be unpacked"
top=${archive%.tar.gz}
[ "$(cat "$top/REVISION")" = "$(git -C tree describe --always --abbrev=12)"$'\n'1700000000 ] || fail "REVISION: $(cat "$top/REVISION")"
diff -r -x .git -x REVISION -x rasp tree "$top" > log || fail "not the tree: $(cat log)"
[ ! -e "$top/debian/rasp" ] || fail "what was built is packed"
mkdir -p "$top/build" "$top/debian/rasp"
touch "$top/build/x" "$top/debian/rasp/x"
pack "$top" "$PWD/third"
cmp first/*.tar.gz third/*.tar.gz || fail "packed again from itself, other bytes"
finish

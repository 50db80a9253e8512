# `make install` puts what is needed under DESTDIR and PREFIX, it runs from there, and `make uninstall` leaves nothing.
. "$ROOT/tests/lib/test.sh"
place() { env -u MAKEFLAGS -u MAKELEVEL make -s -C "$ROOT" -o all BUILD="$BUILD" DESTDIR="$PWD/root" PREFIX=/usr "$@" > log 2>&1 || fail "make $*: $(cat log)"; }

place install
for file in bin/rasp share/man/man1/rasp.1 share/man/man5/rasp-scene.5 share/doc/rasp/LICENSE; do
    [ -f root/usr/$file ] || fail "not installed: $file"
done
root/usr/bin/rasp --version > version || fail "the installed program does not run"
for scene in root/usr/share/rasp/scenes/*.yaml; do
    root/usr/bin/rasp check "$scene" > log 2>&1 || fail "installed scene: $(cat log)"
done
place uninstall
left=$(find root -type f)
[ -z "$left" ] || fail "make uninstall leaves: $left"
finish

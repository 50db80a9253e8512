# `make install` puts what is needed under DESTDIR and PREFIX, it runs from there, and `make uninstall` leaves nothing, but what was there before.
. "$ROOT/tests/lib/test.sh"
place() { env -u MAKEFLAGS -u MAKELEVEL make -s -C "$ROOT" -o all BUILD="$BUILD" DESTDIR="$PWD/root" PREFIX=/usr "$@" > log 2>&1 || fail "make $*: $(cat log)"; }

mkdir -p root/usr/share/zsh/site-functions
echo other > root/usr/share/zsh/site-functions/_other
place install
for file in bin/rasp libexec/rasp/rasp-modes share/doc/rasp/LICENSE share/doc/rasp/README.md share/rasp/scene.schema.json share/rasp/design.schema.json share/rasp/rasp.py \
    share/bash-completion/completions/rasp share/zsh/site-functions/_rasp share/fish/vendor_completions.d/rasp.fish; do
    [ -s root/usr/$file ] || fail "not installed: $file"
done
for page in "$ROOT"/man/*.[157]; do
    [ -f "root/usr/share/man/man${page##*.}/${page##*/}" ] || fail "not installed: ${page##*/}"
done
for folder in scenes surfaces irs; do
    diff -r "$ROOT/$folder" "root/usr/share/rasp/$folder" > log || fail "installed $folder: $(head -n 3 log)"
done
wrong=$(find root \( -type f ! -perm -444 -o -type d ! -perm -555 \) -o -perm /022)
[ -z "$wrong" ] || fail "modes: $wrong"

cp -R root 'a root'
rm -r 'a root/usr/bin' 'a root/usr/share/rasp'
place DESTDIR="$PWD/a root" install
diff -r root 'a root' > log || fail "a folder's name with a space: $(head -n 3 log)"

installed=$PWD/root/usr/bin/rasp
"$installed" --version > version || fail "the installed program does not run"
for scene in root/usr/share/rasp/scenes/*.yaml; do
    "$installed" check "$scene" > log 2>&1 || fail "installed scene: $(cat log)"
done
"$installed" render root/usr/share/rasp/scenes/strike.yaml -o sound.wav > log 2>&1 || fail "installed scene: $(cat log)"
PATH=/usr/bin:/bin "$installed" modes compute --shape bar:length=20cm,width=2cm,thickness=5mm --material steel --order 2 --modes 3 --at 1cm,1cm -o bar.csv > log 2>&1 ||
    fail "rasp-modes is not found: $(cat log)"
(. root/usr/share/bash-completion/completions/rasp && COMP_WORDS=(rasp ren) COMP_CWORD=1 && { _rasp || true; } && [ "${COMPREPLY[*]}" = render ]) ||
    fail "the installed completion does not complete"
diff <("$installed" explain --schema=scene) root/usr/share/rasp/scene.schema.json > log || fail "the installed schema is another"

place DESTDIR="$PWD/a root" uninstall
left=$(find 'a root' -type f)
[ "$left" = 'a root/usr/share/zsh/site-functions/_other' ] || fail "make uninstall leaves: $left"
place uninstall
left=$(find root -mindepth 2 ! -type d)
[ "$left" = root/usr/share/zsh/site-functions/_other ] || fail "make uninstall leaves: $left"
rm -r root/usr/share/zsh
left=$(find root -mindepth 2 | sort | tr '\n' ' ')
[ "$left" = "root/usr/share " ] || fail "make uninstall leaves: $left"
finish

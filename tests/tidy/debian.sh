# debian/ says what the rest of the tree says: what a build needs (packages), the version, and an address where nobody is. `make deb` builds the package.
. "$ROOT/tests/lib/test.sh"

# needs CONTROL: its build dependencies, but those that every package build has.
needs() { sed -n '/^Build-Depends:/,/^[A-Z]/{ /^ /p }' "$1" | sed 's/^ *//; s/,$//; /^debhelper-compat/d' | sort; }
listed() { sed -n '/^\[build\]/,/^\[/{ /^[a-z]/p }' "$ROOT/packages" | grep -vxE 'gcc|libc6-dev|make' | sort; }

[ -n "$(listed)" ] || fail "no packages are listed"
diff <(listed) <(needs "$ROOT/debian/control") || fail "debian/control and packages name other build dependencies"
sed 's/^ libpng-dev,$/ libpng-dev (>= 1),\n other-dev,/' "$ROOT/debian/control" > planted
[ "$(diff <(listed) <(needs planted) | grep -c '^[<>]')" = 3 ] || fail "debian: a planted dependency was not caught"

version=$(sed -n 's/^#define VERSION "\(.*\)"/\1/p' "$ROOT/src/base/version.h")
[ "$(sed -n '1s/^rasp (\([^)]*\)).*/\1/p' "$ROOT/debian/changelog")" = "$version" ] || fail "debian/changelog is not of version $version"
grep -qx "Maintainer: rasp developers <rasp@[e]xample[.]invalid>" "$ROOT/debian/control" || fail "the maintainer is another"
[ -x "$ROOT/debian/rules" ] || fail "debian/rules is not executable"
finish

# The profiles of surfaces/ are what scripts/surfaces.sh writes, byte for byte; every recipe has one, and says where its figures come from.
. "$ROOT/tests/lib/test.sh"
sh "$ROOT/scripts/surfaces.sh" made > log 2>&1 || fail "scripts/surfaces.sh fails: $(cat log)"
for file in made/*.gsf "$ROOT"/surfaces/*.gsf; do
    name=${file##*/}
    cmp "made/$name" "$ROOT/surfaces/$name" || fail "surfaces/$name is out of date: run scripts/surfaces.sh"
done
for recipe in "$ROOT"/surfaces/*.yaml; do
    name=${recipe##*/}
    [ -f "made/${name%.yaml}.gsf" ] || fail "surfaces/$name has no profile in scripts/surfaces.sh"
    grep -q '^source: ' "$recipe" && grep -q '^title: ' "$recipe" || fail "surfaces/$name has no title or no source"
done
[ "$(du -bc "$ROOT"/surfaces/* | tail -n 1 | cut -f 1)" -lt 1000000 ] || fail "surfaces/ holds more than 1 MB"
finish

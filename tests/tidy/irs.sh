# irs/ is what scripts/irs.sh writes, byte for byte.
. "$ROOT/tests/lib/test.sh"
sh "$ROOT/scripts/irs.sh" made > log 2>&1 || fail "scripts/irs.sh fails: $(cat log)"
for file in made/* "$ROOT"/irs/*; do
    name=${file##*/}
    [ "$name" = README.md ] || cmp "made/$name" "$ROOT/irs/$name" || fail "irs/$name is out of date: run scripts/irs.sh"
done
finish

# irs/ is what scripts/irs.sh writes, byte for byte; every recipe in it has its table, and every table can be read.
. "$ROOT/tests/lib/test.sh"
sh "$ROOT/scripts/irs.sh" made > log 2>&1 || fail "scripts/irs.sh fails: $(cat log)"
for file in made/* "$ROOT"/irs/*; do
    name=${file##*/}
    case $name in
        README.md) ;;
        *.yaml) [ -f "made/${name%.yaml}.csv" ] || fail "scripts/irs.sh makes no table of irs/$name" ;;
        *) cmp "made/$name" "$ROOT/irs/$name" || fail "irs/$name is out of date: run make irs" ;;
    esac
done
for file in "$ROOT"/irs/*.csv; do
    rasp modes list "$file" > listed 2>&1 || fail "${file##*/}: $(cat listed)"
done
finish

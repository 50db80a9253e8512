# irs/ is what scripts/irs.sh writes, byte for byte; every recipe in it has its table, and every table can be read. A solid's table is left alone where it is current (its
# inputs and its content are what they were); that of the ring is computed again, and agrees to 1e-7: another CPU's linear algebra rounds otherwise.
# Long: see tests/run.sh.
. "$ROOT/tests/lib/test.sh"

# near A B: the same but for the hash of the content, and for numbers that differ by 1e-7, of gains of the greatest of their column.
near() {
    grep -v '^# content: ' "$1" | tr ',' ' ' > one
    grep -v '^# content: ' "$2" | tr ',' ' ' > other
    paste -d '\n' one other | awk '
        NR % 2 { split($0, x); n = NF; line = $0; next }
        /^#/ || /^place/ || line ~ /^#/ { if ($0 != line) { print line; print; exit bad = 1 } next }
        { rows++
          if (NF != n) exit bad = 1
          for (i = 1; i <= n; i++) {
              d = x[i] - $i; d = d < 0 ? -d : d
              if (i <= 6 && d > 1e-7 * $i) { print "column " i ": " $i " is not " x[i]; exit bad = 1 }
              most[i] = d > most[i] ? d : most[i]
              size[i] = $i > size[i] ? $i : -$i > size[i] ? -$i : size[i] } }
        END { for (i = 1; i <= n; i++) if (most[i] > 1e-7 * size[i]) { print "column " i ": differs by " most[i] " of " size[i]; bad = 1 }
              exit bad || rows < 10 }'
}
mkdir made
grep -l "^# inputs: " "$ROOT"/irs/*.csv | grep -v /steel_ring.csv | while read -r file; do cp -p "$file" made/; done
sh "$ROOT/scripts/irs.sh" made > log 2>&1 || fail "scripts/irs.sh fails: $(cat log)"
for file in made/* "$ROOT"/irs/*; do
    name=${file##*/}
    case $name in
        README.md) ;;
        fitted) ;; # of scripts/section_e.sh: tidy/section_e
        *.yaml) [ -f "made/${name%.yaml}.csv" ] || fail "scripts/irs.sh makes no table of irs/$name" ;;
        steel_ring.csv) near "made/$name" "$ROOT/irs/$name" || fail "irs/$name is out of date: run make irs" ;;
        *_residual) diff -r "made/$name" "$ROOT/irs/$name" || fail "irs/$name is out of date: run make irs" ;;
        *) cmp "made/$name" "$ROOT/irs/$name" || fail "irs/$name is out of date: run make irs" ;;
    esac
done
for file in "$ROOT"/irs/*.csv; do
    rasp modes list "$file" > listed 2>&1 || fail "${file##*/}: $(cat listed)"
done
finish

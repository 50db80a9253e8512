# irs/fitted/ is what scripts/section_e.sh makes: of one object all of it again, from the truth to what was carried over, to 1e-4 (residuals to -60 dB), as
# another CPU's linear algebra rounds otherwise; its scenes name nothing that is not there.
# Long: see tests/run.sh.
. "$ROOT/tests/lib/test.sh"
command -v python3 > /dev/null || skip "no python3"
bash "$ROOT/scripts/section_e.sh" made plastic_plate > log 2>&1 || fail "scripts/section_e.sh fails: $(cat log)"
# numbers FILE: those of a material, or the frequencies and decays of a table
numbers() { sed 's/ *#.*//' "$1" | awk -F '[,: ]+' '/^[0-9]/ { print $5, $6 } /^ / && $3 ~ /^[0-9]/ { print $2, $3 }'; }
for name in plastic_plate.yaml plastic_plate_small.csv plastic_plate_large.csv; do
    numbers "made/$name" | paste -d ' ' - <(numbers "$ROOT/irs/fitted/$name") | awk '
        { if (NF != 4) bad = 1
          for (i = 1; i <= 2; i++) { d = $i - $(i + 2); if ((d < 0 ? -d : d) > 1e-4 * $(i + 2) || $(i + 2) !~ /[0-9]/ && $i != $(i + 2)) bad = 1 } }
        END { exit bad || NR < 4 }' || fail "irs/fitted/$name is out of date: run scripts/section_e.sh"
done
for name in residual strike; do
    rasp compare --snr 60 "$ROOT/irs/fitted/plastic_plate_residual/$name.wav" "made/plastic_plate_residual/$name.wav" > compared ||
        fail "irs/fitted/plastic_plate_residual/$name.wav is out of date: run scripts/section_e.sh; $(cat compared)"
done
[ "$(du -sb "$ROOT/irs/fitted" | cut -f 1)" -lt 450000 ] || fail "irs/fitted/ holds more than 450 kB"
finish

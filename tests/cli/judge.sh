# Choices, similarity, ratings and pairs, and the papers' numbers beside them.
. "$ROOT/tests/cli/judge-make.inc"
answers > answers.csv && ratings > ratings.csv && pairs > pairs.csv
paper=(--paper "$ROOT/evidence/papers.csv" --item)
try rasp judge choices answers.csv --reference recorded -o matrices.csv
cat matrices.csv
try rasp judge choices answers.csv --classes glass,metal,wood --groups metal+glass --simultaneous
try rasp judge similarity matrices.csv --reference synthesised
try rasp judge similarity matrices.csv matrices.csv --reference recorded
rasp judge choices matrices.csv --json --reference recorded --confidence 0.9 | sed -E 's/([0-9]\.[0-9]{9})[0-9]+/\1/' # libm's last digits differ
# one answer of each, all right: whole numbers are answers
printf 'played,a,b\na,1,0\nb,0,1\n' > few.csv && try rasp judge choices few.csv
try rasp judge ratings ratings.csv --tukey mu:kappa --tukey resonator:kappa:mu "${paper[@]}" 002_III > /dev/null
grep -v '^  resonator=.* - resonator' printed
try rasp judge ratings ratings.csv --factors kappa -c rating=rating
try rasp judge pairs pairs.csv "${paper[@]}" 002_VI
# as pages of rasp export give them: trials for training come again, and each session has sounds of its own
awk -F, -v OFS=, 'NR == 1 { print $0, "trial_id,training"; next } $2 == "size" { $4 = "x" $4; $5 = "x" $5 } NR % 10 == 0 { print $0, NR, 1 } { print $0, NR, 0 }' pairs.csv > page.csv
try rasp judge pairs page.csv > /dev/null
grep -v ' - ' printed
try rasp judge choices "$ROOT/scenes/answers/003_study.csv" "${paper[@]}" 003_F > /dev/null
# every share that 003 prints, to its digits
awk '/paper / { n++; d = $3 - $5; if (d * d > 0.0501 ^ 2) print } END { print n " shares" }' printed
# shares and percent are the same matrix as the answers they are of
awk -F, -v OFS=, '/^#|^condition/ { print; next } { s = $3 + $4 + $5; for (i = 3; i <= 5; i++) $i = sprintf("%.12f", 100 * $i / s); print }' matrices.csv | sed 's/answers/percent/' > percent.csv
try rasp judge similarity percent.csv matrices.csv --reference recorded
rasp judge choices percent.csv -o shares.csv > /dev/null && try rasp judge similarity shares.csv matrices.csv --reference recorded

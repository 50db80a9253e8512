# Tables that are no use: what is wrong, where, and what to do; nothing is printed before.
. "$ROOT/tests/cli/judge-make.inc"
answers > answers.csv && ratings > ratings.csv && pairs > pairs.csv
broken() { # FILE SED: the table with a fault
    sed "$2" "$1" > broken.csv
}
for fault in 's/^s3,recorded,wood,.*/s3,recorded,wood,wodo/' '5s/,[a-z]*$/,/' '/recorded,glass/d' '/^s7,recorded/d' 's/chosen/answer/' '2,$d' '2,$s/^s[0-9]*/s1/'; do
    broken answers.csv "$fault"
    try rasp judge choices broken.csv --reference recorded -o never.csv
done
try rasp judge choices answers.csv --reference record
try rasp judge choices answers.csv --groups wood+gold
try rasp judge choices answers.csv --groups wood+metal,metal+glass
try rasp judge choices answers.csv --classes wood,metal
try rasp judge choices answers.csv --bound 0
try rasp judge choices answers.csv --item 003_F
try rasp judge choices answers.csv --paper "$ROOT/evidence/papers.csv" --item 003
try rasp judge similarity answers.csv
try rasp judge choices answers.csv -o answers.csv --force
printf 'played,a,b\na,0.5,0.4\nb,0,1\n' > sums.csv
try rasp judge choices sums.csv
printf 'played,a,b\na,1,-1\nb,0,1\n' > sums.csv
try rasp judge choices sums.csv
printf 'played,a,b\na,3,1\na,0,1\n' > sums.csv
try rasp judge choices sums.csv
printf 'played,a,b\na,3,1\n' > sums.csv
try rasp judge choices sums.csv
printf 'played,b,a\nb,3,1\na,1,2\n' > other.csv && printf 'played,a,b\na,3,1\nb,1,2\n' > sums.csv
try rasp judge similarity sums.csv other.csv
for fault in '100d' '100{p}' '100s/[0-9.]*$/loud/' 's/^s[0-9]*/s1/' 's/,participant/,x/;1s/participant/who/'; do
    broken ratings.csv "$fault"
    try rasp judge ratings broken.csv
done
try rasp judge ratings ratings.csv --factors kappa,sigma
try rasp judge ratings ratings.csv --factors kappa,kappa
try rasp judge ratings ratings.csv --tukey kappa:kappa
broken ratings.csv '2,$s/,raw,/,convolved,/'
try rasp judge ratings broken.csv
for fault in '7d' '7{p}' '7s/,[^,]*$/,A>C/' '7s/,[^,]*\(,[^,]*\)\(,[^,]*\)$/\1\1\2/'; do
    broken pairs.csv "$fault"
    try rasp judge pairs broken.csv
done
{ echo participant,track,rating && awk 'BEGIN { for (i = 0; i < 404; i++) print i % 4 "," int(i / 4) "," i * i % 7 }'; } > broken.csv
try rasp judge ratings broken.csv --tukey track
try rasp judge ratings ratings.csv --column raitng=rating
try rasp judge choices answers.csv --column chosen
try rasp judge listen . --templates . --column answer=chosen
try rasp judge listen .
try rasp judge listen answers.csv --templates answers.csv
try rasp judge
try rasp judge choose answers.csv
ls

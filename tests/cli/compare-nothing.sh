# A reference that is missing or empty never passes, and neither does the other file.
. "$ROOT/tests/cli/compare-make.inc"
wav 8000 1 > none.wav
wav 8000 1 1 2 3 > a.wav
printf 't,v\n' > rows.csv
printf 't,v\n0,1\n' > a.csv
: > empty.csv
: > empty.wav
head -c 47 a.wav > cut.wav
for pair in 'gone.wav a.wav' 'a.wav gone.wav' 'gone.csv gone.csv' 'none.wav none.wav' 'empty.wav empty.wav' 'cut.wav a.wav' \
            'rows.csv rows.csv' 'empty.csv empty.csv' 'a.csv empty.csv' 'a.csv rows.csv' '. .'; do
    # shellcheck disable=SC2086
    rasp compare -q $pair > /dev/null || echo "$pair: exit $?"
done

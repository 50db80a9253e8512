# The plots: which there are, by which names, and that they are whole pictures.
command -v gnuplot > /dev/null || { echo "no gnuplot"; exit 77; }
. "$ROOT/tests/cli/analyse-make.inc"
impacts 600 0.8e-3 0.25 > impacts.csv
force 44100 < impacts.csv > force.csv
mkdir plots
rasp analyse force.csv --plot plots/ --single force.csv | grep -A 9 '^written'
rasp analyse impacts.csv --plot plots --format svg | grep -A 9 '^written'
rasp analyse impacts.csv --plot plots/other | grep -A 9 '^written'
for file in plots/*; do
    case $file in *.svg) tail -c 20 "$file" | grep -q '</svg>' ;; *) tail -c 8 "$file" | grep -aq IEND ;; esac || echo "$file is not whole"
done
echo "-- what fails leaves nothing, and the report is printed"
rasp analyse impacts.csv -o part.yaml --plot nowhere/plots > out 2> err || echo "exit code $?"
head -1 out && cat err
mkdir bare && ln -s "$(command -v rasp)" bare/rasp
env PATH="$PWD/bare" rasp analyse impacts.csv -o part.yaml --plot plots/bare > out 2> err || echo "exit code $?"
head -1 out && cat err
mkdir plots/taken.shape.png
rasp analyse force.csv -o part.yaml --plot plots/taken > out 2> err || echo "exit code $?"
head -1 out && cat err
ls . plots

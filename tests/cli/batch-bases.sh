# A design is known by its scenes, too, and by what they read: the same text over another scene is another design, and of another state of a scene a stimulus is missing.
. "$ROOT/tests/cli/batch-make.inc"
code() { "$@" 2> err.txt > out.txt || echo "exit $?"; sed "s/, in [0-9:]*.*//; s/;.*//" out.txt; cat err.txt; }
mkdir a b c
cp six.yaml tiny.yaml modes.csv low.csv a
cp six.yaml modes.csv low.csv b
sed 's/rms: 5 um/rms: 7 um/' tiny.yaml > b/tiny.yaml
cp six.yaml modes.csv low.csv c
{ echo '# a remark'; cat tiny.yaml; } > c/tiny.yaml
rasp batch a/six.yaml -o out -q
cp -r out before
echo "-- another scene of the same name"
code rasp batch b/six.yaml -o out
code rasp batch b/six.yaml -o out --dry-run
diff -r before out && echo "nothing was written"
echo "-- the same scene with a remark more, elsewhere"
code rasp batch c/six.yaml -o out
echo "-- the scene edited: the design's folder is still its own"
code rasp batch a/six.yaml -o out
sed -i 's/rms: 5 um/rms: 6 um/' a/tiny.yaml
code rasp batch a/six.yaml -o out
echo "-- shards, the scene edited between them; a remark, a table"
part() { rasp batch a/six.yaml -o parts -q --shard "$1"; }
missing() { echo "missing: $(rasp batch a/six.yaml -o parts --missing 2)"; }
part 1/2
missing
sed -i 's/rms: 6 um/rms: 4 um/' a/tiny.yaml
missing
part 2/2
missing
code rasp batch a/six.yaml -o parts --no-render
part 1/2
missing
code rasp batch a/six.yaml -o parts --no-render
echo '# another remark' >> a/tiny.yaml
missing
echo '# a remark' | cat - modes.csv > a/modes.csv
missing
part 2/2
missing
code rasp batch a/six.yaml -o parts
missing

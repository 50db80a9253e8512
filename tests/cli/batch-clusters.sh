# Seven parts by GNU parallel and by Snakemake, as the manual has them: the set is that of one run.
. "$ROOT/tests/cli/batch-make.inc"
for program in parallel snakemake; do
    command -v $program > /dev/null || { echo "no $program"; exit 77; }
done
sed 's/^seed/replicates: 3\nseed/' six.yaml > many.yaml
rasp batch many.yaml -o ref -q
export HOME=$PWD
parallel -j 2 rasp batch many.yaml -o out -q -j 1 --shard {}/7 ::: {1..7} < /dev/null
rasp batch many.yaml -o out -q
same ref out && echo "parallel: the same"
snakemake -q -s "$ROOT/scenes/designs/Snakefile" --cores 2 --config design=many.yaml folder=snake > log 2>&1 || cat log
same ref snake && echo "snakemake: the same"
rm snake/low_200ms_r1.wav snake/SHA256SUMS # what is missing is made again by the last rule
snakemake -q -s "$ROOT/scenes/designs/Snakefile" --cores 2 --config design=many.yaml folder=snake > log 2>&1 || cat log
same ref snake && echo "again: the same"

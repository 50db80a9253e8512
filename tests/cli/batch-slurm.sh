# Seven parts by Slurm (scenes/designs/array.sbatch): one is killed and submitted again by itself, one is stopped and puts itself into the queue again; the set is
# that of one run.
# Long: see tests/run.sh.
. "$ROOT/tests/cli/batch-make.inc"
. "$ROOT/tests/lib/test.sh"
. "$ROOT/tests/lib/slurm.sh"
set -e
sed 's/^seed/replicates: 4\nset: {motion.duration: 4 s, accuracy: reference}\nseed/; s/motion.duration: \[.*/scraper.mass: [10 g, 20 g]/' six.yaml > many.yaml
rasp batch many.yaml -o ref -q
trap slurm_stop EXIT
slurm_start
# names_of I: the records of the part.
names_of() {
    rasp batch many.yaml -n --json --shard "$1/7" | python3 -c 'import json, sys; print(*("out/" + x["name"] + ".json" for x in json.load(sys.stdin)["list"]), sep="\n")'
}
# some FILE...: is one of them there?
some() {
    local file
    for file; do [ ! -e "$file" ] || return 0; done
    return 1
}
# states JOB: of its tasks.
states() { squeue -h -r -j "$1" -o %T 2> /dev/null | sort | uniq -c | tr -s '\n ' ' '; }
wait_for() { for _ in {1..1200}; do [ -n "$(states "$1")" ] || return 0; sleep 0.1; done; states "$1"; }
# The program is killed in part 4, once, after its first record.
mkdir bin
cat > bin/rasp << 'EOF'
#!/bin/bash
case "$*" in *"--shard 4/7"*)
    if mkdir killed 2> /dev/null; then
        "$BUILD/rasp" "$@" &
        until grep -qs '"status": "waits"' $(cat names.4); do sleep 0.02; done
        kill -KILL $!
        exit 137
    fi
    ;;
esac
exec "$BUILD/rasp" "$@"
EOF
chmod +x bin/rasp
names_of 4 > names.4
mapfile -t first < <(names_of 1)
PATH=$PWD/bin:$PATH
job=$(sbatch --parsable -o 'log.%a' "$ROOT/scenes/designs/array.sbatch" many.yaml out)
until some "${first[@]}"; do sleep 0.05; done
until grep -qs interrupted log.1; do # as Slurm does before the time is over, or for a job that matters more
    scancel -s TERM "${job}_1" 2> /dev/null || true
    sleep 0.5
done
# A task that puts itself into the queue again waits there for two minutes: here it is submitted with the other.
for _ in {1..600}; do
    [ "$(squeue -h -r -j "$job" -o %T | sort -u)" != PENDING ] || break
    sleep 0.1
done
scontrol show job "${job}_1" | grep -o 'Restarts=1'
scancel "$job"
wait_for "$job"
missing=$(rasp batch many.yaml -o out --missing 7)
echo "missing: $missing"
[ ! -e out/SHA256SUMS ] || fail "there are tables already"
job=$(sbatch --parsable -o 'log.%a' --array="$missing" "$ROOT/scenes/designs/array.sbatch" many.yaml out)
wait_for "$job"
sbatch -W -o log.set --wrap 'rasp batch many.yaml -o out --no-render' > /dev/null
sed 's/, in .*//' log.set
cmp ref/SHA256SUMS out/SHA256SUMS && same ref out && echo "the same"
finish

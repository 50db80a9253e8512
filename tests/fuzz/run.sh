#!/bin/bash
# Runs each fuzz target for its share of the time, two at once:  tests/fuzz/run.sh FOLDER SECONDS [TARGET...]
# SECONDS=0: none of them runs. Starts from tests/fuzz/corpus/NAME and what earlier runs found new; an input that breaks a target is left in FOLDER/found/.
set -uo pipefail
folder=$(realpath "$1") seconds=${2:-60}
[ "$seconds" -gt 0 ] || exit 0
cd "$(dirname "$0")" || exit 1
shift $(($# < 2 ? $# : 2))
targets=("${@/%/.c}")
targets=("${targets[@]/#/fuzz_}")
[ ${#targets[@]} -gt 0 ] || targets=(fuzz_*.c)
share=$((seconds / ((${#targets[@]} + 1) / 2)))
export folder share
mkdir -p "$folder/found" "$folder/corpus"

# Words that are put into what is YAML: the scene's keys and choices, and a design's.
{
    sed -nE 's/.*ROW_[A-Z_]+\([^"]*"\.?([a-z_.]+)".*/\1/p' ../../src/*/*.c | tr '.' '\n'
    grep -hoE '"[a-z_]+(\.[a-z_]+)+"' ../../src/*/*.c | tr -d '"' | tr '.' '\n' # keys and choices of the stages' own tables
    sed -nE 's/.*\{"([a-z_]+)",( *".*|$)/\1/p' ../../src/*/*.c
    tr -cs 'a-z_-' '\n' < corpus/design/all.yaml
} | sort -u | sed '/../!d; s/.*/"&"/' > "$folder/words"

# Called through xargs below.
# shellcheck disable=SC2317
fuzz() {
    local name=${1#fuzz_} log seeds words
    name=${name%.c}
    log=$folder/$name.log
    mkdir -p "$folder/corpus/$name"
    seeds=("corpus/$name")
    [ "$name" != heightfile ] || seeds=(corpus/{csv,grid,gsf,gwy,npy,png,sdf})
    words=()
    case $name in scene | design | recipe) words=("-dict=$folder/words") ;; esac
    if { TIMEFORMAT='stat::cpu_seconds: %0U+%0S'; time ASAN_OPTIONS=allocator_may_return_null=1 "$folder/fuzz_$name" -max_total_time="$((share > 0 ? share : 1))" \
        -max_len=16384 -timeout=10 -rss_limit_mb=1024 -print_final_stats=1 -artifact_prefix="$folder/found/$name-" "${words[@]}" "$folder/corpus/$name" \
        "${seeds[@]}" < /dev/null; } > "$log" 2>&1
    then
        echo "ok fuzz/$name ($(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs)"
    else
        echo "FAILED fuzz/$name"$'\n'"$(tail -n 60 "$log" | sed 's/^/    /')"
    fi
}
export -f fuzz
printf '%s\n' "${targets[@]}" | xargs -P 2 -I{} bash -c 'fuzz {}' | tee "$folder/results"

passed=$(grep -c '^ok fuzz/' "$folder/results")
failed=$((${#targets[@]} - passed))
echo "$passed passed, $failed failed"
[ $failed = 0 ]

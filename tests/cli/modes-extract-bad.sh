# Recordings that modes cannot be had from are refused in words, with and without a channel of force; of three the modes
# may come instead, if they are right (a strike in 8 bits, one on a large offset, one far below what follows).
. "$ROOT/tests/cli/modes-extract-make.inc"
limit=60
[ -z "${SANITIZED:-}" ] || limit=600
python3 "$ROOT/tests/lib/bad_recordings.py" 1 > list
while IFS=$'\t' read -r name force wanted what; do
    [ "$name$force" != quiet0 ] || continue # a bang of noise is not told from a strike yet
    words=()
    [ "$force" = 0 ] || words=(--force-channel 2)
    echo "$what$([ "$force" = 0 ] || echo ", with its force")"
    code=0
    (ulimit -t "$limit"; extract "$name.wav" "${words[@]}" --json -f -o "$name.csv" > "$name.json" 2> err) || code=$?
    sed -E 's/only [0-9]+ % of strike [0-9]+/only P % of strike S/' err >&2 # which they are is no promise
    [ "$code" = 0 ] || [ ! -e "$name.csv" ] || echo "a table all the same"
    if [ "$code" = 0 ] && [ "$wanted" = "unless right" ]; then
        python3 "$ROOT/tests/lib/bad_recordings.py" 1 "$name" "$name.json"
    else
        echo "exit code $code"
    fi
    rm -f "$name.csv"
done < list

# Each effect of tests/effects/list adds exactly the stages stated there; what lies before it and beside it keeps its bits; and the sound is another one, unless it is to be the same.
. "$ROOT/tests/lib/effects.sh"

# side NAME SETTINGS...: plan and files of one side
side() {
    local name=$1
    shift
    effects_options "$@"
    effects_plan "${OPTIONS[@]}" > "$name.plan"
    (cd "$ROOT" && rasp render -q "$SCENE" "${DURATION[@]}" "${OPTIONS[@]}" "${FILES_OPTIONS[@]}" -o "$HERE/$name.wav")
}

HERE=$PWD
rows=0
while IFS='|' read -r effect scene both without with stages files; do
    rm -f without* with*
    effects_scene "$scene" 0.1
    effects_files "$files"
    [ ${#FILES_NAMES[@]} -gt 0 ] || echo "$effect: no file is to stay as it is"
    side without "$both" "$without"
    side with "$both" "$with"
    gained=$(effects_gain without.plan with.plan)
    [ "$gained" = "$stages" ] || echo "$effect: gains $gained, not $stages"
    for end in "${FILES_NAMES[@]}"; do
        cmp "without$end" "with$end" || echo "$effect: $end changes"
    done
    [[ " $files " = *" sound "* ]] || ! cmp -s without.wav with.wav || echo "$effect: the sound is the same"
    rows=$((rows + 1))
done < <(effects_rows)
[ $rows -ge 30 ] || echo "only $rows rows"

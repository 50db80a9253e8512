# The rows of tests/effects/list, for the test and the evidence made of them: `. "$ROOT/tests/lib/effects.sh"`.
# shellcheck shell=bash

# effects_rows: the list without comments and without blanks about |.
effects_rows() { sed -E '/^(#|$)/d; s/ *\| */|/g; s/ *$//' "$ROOT/tests/effects/list"; }

# effects_options SETTINGS...: fills OPTIONS with --set options. All knobs are said: else each side has those that it needs.
effects_options() {
    local list part
    OPTIONS=(--set accuracy.oversampling=4 --set accuracy.gain_ramp=64 --set accuracy.contact_steps=200 --set accuracy.tip_heights=1)
    for list; do
        while IFS= read -r -d ';' part; do
            part="${part#"${part%%[! ]*}"}"
            [ -z "$part" ] || OPTIONS+=(--set "$part")
        done <<< "$list;"
    done
}

# effects_scene NAME SECONDS: fills SCENE and DURATION, options.
effects_scene() {
    SCENE=$ROOT/tests/effects/$1.yaml
    case $1 in
        two) DURATION=(--set "contacts.nail.motion.duration=$2 s" --set "contacts.rod.motion.duration=$2 s") ;;
        *) DURATION=(--set "motion.duration=$2 s") ;;
    esac
}

# effects_plan [OPTION...]: the stages that $SCENE runs, one per line, in order; of several contacts as CONTACT:STAGE.
effects_plan() {
    (cd "$ROOT" && rasp plan "$SCENE" "${DURATION[@]}" "$@") | awk '
        /^contact / { n++; name[n] = substr($2, 2, length($2) - 3) }
        /^  [a-z_]+ +[0-9.]+ %  / { rows++; row[rows] = $1; of[rows] = n }
        END { for (i = 1; i <= rows; i++) print (n > 1 ? name[of[i]] ":" : "") row[i] }'
}

# effects_gain WITHOUT WITH: the stages of file WITH that WITHOUT has not, then those lost, each with a minus; or "none".
effects_gain() {
    local text
    text=$({ grep -vxFf "$1" "$2"; grep -vxFf "$2" "$1" | sed 's/^/-/'; } | tr '\n' ' ')
    text=${text% }
    echo "${text:-none}"
}

# effects_files FILES: fills FILES_OPTIONS with the options that make these files, and FILES_NAMES with how the names of the files end.
effects_files() {
    local word columns stems=
    FILES_OPTIONS=() FILES_NAMES=()
    for word in $1; do
        case $word in
            sound) FILES_NAMES+=(.wav) ;;
            table:*:*)
                columns=${word##*:} word=${word#table:}
                FILES_NAMES+=(".${word%%:*}.csv") ;;
            table:*)
                columns=${word#table:}
                FILES_NAMES+=(.csv) ;;
            *)
                stems+=", $word"
                FILES_NAMES+=(".$word.wav") ;;
        esac
    done
    [ -z "$stems" ] || FILES_OPTIONS+=(--set "output.stems=[${stems#, }]")
    [ -z "${columns:-}" ] || FILES_OPTIONS+=(--set "output.diagnostics={rate: 48 kHz, columns: [$columns]}")
}

# What people get wrong, one fault a case, through the command line: the exit code, the message, where it points, and that nothing is
# left or changed in the folder. The cases are tests/faults/bad_inputs.d/*.cases; what they start from is bad_inputs.d/inputs.sh.
#     bad NAME CODE MAKE COMMAND PATTERN...
# MAKE turns the good inputs of a fresh folder into bad ones, COMMAND must then end with CODE, print nothing on standard output (but
# for a comparison that differs), and every PATTERN (extended regular expression) must match a line of what it says.
#     good NAME MAKE COMMAND
# is the same without a fault: it keeps the cases beside it honest.
# BAD_INPUTS_SHOW=1 prints every message, to be read as by someone who sees it for the first time.
. "$ROOT/tests/lib/test.sh"
DATA=$ROOT/tests/faults/bad_inputs.d
RASP=$(command -v rasp) || { echo "rasp is not on PATH"; exit 1; }
TOP=$PWD
PASSED=0
FAILED=0
. "$DATA/inputs.sh"

# A program that hangs ends with 124.
rasp() { timeout -k 5 120 "$RASP" "$@"; }

# Names, kinds, rights, inodes, sizes, times to the nanosecond: a file that is replaced by one of the same content is a change as well.
state_of() {
    find "$1" \( -type d -printf '%y %m %P\n' \) -o -printf '%y %m %i %s %T@ %P\n'
}

# run NAME MAKE COMMAND: in a folder of its own; leaves out and err in $CASE, the exit code in CODE.
run() {
    CASE=$TOP/$1
    mkdir "$CASE" "$CASE/in" "$CASE/tmp"
    (cd "$CASE/in" && good_inputs && eval "$2") > "$CASE/make" 2>&1 || echo "its inputs cannot be made" > "$CASE/why"
    STATE=$(state_of "$CASE/in")
    CODE=0
    (cd "$CASE/in" && export TMPDIR=$CASE/tmp && eval "$3") > "$CASE/out" 2> "$CASE/err" < /dev/null || CODE=$?
    [ -z "${BAD_INPUTS_SHOW:-}" ] || { echo "== $1: $CODE"; cat "$CASE/err"; }
}

because() { echo "$*" >> "$CASE/why"; }

unchanged() {
    local after
    after=$(state_of "$CASE/in")
    [ "$after" = "$STATE" ] || [ "$(sort <<< "$after")" = "$(sort <<< "$STATE")" ] ||
        because "the folder changed: $(diff <(sort <<< "$STATE") <(sort <<< "$after") | grep '^[<>]')"
    rmdir "$CASE/tmp" || because "left in TMPDIR: $(ls -A "$CASE/tmp")"
}

verdict() {
    if [ ! -f "$CASE/why" ]; then
        PASSED=$((PASSED + 1))
    else
        FAILED=$((FAILED + 1))
        echo "$1: $(cat "$CASE/why")"
        sed 's/^/    /' "$CASE/make" "$CASE/err"
    fi
    rm -rf "$CASE"
}

# says PATTERN: does a line of the messages match it? (grep without a process)
says() {
    local line
    for line in "${SAID[@]}"; do
        [[ ! $line =~ $1 ]] || return 0
    done
    return 1
}

sound_of_mind() {
    mapfile -t SAID < "$CASE/err"
    [ "$CODE" = "$1" ] || because "exit code $CODE instead of $1"
    ! says 'runtime error:|Sanitizer' || because "a sanitizer speaks"
}

# placed CODE COMMAND: what is refused of a scene has a place in it, or the option that says it.
placed() {
    case $1:$2 in 65:rasp\ check* | 65:rasp\ render* | 65:rasp\ plan*) says '(:[0-9]+:[0-9]+: |--set [a-z_.]+: |--seed: |\.yaml: error: )' ;; esac
}

bad() {
    local name=$1 code=$2 command=$4 pattern
    run "$name" "$3" "$4"
    shift 4
    sound_of_mind "$code"
    for pattern; do
        says "$pattern" || because "no line says: $pattern"
    done
    if [ "$code" != 1 ]; then
        says '^rasp( [a-z]+)?: error: ' || because "no line 'rasp COMMAND: error: ...'"
        placed "$code" "$command" || because "no line and column"
        [ ! -s "$CASE/out" ] || because "on standard output: $(head -n 3 "$CASE/out")"
    fi
    unchanged
    verdict "$name"
}

good() {
    run "$1" "$2" "$3"
    sound_of_mind 0
    verdict "$1"
}

for cases in "$DATA"/*.cases; do
    # shellcheck disable=SC1090
    . "$cases"
done
echo "bad_inputs: $PASSED passed, $FAILED failed"
[ "$FAILED" = 0 ]

# The completion of bash, asked as readline asks it: words broken at = or not, options, their words, files by ending, keys and their words.
rasp completion bash > completion
bash -n completion
. ./completion
touch a.yaml b.yml c.wav d.csv 'two words.yaml' e.design.yaml
mkdir folder

# ask WORD...: what the last word may become; = is a word of its own in COMP_WORDS where it is a break.
ask() {
    local IFS=' '
    COMP_WORDS=() COMP_WORDBREAKS=${BREAKS-$' \t\n"\'><=;|&(:'}
    local word part
    for word; do
        if [[ $COMP_WORDBREAKS == *=* && $word == *=* ]]; then
            part=${word%%=*}
            COMP_WORDS+=("$part" "=")
            part=${word#*=}
            [[ $part != *=* ]] || { COMP_WORDS+=("${part%%=*}" "=") part=${part#*=}; }
            [[ ! $part ]] || COMP_WORDS+=("$part")
        else
            COMP_WORDS+=("$word")
        fi
    done
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _rasp || true # a shell with -e has no completion
    echo "$*| ${COMPREPLY[*]}"
}
ask rasp pl
ask rasp com
ask rasp --v
ask rasp help an
ask rasp new sc
ask rasp check ''
ask rasp check two
ask rasp check --diag
ask rasp new -
ask rasp render -q --ver
ask rasp plot ''
ask rasp plot --format ''
ask rasp plot --format=s
ask rasp plot --format=
ask rasp plot --format=svg c
ask rasp plot -f p
ask rasp plot --panels w
ask rasp plot -p force,mo
ask rasp plot --panels=force,n
ask rasp plan --set motion.p
ask rasp plan --set=motion.p
ask rasp plan --set motion.path=s
ask rasp plan --set=motion.path=s
ask rasp plan -s accuracy.pre
ask rasp plan --set motion.path=line b
ask rasp plan -- --x
ask rasp explain motion.pr
ask rasp surface ''
ask rasp surface info --p
ask rasp surface convert --l
ask rasp surface info --levelling ''
ask rasp modes object --quantity v
ask rasp modes object -o ''
ask rasp completion ''
ask rasp nonsense ''
BREAKS=$' \t\n"\'><;|&(:'
ask rasp plot --format=s
ask rasp plan --set=motion.path=s

# every command and every option there is
for command in $(rasp completion words -- '' | cut -f 1); do
    [ "$command" = help ] || rasp help "$command" | grep -Eo '^ +(-., )?--[a-z0-9-]+' | grep -Eo -e '--.*' | while read -r option; do
        rasp completion words -- "$command" - | grep -e "^$option"'[=[:blank:]]' > /dev/null || echo "$command: $option is not completed"
    done
done

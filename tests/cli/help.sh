# Help goes to stdout with exit 0, the same in every form, examples first.
rasp new --help > a
rasp help new > b
rasp new -h > c
rasp new --help --nonsense > d
cmp a b; cmp a c; cmp a d
cat a
rasp --help > e
rasp help > f
cmp e f
sed -n 1,3p e
for command in $(sed -n '/^[A-Z].*:$/,/^$/s/^  \([a-z]*\) .*/\1/p' e | sort -u); do
    [ "$command" != rasp ] || continue
    rasp help "$command" > g
    [ "$(sed -n 3p g)" = Examples: ] || echo "$command does not begin with examples"
    sed -n "1,/^Usage/p" g | grep -q "rasp $command " || echo "$command has no examples"
    grep -q '^ *-h, --help' g || echo "$command does not tell of --help"
    echo "$command"
done > h
sed -n '/ /p' h
for command in render golden plan new explain check compare plot accuracy analyse judge surface modes completion; do
    grep -qx "$command" h || echo "not in the usage: $command"
done

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
for command in render plan new explain check compare plot; do
    rasp help $command | grep -q '^Examples:' || echo "no examples: $command"
    grep -q "^  $command " e || echo "not in the usage: $command"
done

# Colours: on a terminal, unless NO_COLOR is set and not empty or TERM is dumb; never elsewhere.
command -v script > /dev/null || { echo "script is not installed"; exit 77; }
rasp new -o good.yaml
sed 's/rms: 4 um/rms: 4 g/' good.yaml > bad.yaml
# escapes COMMAND...: how many colours its messages have on a terminal.
escapes() { { script -qec "$*" /dev/null < /dev/null || true; } | grep -o $'\033\\[[0-9;]*m' | wc -l; }
export TERM=xterm
unset NO_COLOR
echo "terminal: $(escapes rasp check bad.yaml)"
echo "usage: $(escapes rasp check --nonsense)"
echo "NO_COLOR: $(NO_COLOR=1 escapes rasp check bad.yaml)"
echo "NO_COLOR empty: $(NO_COLOR='' escapes rasp check bad.yaml)"
echo "dumb: $(TERM=dumb escapes rasp check bad.yaml)"
echo "JSON: $(escapes rasp check --diagnostics=json bad.yaml)"
rasp check bad.yaml 2> plain || true
echo "file: $(grep -c $'\033' plain || true)"
{ script -qec 'rasp check bad.yaml' /dev/null < /dev/null || true; } | sed 's/\r$//; s/\x1b\[[0-9;]*m//g' | cmp - plain && echo "the same text"

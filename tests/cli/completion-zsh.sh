# The completion of zsh, in a shell that is typed into: a word and a tab, and the line that stands there then.
command -v zsh > /dev/null || { echo "zsh is not installed"; exit 77; }
mkdir functions
rasp completion zsh > functions/_rasp
zsh -n functions/_rasp
touch a.yaml c.wav d.csv
cat > type.py <<'X'
import os, pty, re, select, sys, time

pid, shell = pty.fork()
if pid == 0:
    os.environ.update(HOME=os.getcwd(), ZDOTDIR=os.getcwd(), TERM="dumb", COLUMNS="200")
    os.execvp("zsh", ["zsh", "-f", "-i"])

def read_until(mark):
    text = b""
    end = time.time() + 30
    while mark not in text and time.time() < end:
        if select.select([shell], [], [], 0.5)[0]:
            text += os.read(shell, 65536)
    return text

def run(line):
    os.write(shell, line + b"; echo D''ONE\n")
    read_until(b"DONE")

run(b"unsetopt zle beep; PS1=; fpath=($PWD/functions $fpath); autoload -Uz compinit; compinit -u -D; setopt zle")
run(b"show() { print -r -- \"<<$BUFFER>>\"; BUFFER=; zle accept-line }; zle -N show; bindkey '^X' show; bindkey '^I' complete-word; setopt no_auto_menu no_list_beep no_auto_list")
for line in sys.stdin:
    os.write(shell, line.rstrip("\n").encode() + b"\t\x18")
    got = re.search(rb"<<(.*?)>>", read_until(b">>"), re.S)
    print(line.rstrip("\n") + "|", got.group(1).decode() if got else "nothing")
os.write(shell, b"\nexit\n")
X
# Each has one answer, or a beginning that all answers share.
cat > lines <<'X'
rasp pla
rasp help anal
rasp --vers
rasp check a
rasp plot c
rasp plot --form
rasp plot --format=s
rasp plot -f p
rasp plot --panels wa
rasp plot -p force,mod
rasp plot --panels=force,n
rasp plan --set motion.pat
rasp plan --set=motion.pat
rasp plan --set motion.path=scr
rasp plan --set=motion.path=scr
rasp plan -s accuracy.pre
rasp explain motion.prof
rasp surface inf
rasp surface info --pit
rasp surface convert --cro
rasp surface info --cro
rasp modes object --quantity vel
rasp completion fi
X
python3 type.py < lines

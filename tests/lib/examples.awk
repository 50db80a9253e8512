# Writes the examples of a Markdown file (blocks fenced by exactly ```sh) or of the EXAMPLES section of a man page (-v kind=1 or 5)
# to blocks/01, blocks/02 ...: in man pages, .Dl lines and the text of .Bd -literal, .EX and .nf blocks, without a leading "$ ".
# A fence "```sh no-run" is left out.
function start() { file = sprintf("blocks/%02d", ++n); inside = 1 }
kind == "md" && inside && /^```/ { inside = 0; close(file); next }
kind == "md" && /^```sh$/ { start(); next }
kind == "md" && inside { print > file; next }
kind == "md" { next }

/^\.S[hH] / { examples = ($0 ~ /EXAMPLES/) }
!examples { next }
inside && /^\.(Ed|EE|fi)/ { inside = 0; close(file); next }
/^\.(Bd -literal|EX|nf)/ { start(); next }
/^\.Dl / { start(); inside = 0; print shell(substr($0, 5)) > file; close(file); next }
inside && !/^\.\\"/ { print shell($0) > file }
function shell(line) {
    sub(/^[ \t]*\$ /, "", line)
    gsub(/\\&/, "", line)
    gsub(/\\-/, "-", line)
    gsub(/\\e/, "\\", line)
    return line
}

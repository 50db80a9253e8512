# Includes go only leftwards along ORDER, and name their folder: a file includes its own folder and folders to its left.
. "$ROOT/tests/lib/test.sh"
ORDER="base num file scene stage.h trajectory surface force response convolution output fem analysis pipeline batch cmd main"

# layers FOLDER: every include that goes the wrong way, one per line.
layers() {
    (cd "$1" && find . -name '*.[ch]' -o -name '*.def' | sort | xargs awk -v order="$ORDER" '
        BEGIN { n = split(order, name, " "); for (i = 1; i <= n; i++) rank[name[i]] = i }
        function layer(path,  part) { split(path, part, "/"); sub(/^main(_modes)?\.c$/, "main", part[1]); return part[1] }
        FNR == 1 { here = layer(substr(FILENAME, 3)); if (!(here in rank)) print FILENAME ": \"" here "\" has no place in the order" }
        /^[ \t]*#[ \t]*include[ \t]*"/ {
            split($0, quoted, "\""); there = layer(quoted[2])
            if (!(there in rank)) print FILENAME ":" FNR ": includes \"" quoted[2] "\" without its folder"
            else if (rank[there] > rank[here]) print FILENAME ":" FNR ": " here " includes " quoted[2]
        }')
}

# The check can fail: each of these must be caught.
mkdir -p planted/base planted/cmd
echo '#include "scene/scene.h"' > planted/base/wrong.c
echo '#include "beside.h"' > planted/cmd/bare.c
printf '#include <stdio.h>\n#include "base/err.h"\n' > planted/cmd/right.c
found=$(layers planted | wc -l)
[ "$found" = 2 ] || fail "layers: found $found of 2 planted violations"

wrong=$(layers "$ROOT/src")
[ -z "$wrong" ] || fail "$wrong"
finish

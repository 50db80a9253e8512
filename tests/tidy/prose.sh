# What is read in one go can be: tests/tidy/prose.py finds no sentence of more than 40 words, no paragraph of more than 120, and a median below 20. Papers are
# named by author and year: whoever reads a page has no folder of them.
. "$ROOT/tests/lib/test.sh"
command -v python3 > /dev/null || skip "python3 is not installed"

# Pages that keep to it.
PAGES="README.md man/rasp.1 man/rasp-scene.5 man/rasp-accuracy.1 man/rasp-design.5 man/rasp-record.7"

# long FILE...: sentences and paragraphs that are too long.
long() { (cd "$ROOT" && python3 tests/tidy/prose.py "$@"); }

# numbered FILE...: lines that name a paper by its number in a folder.
numbered() { grep -nE '[Pp]apers/[0-9]|(^|[^0-9.])00[0-4]([^0-9._]|$)' "$@"; }

# words N: a sentence of N words.
words() { printf 'Word'; printf ' word%.0s' $(seq 2 "$1"); echo .; }

mkdir planted
{ printf '.Sh DESCRIPTION\n'; words 40; printf '.Pp\n'; words 41; for _ in 1 2 3 4 5 6 7; do printf '.Pp\n'; words 9; done; } > planted/sentence.7
{ printf '.Sh DESCRIPTION\n'; for _ in $(seq 1 13); do words 10; done; printf '.Pp\n'; for _ in $(seq 1 12); do words 10; done; } > planted/paragraph.7
{ printf '.Sh DESCRIPTION\n'; words 10; words 20; words 21; } > planted/median.7
planted=$(long "$PWD"/planted/*.7)
for what in 'sentence.7: a sentence of 41 words' 'paragraph.7: a paragraph of 130 words' 'median.7: a median of 20 words'; do
    case $planted in *"$what"*) ;; *) fail "prose: not found, but planted: $what" ;; esac
done
[ "$(wc -l <<< "$planted")" = 3 ] || fail "prose: more found than was planted: $planted"
printf '%s\n' 'as papers/002 has it' "004's beta" '(000 eq. 7)' '0.001 of 1000, and 2000' 002_rolling.yaml > planted/numbered
[ "$(numbered planted/numbered | wc -l)" = 3 ] || fail "prose: papers by number were not found, or more than these"

wrong=$(long $PAGES)
[ -z "$wrong" ] || fail "$wrong"
! numbered "$ROOT"/man/*.[157] || fail "prose: these pages name papers by numbers that readers do not have"
finish

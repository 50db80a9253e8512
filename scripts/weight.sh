#!/bin/bash
# The weight of src/: what there is to read. Prints a table: figure, today, what is to be reached.
#     scripts/weight.sh [--words | --long]     also lists identifiers with house words, or lines over 120 columns
# Lines of code are lines as clang-format leaves them in the style of .clang-format, without blank lines and comments.
# A use of a static function is a call: its name with an opening parenthesis, but for its definition and declarations.
set -euo pipefail
cd "$(dirname "$0")/.."
for tool in clang-format ctags python3; do
    command -v "$tool" > /dev/null || { echo "weight: $tool is not installed"; exit 77; }
done
exec python3 - "$@" << 'END'
import collections, glob, re, subprocess, sys

FILES = sorted(glob.glob("src/**/*.[ch]", recursive=True))
# House words for things that have a name in the field; as a part of an identifier, between underscores or ends.
WORDS = """told tell owns_up kept keep shelf heard noted way hats crest bed leaves bulge chorus voices pinch slant spell survey means
rehearsal promise excerpts said claim spare leftover unheard kit settle hums apart doubt guest held glue touch chart raise gone""".split()
ALLOWED = {"png_set_keep_unknown_chunks"}  # libpng's
STRIP = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'', re.S)

def without_comments(text):
    return STRIP.sub(lambda m: m.group() if m.group()[0] in "\"'" else " " + "\n" * m.group().count("\n"), text)

def code_only(text):
    return STRIP.sub(lambda m: '""' if m.group()[0] in "\"'" else " " + "\n" * m.group().count("\n"), text)

texts = {f: open(f).read() for f in FILES}
done = subprocess.run(["clang-format", *FILES], capture_output=True, text=True, check=True).stdout
lines = sum(1 for line in without_comments(done).splitlines() if line.strip())
code = {f: code_only(t) for f, t in texts.items()}

tags = subprocess.run(["ctags", "-o", "-", "--languages=C", "--langmap=C:.c.h", "--kinds-C=fp", "--fields=kfn", "--sort=no", *FILES],
                      capture_output=True, text=True, check=True).stdout
static = collections.Counter()
once = 0
calls = {f: collections.Counter(re.findall(r"\b([A-Za-z_]\w*)\s*\(", code[f])) for f in FILES}
everywhere = sum(calls.values(), collections.Counter())
named = collections.defaultdict(lambda: [0, 0])  # (file, name): definitions, declarations
for tag in tags.splitlines():
    cells = tag.split("\t")
    if "file:" in cells[3:] or cells[1].endswith(".h"):
        named[cells[1], cells[0]]["p" in cells[3:]] += 1
for (file, name), (defined, declared) in named.items():
    if defined == 0:
        continue
    static[file] += 1
    uses = (everywhere if file.endswith(".h") else calls[file])[name] - defined - declared
    once += uses == 1
functions = sum(static.values())

long = [f"{f}:{i}" for f in FILES for i, line in enumerate(texts[f].splitlines(), 1) if len(line) > 120]
house = collections.Counter()
for f in FILES:
    for name in set(re.findall(r"\b[A-Za-z_]\w*", code[f])):
        if name not in ALLOWED and set(re.split(r"_+", name.lower())) & set(WORDS):
            house[name] += 1
sizes = sorted(len(t.splitlines()) for f, t in texts.items() if f.endswith(".c"))
first = [f for f in FILES if re.search(r"000[^;.()]{0,12}\beqs?\. ?[1-5]\b", texts[f])]
rows = [("lines of code", lines, "<= 50000"), ("files", len(FILES), "<= 400"),
        ("static functions with one caller, %", round(100 * once / max(functions, 1), 1), "<= 45"),
        ("static functions", functions, ""),
        ("lines over 120 columns", len(long), "0"), ("identifiers with a house word", len(house), "0"),
        ("lines of the median .c file", sizes[len(sizes) // 2], "200 to 600"),
        ("files that name equations 1 to 5 of 000", len(first), "<= 6")]
print(f"{'src':42}{'today':>8}  to reach")
for name, value, goal in rows:
    print(f"{name:42}{value:>8}  {goal}")
if "--words" in sys.argv:
    print(*(f"{name} {n}" for name, n in sorted(house.items())), sep="\n")
if "--long" in sys.argv:
    print(*long, sep="\n")
END

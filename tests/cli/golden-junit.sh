# JUnit's XML as another parser reads it, written only when all was checked; and a picture of how a sound differs.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
. "$ROOT/tests/cli/golden-make.inc"
cat > junit.py << 'END'
import xml.etree.ElementTree as tree
for suite in tree.parse("out.xml").getroot():
    print(suite.tag, {k: suite.get(k) for k in ("tests", "failures", "errors")})
    for case in suite:
        print(case.tag, case.get("name"), case.get("file"))
        for what in case:
            print("   ", what.tag, "|", what.get("message").replace("\n", " "), "|", len(what.text.splitlines()) > 1)
END
cp stroke.yaml 'a & b.yaml'
sed 's/10 g/-10 g/' stroke.yaml > wrong.yaml
printf '%s\n' stroke.yaml forces.yaml "'a & b.yaml' --name ab" > list.txt
rasp golden update -q list.txt
try rasp golden check list.txt --junit out.xml
python3 junit.py
echo "-- one differs, one is no scene, something is left over"
flip golden/stroke/sound.wav 300
echo 'x' > golden/forces/more.csv
echo wrong.yaml >> list.txt
mkdir golden/gone && cp golden/ab/sound.wav golden/gone/
try rasp golden check -q list.txt --junit out.xml -o differs | grep -c FAILED
python3 junit.py | sed "s|$PWD/||"
find differs -name '*.png'
od -A n -t u1 -j 16 -N 10 differs/stroke/first/sound.png
echo "-- the kept sound and the new one look alike, and of their difference nothing is seen but where it is"
python3 - << 'END'
import struct, zlib
data, at, packed = open("differs/stroke/first/sound.png", "rb").read(), 8, b""
while at < len(data):
    n, kind = struct.unpack(">I4s", data[at : at + 8])
    packed += data[at + 8 : at + 8 + n] if kind == b"IDAT" else b""
    at += 12 + n
raw = zlib.decompress(packed)
rows = [raw[k * 801 + 1 : (k + 1) * 801] for k in range(486)]
parts = [rows[k : k + 160] for k in (0, 163, 326)]
print(parts[0] == parts[1], {c for row in rows[160:163] for c in row}, max(map(max, parts[0])), max(map(max, parts[2])) < 20)
END
echo "-- a picture of an earlier check does not stay where the sound is as kept again"
flip golden/stroke/sound.wav 300
echo x >> golden/stroke/sound.csv
rasp golden check -q stroke.yaml -o differs > /dev/null || find differs -name '*.png' -o -name sound.wav
echo "-- what cannot be, and what is not rasp's"
echo mine > mine.xml
try rasp golden check -q list.txt --junit mine.xml
try rasp golden check -q list.txt --junit gone/out.xml
rm out.xml
: > empty.txt
try rasp golden check empty.txt --junit out.xml
find . -name '*.xml'

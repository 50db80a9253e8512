# Diagnostics as NPY: what Python reads of it is what the CSV of the same render says, to its 9 digits; what follows from the other format.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
contact='surface: {roughness: {}, response: modes.csv}, scraper: {mass: 10 g}, motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}'
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
printf '%s\n' 'rasp: 1' "contacts: [{name: rod, $contact}]" 'output: {diagnostics: {rate: 44.1 kHz}}' > one.yaml
rasp render -q one.yaml -o text.wav
rasp render -q one.yaml --set output.diagnostics.format=npy
cmp text.wav one.wav
cat > read.py << 'END'
import ast, csv, struct, sys
data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x93NUMPY\x01\x00"
length = struct.unpack("<H", data[8:10])[0]
head = ast.literal_eval(data[10 : 10 + length].decode("ascii"))
assert set(head) == {"descr", "fortran_order", "shape"} and not head["fortran_order"] and (10 + length) % 64 == 0
names = [name for name, kind in head["descr"]]
assert all(kind == "<f8" for name, kind in head["descr"])
rows = [r for r in struct.iter_unpack("<%dd" % len(names), data[10 + length :])]
assert head["shape"] == (len(rows),)
table = list(csv.reader(open(sys.argv[2])))
assert table[0] == names and len(table) == 1 + len(rows)
assert all("%.9g" % x == text for row, texts in zip(rows, table[1:]) for x, text in zip(row, texts))
print(len(rows), "rows of", len(names), "columns: the same")
try:
    import numpy
except ImportError:
    sys.exit()
t = numpy.load(sys.argv[1])
assert t.dtype.names == tuple(names) and t.shape == (len(rows),) and all((t[n] == [r[k] for r in rows]).all() for k, n in enumerate(names))
END
python3 read.py one.npy text.csv
echo "-- compared"
rasp compare -q --rel 5.1e-9 text.csv one.npy && echo "within 9 digits"
rasp compare one.npy one.npy | tail -n 1
rasp compare -q one.npy text.csv > differences || echo "exit $?"
rasp compare one.npy --hash "$(sha256sum < one.npy | cut -d " " -f 1)" | cut -d ' ' -f 1-4
echo "-- the effective scene gives the same bytes"
grep 'format:' one.scene.yaml
mkdir again
rasp render -q one.scene.yaml -o again/one.wav
cmp one.npy again/one.npy
echo "-- listed with its hash; that of another format is told"
python3 -c 'import hashlib, json
for f in json.load(open("one.json"))["files"]:
    print(f["kind"], f["name"], "sha256" in f and hashlib.sha256(open(f["name"], "rb").read()).hexdigest() == f["sha256"])'
rasp render -q one.yaml
rasp render -q one.yaml --set output.diagnostics.format=npy
echo "-- analysed alike"
for file in one.npy one.csv; do rasp analyse --json $file | python3 -c 'import json, sys
d = json.load(sys.stdin)["source"]
print(d["kind"], d["impacts"], "impacts,", round(d["rate_hz"]), "Hz")'; done

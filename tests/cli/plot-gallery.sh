# A page for a set of stimuli, and for a folder of sounds: what it links is there, names are escaped, failures are told.
command -v gnuplot > /dev/null || { echo "gnuplot is not installed"; exit 77; }
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
cat > links.py << 'END'
# Reads a page as a browser would: elements that are closed in order, links that are files.
import html.parser, os, sys, urllib.parse
page, stack, links, texts = sys.argv[1], [], [], []
class Reader(html.parser.HTMLParser):
    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "img"):
            stack.append(tag)
        links.extend((tag, v) for k, v in attributes if k in ("src", "href"))
    def handle_endtag(self, tag):
        assert stack.pop() == tag, tag
    def handle_data(self, data):
        if data.strip() and stack[-1] not in ("style",):
            texts.append(data.strip())
    handle_decl = lambda self, decl: print("declaration:", decl)
Reader(convert_charrefs=True).feed(open(page, encoding="utf-8").read())
assert not stack, stack
assert not any(tag == "script" for tag, link in links)
for tag, link in links:
    name = os.path.join(os.path.dirname(page), urllib.parse.unquote(link))
    print(tag, link, "is there" if os.path.exists(name) else "is missing")
print(" | ".join(texts))
END
cat > stroke.yaml << 'END'
rasp: 1
surface: {roughness: {}, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0 cm], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 20 ms}
END
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
cat > design.yaml << 'END'
rasp-design: 1
base: stroke.yaml
factors:
  motion.speed: [10 cm/s, 20 cm/s]
  tool:
    - {label: light & small, set: {scraper.mass: 1 g}}
    - {label: heavy, set: {scraper.mass: 50 g}}
END
rasp batch -q design.yaml -o set
rasp plot --gallery set
python3 links.py set/gallery.html | sed 's/-[0-9.]* \(dBFS\|LUFS\)/... \1/g'
echo "-- the manifest, elsewhere, with a title"
rasp plot --gallery set/manifest.csv -o page.html --title 'a <b> & "c"' --format svg --panels modes
python3 links.py page.html | sed '/^img\|^a /!d; s/ is/\n&/' | sort | uniq -c | sort -rn | head -n 1
grep -o '<h1>.*</h1>' page.html
echo "-- stimuli without sound, and some that failed"
sed 's/, response: modes.csv//' stroke.yaml > bare.yaml
cat > forces.yaml << 'END'
rasp-design: 1
base: bare.yaml
level: scene
set: {output.diagnostics.rate: 1 kHz}
factors:
  motion.speed: [10 cm/s, 20 cm/s]
  kind:
    - {label: force, set: {output.diagnostics.format: csv}}
    - {label: npy, set: {output.diagnostics.format: npy}}
    - {label: clips, set: {surface.response: modes.csv, output.level.full_scale: 1e-9}}
END
rasp batch -q forces.yaml -o forces 2> batch.txt || echo "exit $?"
rasp plot --gallery forces
python3 links.py forces/gallery.html | sed 's/ | /\n/g' | sed 's/frame .*channel 1: .* is .* dB re/... dB re/'
rasp plot --gallery forces -o panels.html --panels waveform,normal
echo "-- a folder of sounds"
mkdir 'some sounds'
rasp render -q stroke.yaml -o 'some sounds/one 100%.wav'
echo no sound > 'some sounds/two.wav'
rasp plot --gallery 'some sounds/'
python3 links.py 'some sounds/gallery.html'
echo "-- what cannot be"
try() { "$@" || echo "exit code $?"; }
mkdir empty
try rasp plot --gallery empty
try rasp plot --gallery gone
try rasp plot --gallery stroke.yaml
try rasp plot --gallery modes.csv
try rasp plot --gallery set -o page.txt
try rasp plot --gallery set --from 1
try rasp plot --gallery set -o gone/page.html
try rasp plot --gallery set --panels force
find . -name '*.html' | sort

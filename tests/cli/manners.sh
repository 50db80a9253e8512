# What a person writes who does not know the words: marks of Windows' editors, minutes, near names, words that are no keys, and what is legal and hardly meant.
try() { local code=0; "$@" || code=$?; echo "$code"; }
rasp new -o scrape.yaml
with() { sed "s/$1/$2/" scrape.yaml > mine.yaml; }
echo "-- a byte order mark"
{ printf '\xef\xbb\xbf'; cat scrape.yaml; } > bom.yaml
rasp check bom.yaml
rasp explain bom.yaml | cmp - <(rasp explain scrape.yaml) && echo the same
echo "-- times"
for time in '0.5 min' '30 sec' '0.25 h' '500 ms'; do
    with 'duration: 2 s' "duration: $time" && rasp explain mine.yaml | grep '^  duration'
done
echo "-- another prefix is meant"
with '48 kHz' '48 Hz' && try rasp check mine.yaml
with '20 g' '20' && rasp check mine.yaml
with 'rate: 2 Hz' 'rate: 48 Hz' && rasp check mine.yaml
with '8 cm, 0 cm' '8 km, 0 cm' && try rasp check mine.yaml
echo "-- near names of files"
try rasp check scrape.ymal
try rasp check srcape.yaml
try rasp check mien/scrape.yaml
echo 'include: [scrap.yaml]' > other.yaml && try rasp check other.yaml
cp "$ROOT/irs/oak_plank.csv" . && try rasp check scrape.yaml --set surface.response=oak_plnak.csv
echo "-- words that are no keys"
for word in loudness repeats wood motoin speed xyzzy; do try rasp explain $word; done
rasp explain frequency | grep motion.rate
echo "-- a level that integers do not hold: which one fits"
try rasp render -q scrape.yaml --set output.level.lufs=-1
try rasp render -q scrape.yaml --set output.level.rms=-3

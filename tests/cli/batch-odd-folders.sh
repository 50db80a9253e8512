# Output folders as they come: stimuli on another disk than what is hidden, folders in folders that become empty, records that a power cut left empty or cut off.
. "$ROOT/tests/cli/batch-make.inc"
sed -i 's/^factors/name: "a\/{material}\/{motion.duration}"\nset: {output.stems: [force], output.diagnostics.rate: 1 kHz}\nfactors/' six.yaml
rasp batch six.yaml -o ref -q
echo "-- on another disk"
disk=$(mktemp -d /dev/shm/rasp-test.XXXXXX 2> /dev/null) || disk=$(mktemp -d)
trap 'rm -rf "$disk"' EXIT
mkdir -p out/a
ln -s "$disk" out/a/low
rasp batch six.yaml -o out -q
(cd out && sha256sum -c --quiet SHA256SUMS) && diff <(grep -v "scene\|manifest" ref/SHA256SUMS) <(grep -v "scene\|manifest" out/SHA256SUMS) && echo "the same sums, but for scenes (and the manifest, which has their hashes), which name files as they are seen from where they lie"
find out/.rasp -type f | sort
echo "-- records"
: > ref/a/low/200ms.json
head -c -3 ref/a/low/250ms.json > short && cp short ref/a/low/250ms.json
{ head -c 100 /dev/zero; tail -c +101 ref/a/low/300ms.json; } > short && cp short ref/a/low/300ms.json
rasp batch six.yaml -o ref | sed 's/, in .*//'
rasp batch six.yaml -o ref | sed 's/, in .*//'
for file in ref/a/low/*.json; do python3 -m json.tool "$file" > /dev/null && echo "$file"; done
echo "-- notes in them do not stay: the record is what it was"
cp ref/a/low/200ms.json 200.json
echo '# a good one' >> ref/a/low/200ms.json
printf good > ref/a/low/250ms.json
rasp batch six.yaml -o ref | sed 's/, in .*//'
cmp ref/a/low/200ms.json 200.json
echo "-- a design in a folder whose name is no UTF-8"
latin=$(printf 'caf\351')
mkdir "$latin"
for file in six.yaml tiny.yaml; do sed "s|[a-z]*\.csv|$PWD/&|" $file > "$latin/$file"; done
rasp batch "$latin/six.yaml" -o far -q
rasp batch "$latin/six.yaml" -o far | sed 's/, in .*//'
cp "$latin/six.yaml" "$latin/with.yaml"
echo "recordings: [{file: real.wav, name: real}]" >> "$latin/with.yaml"
cp far/a/low/200ms.wav "$latin/real.wav"
rasp batch "$latin/with.yaml" -o with --dry-run --json | grep '"recording": "'
python3 -c 'import json; print([f["name"] for f in json.load(open("far/a/low/200ms.json"))["files"]])'
echo "-- folders that are empty"
sed -i 's/{material}/b/; /^  material/d' six.yaml
rasp batch six.yaml -o ref --prune -q
find ref -type d | sort
sed -i 's/a\/b\///' six.yaml
touch ref/a/mine
rasp batch six.yaml -o ref --prune -q
find ref -type d | sort

# An effective scene says which version wrote it; one of other sounds that renders it says so.
rasp new stroke -o stroke.yaml
rasp render -q stroke.yaml
grep written_by stroke.scene.yaml | sed "s/[0-9.]*\"$/N\"/"
echo "-- by another version: of other sounds, of the same, none"
for by in 0.1.7 "$(rasp --version | sed "s/rasp //; s/\.[0-9]*$/.99/")" ""; do
    sed "s/^written_by.*/written_by: \"rasp $by\"/; s/\"rasp \"/\"\"/" stroke.scene.yaml > other.yaml
    echo "by $by" | sed "s/[0-9]*\.99/same/; s/0\.same/same/"
    rasp render -q other.yaml 2>&1 | sed "s/this is rasp [0-9.]*/this is rasp N/"
    cmp other.wav stroke.wav
done

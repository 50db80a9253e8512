# An effective scene says which version wrote it; one of other sounds that renders it says so.
rasp new stroke -o stroke.yaml
rasp render -q stroke.yaml
own=$(rasp --version)
grep written_by stroke.scene.yaml | sed "s/$own/THIS/"
by() {
    sed "s/^written_by.*/$1/" stroke.scene.yaml > other.yaml
    rasp render -q other.yaml 2>&1 | sed "s/$own/THIS/"
    cmp other.wav stroke.wav
}
echo "-- of other sounds"
by 'written_by: "rasp 0.1.7"'
by 'written_by: "rasp 0.20.0"'
echo "-- of the same sounds, and by hand"
by "written_by: \"${own%.*}.99\""
by ''

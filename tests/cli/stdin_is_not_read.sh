# A loop over a list keeps its list: no command reads stdin.
rasp new -o a.yaml
printf 'a.yaml\na.yaml\na.yaml\n' | while read -r scene; do
    rasp check "$scene"
    rasp explain "$scene" > /dev/null
    rasp new > /dev/null
    rasp help > /dev/null
done

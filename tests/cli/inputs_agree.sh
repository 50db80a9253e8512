# plan, check and render refuse the same inputs with the same words: what is missing or cannot be read with 66, what is broken with 65; each key that names a
# file, at the first contact and at the second, which tells its whole name.
COMMANDS=(check plan "render --quiet -o out/")
# agree SCENE [OPTION]...: what the three say, once if it is the same.
agree()
{
    local k said=
    for k in "${COMMANDS[@]}"; do
        local code=0 now
        # shellcheck disable=SC2086
        now=$(rasp $k "$@" 2>&1 > /dev/null) || code=$?
        now="$code ${now//rasp ${k%% *}/rasp}"
        [ "$now" = "$said" ] || echo "$now" | cut -c 1-220
        said=$now
    done
}
cat > part.csv << 'END'
# poles: shared
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
a,0,0,1,500,20,1,0
END
echo 'this is none' > broken
cp broken broken.csv
cp broken broken.npy
rod() { printf -- '- name: %s\n  motion: {%s}\n  surface: {%s}\n%s\n' "$@"; }
LINE='path: line, from: [0, 0], to: [1 cm, 0], duration: 0.1 s'
ROUGH='roughness: {rms: 1 um}, response: part.csv'
SCRAPE='  scraper: {mass: 10 g}
  load: {constant: 1 N}'
# second MOTION SURFACE REST: a scene whose second contact is so.
second() { { printf 'rasp: 1\ncontacts:\n'; rod one "$LINE" "$ROUGH" "$SCRAPE"; rod two "$@"; } > two.yaml; }
# single MOTION SURFACE REST: a scene of one contact.
single() { { echo 'rasp: 1'; rod one "$@" | sed -e 1d -e 's/^  //'; } > one.yaml; }
# of KEY MOTION SURFACE REST: FILE in them is missing, then broken.
of()
{
    local file
    echo "== $1"
    shift
    for file in none.csv broken.csv; do
        second "${@//FILE/$file}"
        agree two.yaml
    done
    single "${@//FILE/none.csv}"
    agree one.yaml
}
of surface.response "$LINE" 'roughness: {rms: 1 um}, response: FILE' "$SCRAPE"
of surface.recipe "$LINE" 'recipe: FILE, response: part.csv' "$SCRAPE"
of surface.height_map "$LINE" 'height_map: FILE, response: part.csv' "$SCRAPE"
of surface.roughness.like "$LINE" 'roughness: {like: FILE}, response: part.csv' "$SCRAPE"
of motion.file 'path: recorded, file: FILE' "$ROUGH" "$SCRAPE"
of motion.profile 'path: line, from: [0, 0], to: [1 cm, 0], law: given, profile: FILE' "$ROUGH" "$SCRAPE"
of load.recorded "$LINE" "$ROUGH" '  scraper: {mass: 10 g}
  load: {recorded: FILE}'
of scraper.response "$LINE" 'roughness: {rms: 1 um}' '  scraper: {mass: 10 g, response: FILE}'
of contact.given.file 'path: still, duration: 0.1 s' 'response: part.csv' '  contact: {model: given, given: {file: FILE}}'
of contact.impacts.interval.table "$LINE" 'response: part.csv' '  contact: {model: impacts, impacts: {prototype: roll, interval: {distribution: table, table: FILE}}}'
of contact.impacts.space.walk "$LINE" 'response: part.csv' '  contact: {model: impacts, impacts: {prototype: space, space: {walk: FILE}}}'

echo "== recorded responses"
second "$LINE" 'roughness: {rms: 1 um}, response: none.npy' "$SCRAPE"
agree two.yaml
second "$LINE" 'roughness: {rms: 1 um}, response: broken.npy' "$SCRAPE"
agree two.yaml

echo "== pinned"
second "$LINE" "$ROUGH" "$SCRAPE"
printf 'inputs:\n- {file: part.csv, sha256: %064d}\n- {file: gone.csv}\n' 0 >> two.yaml
agree two.yaml
sed -i '$d' two.yaml
agree two.yaml 2>&1 | sed 's/[0-9a-f]\{64\}/SHA256/g'

echo "== nothing to render"
single "$LINE" "$ROUGH" "$SCRAPE"
agree --set gain=0 one.yaml
second 'path: recorded, file: broken.csv' "$ROUGH" "$SCRAPE
  gain: 0"
agree two.yaml
echo "== what does not go together"
sed 's/velocity/displacement/' part.csv > other.csv
second "$LINE" 'roughness: {rms: 1 um}, response: other.csv' "$SCRAPE"
agree two.yaml
second "$LINE" "$ROUGH" "$SCRAPE"
agree two.yaml --set output.level.dbfs_at_1_pa=-20
echo "== good"
single "$LINE" "$ROUGH" "$SCRAPE"
agree one.yaml
true

# Heights in the wrong unit by 1000 are warned of wherever a map is read, in the words of rasp surface info, and an ordinary map is not.
rasp surface convert -q "$ROOT/surfaces/basswood.gsf" profile.npy
info() { rasp surface info --pitch 10um "$@" profile.npy | grep -oE 'an rms (height|slope) of .*(polished glass|steeper than any scraped surface|gravel)' || echo "nothing"; }
cat > a.yaml << 'YAML'
rasp: 1
surface: {height_map: profile.npy, pitch: 10 um, off_map: mirror, response: modes.csv}
scraper: {mass: 10 g}
motion: {path: line, to: [1 cm, 0], speed: 20 cm/s}
output: {sample_rate: 8 kHz, tail: 50 ms}
YAML
printf '%s\n' '# poles: shared' '# quantity: velocity' place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad a,0,0,1,1000,60,1,0 > modes.csv
printf '%s\n' 'rasp-design: 1' 'base: a.yaml' 'factors: {motion.speed: [10 cm/s, 20 cm/s]}' > set.yaml
told() { grep -oE '(^|[a-z_.: ]*: )an rms (height|slope) of .*(polished glass|steeper than any scraped surface|gravel)' | sed 's/.*an rms/an rms/' | sort -u; }
for scale in 1 200 1e-4; do
    echo "-- heights $scale times as large"
    info --height-scale "$scale m"
    for call in 'render -q -o out.wav' plan check; do
        echo "$call:"
        # shellcheck disable=SC2086
        rasp $call a.yaml --set "surface.height_scale=$scale m" 2>&1 | told
    done
    sed "s/pitch: 10 um/height_scale: $scale m, &/" a.yaml > b.yaml
    sed 's/a.yaml/b.yaml/' set.yaml > b_set.yaml
    echo "batch, dry and wet:"
    rasp batch b_set.yaml --dry-run 2>&1 | told
    rasp batch b_set.yaml -o "set$scale" -q 2>&1 | told
done

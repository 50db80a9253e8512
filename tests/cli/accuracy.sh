# The table of rasp accuracy: its columns and facts that hold whatever presets and machine are; sounds of several contacts and channels, no sound at all, and one that diverges.
mkdir tmp
export TMPDIR=$PWD/tmp
BAR='material: steel, object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 1 cm}'
cat > scene.yaml <<YAML
rasp: 1
surface: {roughness: {rms: 5 um}, $BAR}
scraper: {mass: 20 g}
motion: {path: line, from: [1 cm, 0], to: [5 cm, 0], duration: 0.1 s}
output: {sample_rate: 16 kHz, tail: 0.05 s, level: {rms: -30 dB}}
YAML
cat > two.yaml <<YAML
rasp: 1
contacts:
  - {name: a, surface: {roughness: {rms: 5 um}, $BAR}, scraper: {mass: 20 g}, motion: {path: line, to: [2 cm, 0], duration: 50 ms}}
  - {name: b, surface: {roughness: {rms: 5 um}, $BAR}, scraper: {mass: 20 g, radius: 1 mm}, motion: {path: line, to: [1 mm, 0], duration: 50 ms}, start: 20 ms}
output: {sample_rate: 16 kHz, tail: 0.05 s, listen: {places: [[10 cm, 0, 10 cm], [30 cm, 0, 10 cm]], radiator: monopole}}
YAML
cat > force.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], duration: 0.1 s}
output: {diagnostics: {rate: 1 kHz}}
YAML

# facts FILE: of a table that is CSV
facts() {
    awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { name = $1; snr = $at["snr_db"] == "inf" ? 1e9 : $at["snr_db"] + 0; alone = $at["alone_snr_db"] == "inf" ? 1e9 : $at["alone_snr_db"] + 0 }
        name != last { names = names " " name }
        name == "preset" && last == name && snr < before { print "worse than the preset before it: " $0 }
        name == "preset" { scene += $3 }
        name == "preset" && $2 == "reference" && snr != 1e9 { print "the reference differs from itself: " $0 }
        $at["cpu_s"] <= 0 || $at["peak_bytes"] < 1e6 || $at["exit_code"] != 0 { print "no cost: " $0 }
        name != "preset" && last != name { knobs++ }
        name != "preset" && alone == 1e9 { same[name] = 1 }
        { d = $at["cpu_s"] * $at["real_time_factor"]; if (!length_s) length_s = d; if (d < length_s * 0.999 || d > length_s * 1.001) print "lengths differ: " $0 }
        { front += $at["front"]; before = snr; last = name; rows[name]++ }
        END {
            print FILENAME ":" names
            for (name in same) got++
            printf "%d columns, presets %d, the scene is %d of them, each knob has a value with nothing alone: %s, front: %s\n",
                NF, rows["preset"], scene, (got == knobs ? "yes" : "no"), (front > 0 ? "yes" : "no")
        }' "$1"
}

rasp accuracy scene.yaml --runs 2 --values oversampling=2,3 --csv a.csv > table
head -n 1 a.csv
facts a.csv
cut -d, -f 1,2 a.csv | grep -c '^oversampling,[23]$'
# text: a row for each of the CSV's, the scene's own marked, no colour for what is no terminal
[ "$(grep -Ec '^[= ] (preset|oversampling|gain_ramp) ' table)" = $(($(wc -l < a.csv) - 1)) ]
grep -q '^= preset standard' table
! grep -q $'\033' table
# errors are of sounds, whatever the level
rasp accuracy scene.yaml --runs 1 --set 'output.level.rms=-40 dB' --csv b.csv > /dev/null
awk -F, 'NR == FNR { if ($1 == "preset") snr[$2] = $11; next } $1 == "preset" && $2 != "reference" && ($11 - snr[$2])^2 > 1e-6 { print "the level counts: " $0 }' a.csv b.csv
rasp accuracy two.yaml --runs 1 --csv two.csv > table
facts two.csv
grep -o '2 channels; turned by.*' table
rasp accuracy force.yaml --runs 1 --csv force.csv > table
facts force.csv
grep -o 'no sound, so its contact force' table
rasp accuracy force.yaml --runs 1 --json > force.json
grep -Ec '"setting": "(preset|oversampling)"' force.json > n && [ "$(cat n)" = $(($(wc -l < force.csv) - 1)) ]
grep -o '"compared": "force"' force.json
rasp accuracy force.yaml --presets --runs 1 --set accuracy.oversampling=3 --csv few.csv > table
cut -d, -f 1-3 few.csv
ls tmp

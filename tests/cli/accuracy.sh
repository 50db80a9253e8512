# The table of rasp accuracy: its columns and facts that hold whatever presets and machine are: asked errors are measured to be met, what cannot be had says why; several contacts and channels, no sound at all, an excerpt, single knobs only where asked for.
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
  - {name: a, surface: {roughness: {rms: 5 um}, $BAR}, scraper: {mass: 20 g}, motion: {path: line, to: [2 cm, 0], duration: 0.2 s}}
  - {name: b, surface: {roughness: {rms: 5 um}, $BAR}, scraper: {mass: 20 g, radius: 1 mm}, motion: {path: line, to: [2 mm, 0], duration: 0.1 s}, start: 20 ms}
output: {sample_rate: 16 kHz, tail: 0.05 s, level: {lufs: -30}, listen: {places: [[10 cm, 0, 10 cm], [30 cm, 0, 10 cm]], radiator: monopole}}
YAML
cat > force.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}}
scraper: {mass: 20 g}
motion: {path: line, to: [5 cm, 0], duration: 0.1 s}
output: {diagnostics: {rate: 1 kHz}}
YAML

# facts FILE: of a table that is CSV. Asked errors are met by what was predicted and by what was measured, where the reference can tell.
facts() {
    awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { name = $1; snr = $at["snr_db"] == "inf" ? 1e9 : $at["snr_db"] + 0 }
        name != last { names = names " " name; before = -1e9 }
        (name == "preset" || name == "asked") && snr < before - 3 { print "worse than the row before it: " $0 }
        { scene += $3 }
        name == "asked" && $at["exit_code"] == 0 && ($at["predicted_db"] > $2 || (!$at["below_reference"] && -snr > $2)) { print "not kept: " $0 }
        name == "asked" && !($at["choosing_s"] > 0) { print "chosen in no time: " $0 }
        name == "preset" && $2 == "reference" && snr < 60 { print "the reference differs from itself: " $0 }
        $at["cpu_s"] <= 0 || $at["peak_bytes"] < 1e6 || $at["exit_code"] != 0 { print "no cost: " $0 }
        $at["cpu_from_s"] > $at["cpu_s"] || $at["cpu_s"] > $at["cpu_to_s"] { print "no interval: " $0 }
        { d = $at["cpu_s"] * $at["real_time_factor"]; if (!length_s) length_s = d; if (d < length_s * 0.999 || d > length_s * 1.001) print "lengths differ: " $0 }
        { front += $at["front"]; before = snr; last = name; rows[name]++ }
        END {
            print FILENAME ":" names
            printf "%d columns, asked %d, presets %d, the scene is one of them: %s, front: %s\n",
                NF, rows["asked"], rows["preset"], (scene > 0 ? "yes" : "no"), (front > 0 ? "yes" : "no")
        }' "$1"
}

rasp accuracy scene.yaml --runs 2 --errors=-40,-100,-60,-60 --csv a.csv > table
head -n 1 a.csv
facts a.csv
# text: a row for each of the CSV's, the scene's own marked, no colour for what is no terminal
[ "$(grep -Ec '^[= ] (asked|preset) ' table)" = $(($(wc -l < a.csv) - 1)) ]
grep -q '^= preset standard' table
! grep -q $'\033' table
# single knobs, where they are asked for: coarse to fine, each with its own error beside that of all
rasp accuracy scene.yaml --runs 1 --errors=-40 --values oversampling=2,3 --csv knobs.csv > /dev/null
facts knobs.csv
awk -F, '$1 == "oversampling" { printf " %s", $2 } END { print "" }' knobs.csv
# errors are of sounds, whatever the level
rasp accuracy scene.yaml --runs 1 --errors=-40 --set 'output.level.rms=-40 dB' --csv b.csv > /dev/null
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } NR == FNR { if ($1 == "preset") snr[$2] = $at["snr_db"]; next } $1 == "preset" && $2 != "reference" && ($at["snr_db"] - snr[$2])^2 > 1e-4 { print "the level counts: " $0 }' a.csv b.csv
# an excerpt of several contacts, of a sound that is then too short for its loudness
rasp accuracy two.yaml --runs 1 --errors=-40 --excerpt=0.05s --csv two.csv > table
facts two.csv
grep -o '2 channels; turned by.*' table
grep -o 'An excerpt: .*' table
# it is the beginning of the whole
rasp render scene.yaml -q -o whole.wav --set output.level.rms=null --set output.level.full_scale=1 --set output.encoding=float64 --set output.ramp=0
rasp render scene.yaml -q -o part.wav --set output.level.rms=null --set output.level.full_scale=1 --set output.encoding=float64 --set output.ramp=0 --set motion.until=50ms
[ "$(stat -c %s part.wav)" -lt "$(stat -c %s whole.wav)" ] && cmp <(head -c 5000 whole.wav | tail -c +200) <(head -c 5000 part.wav | tail -c +200) && echo "an excerpt is the whole's beginning"
rasp accuracy force.yaml --runs 1 --errors=-40 --csv force.csv > table
facts force.csv
grep -o 'no sound, so its contact force' table
rasp accuracy force.yaml --runs 1 --errors=-40 --json > force.json
grep -Ec '"setting": "(asked|preset)"' force.json > n && [ "$(cat n)" = $(($(wc -l < force.csv) - 1)) ]
grep -o '"compared": "force"' force.json
# the scene has knobs of its own; what cannot be had says why, and so do all that are finer
rasp accuracy force.yaml --runs 1 --errors=-40,-200,-220 --set accuracy.oversampling=3 --csv few.csv > table
cut -d, -f 1-3 few.csv
grep -o '^  asked -200 dB  *cannot be promised' table
grep -o '^  asked -220 dB  *nor this' table
# progress and an estimate, on a terminal alone
if command -v script > /dev/null; then
    TERM=xterm CI='' script -qec 'rasp accuracy force.yaml --runs 1 --errors=-40 2>&1 > /dev/null' /dev/null < /dev/null > terminal
    grep -qE 'about [0-9]+ s: 1 asked errors, 4 presets, 1 runs' terminal || echo "no estimate: $(cat terminal)"
    grep -qE '\[ *[0-9]+/[0-9]+\] (asked|preset|the ref)' terminal || echo "no progress: $(cat terminal)"
fi
rasp accuracy force.yaml --runs 1 --errors=-40 > /dev/null
ls tmp

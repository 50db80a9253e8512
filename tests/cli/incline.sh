# Free motion on a slope: up and back down, down from rest, friction to rest for good, as the table tells it; and what people get wrong.
cat > a.yaml << 'END'
rasp: 1
surface: {roughness: {}}
scraper: {mass: 20 g}
motion: {path: incline, to: [1 m, 0], incline: 5 deg, start_speed: 0.5}
output: {diagnostics: {rate: 4, columns: [time_s, stroke_m, velocity_m_per_s, speed_m_per_s, acceleration_m_per_s2, normal_force_n]}}
END
table() { rasp render -q "$@" -o a.wav a.yaml; cat a.csv; }
table
table --set motion.rolling_friction=0.05
table --set motion.incline=-5deg --set motion.start_speed=0
table --set motion.incline=0 --set motion.rolling_friction=0.06 --set motion.duration=1.5s
try() { { rasp check "$@" a.yaml 2>&1 || true; } | grep -E "^--set|help"; }
try --set motion.start_speed=0
try --set motion.start_speed=0 --set motion.incline=-1deg --set motion.rolling_friction=0.1
try --set motion.duration=2s
try --set motion.duration=1.5s --set motion.start_speed=2
try --set motion.law=constant
try --set grip={}
# the force while it turns round, and while it rests
rasp render -q --set motion.rolling_friction=0.05 --set motion.duration=1s --set output.diagnostics.columns='[speed_m_per_s, force_rms_n]' \
    --set output.diagnostics.rate=10 --set load.release=0 -o a.wav a.yaml
awk -F, 'NR > 1 { if ($2 !~ /^[0-9.e+-]+$/) print "not a number: " $0; if ($2 + 0 > 0) moved++ } END { print moved, "rows with a force" }' a.csv
rasp render -q --set motion.incline=0 --set motion.rolling_friction=0.06 --set motion.duration=1.5s \
    --set output.diagnostics.columns='[time_s, force_rms_n]' --set output.diagnostics.rate=10 -o a.wav a.yaml
awk -F, 'NR > 1 && $1 > 1 { rest += $2 } NR > 1 && $1 < 0.8 { way += $2 > 0 } END { print "at rest:", rest, "N; on its way:", way, "rows with a force" }' a.csv

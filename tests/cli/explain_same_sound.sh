# Rendering the effective scene gives the same bytes.
rasp new grip -o a.yaml
rasp explain --set motion.duration=0.3 --set surface.response="$ROOT/irs/basswood_plank.csv" --set surface.extrapolate=nearest a.yaml > b.yaml
rasp render --set motion.duration=0.3 --set surface.response="$ROOT/irs/basswood_plank.csv" --set surface.extrapolate=nearest a.yaml > /dev/null
rasp render b.yaml > /dev/null
cmp a.wav b.wav
cmp a.csv b.csv

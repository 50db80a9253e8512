# A node is dropped by its own decay: where the fast place of a mode is over before the sound, nothing is exact any more, whatever its slow place does.
cat > uneven.csv <<'CSV'
# poles: separate
# quantity: displacement
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
0,0,0,0,900,0.2,1,0
0,0,0,1,1900,40,1,0
1,1,0,0,900.5,30,1,0
1,1,0,1,1899,0.3,1,0
CSV
cat > scene.yaml <<'YAML'
rasp: 1
surface: {roughness: {rms: 5 um}, response: uneven.csv, moving: launch, convolution: resonators}
scraper: {mass: 20 g}
motion: {path: line, from: [0, 0], to: [1, 0], duration: 0.05}
accuracy: {overlap_order: 1, morph_error: -40}
output: {sample_rate: 8000, encoding: float64, level: {full_scale: 1}, tail: 8}
YAML
told() { grep -Eo '"(exact|predicted_error_db)[^,}]*' scene.json; }
rasp render -q scene.yaml
told
echo "-- of one decay, too slow to be dropped, all hops at one frame are exact"
sed -i 's/,40,/,0.3,/; s/,30,/,0.2,/' uneven.csv
rasp render -q scene.yaml
told

# Values that are drawn: the same whatever the order, the shards and the number of samples; label, scene and column are one number. Cells of a table.
. "$ROOT/tests/cli/batch-make.inc"
cat > drawn.yaml << 'EOF'
rasp-design: 1
base: tiny.yaml
factors:
  material: [{label: light}, {label: low, set: {surface.response: low.csv}}]
  motion.duration: {uniform: [50 ms, 100 ms]}
  scraper.mass: {normal: [10 g, 3 g], within: [5 g, 20 g]}
  load.constant: {log_uniform: [0.1 N, 10 N]}
  contact.force: {choose: [paper, directional]}
samples: 3
level: {common: {full_scale: 1}}
length: 100 ms
EOF
rasp batch drawn.yaml --dry-run
rasp batch drawn.yaml -o one -q
columns one/manifest.csv stimulus_id material motion_duration_ms scraper_mass_g load_constant_n contact_force sample
grep -h 'constant\|mass' one/light/s000002.scene.yaml
python3 -c 'import json; d = json.load(open("one/manifest.json")); print(d["load_constant_n"], d["contact_force"]["Levels"])'
python3 -c 'import json; print(*([r[k] for k in ("material", "load_constant_n", "sample", "split", "seed", "status", "error")] for r in map(json.loads, open("one/manifest.jsonl"))), sep="\n")'
# Five samples, in another order, in three shards: the three that were there are the same sounds.
sed 's/^samples.*/samples: 5/; $a order: {seed: 3}' drawn.yaml > five.yaml
for i in 1 2 3; do rasp batch five.yaml -o five -q --shard "$i/3"; done
rasp batch five.yaml -o five -q
diff <(grep 'wav$' one/SHA256SUMS | sort) <(grep 's00000[123].wav$' five/SHA256SUMS | sort) && echo "as before"
# The same samples as rows of a table.
columns one/manifest.csv motion_duration_ms scraper_mass_g load_constant_n contact_force material |
    awk 'BEGIN { print "motion.duration,scraper.mass,load.constant,contact.force,material" } { print $1 " ms," $3 " g," $5 " N," $7 "," $9 }' > rows.csv
cat > table.yaml << 'EOF'
rasp-design: 1
base: tiny.yaml
factors:
  material: [{label: light}, {label: low, set: {surface.response: low.csv}}]
  motion.duration: cells
  scraper.mass: cells
  load.constant: cells
  contact.force: cells
cells: rows.csv
name: "{cell}"
level: {common: {full_scale: 1}}
length: 100 ms
EOF
rasp batch table.yaml -o table -q
columns table/manifest.csv stimulus_id motion_duration_ms scraper_mass_g load_constant_n contact_force
# What is wrong is told with its line; of a scene, too, in the table.
sed -i '3s/ g,/ s,/; 4s/ ms/ us/; 5s/low/dark/' rows.csv
rasp check table.yaml || echo "$?"
sed -i '3s/ s,/ g,/; 4s/ us/ ms/' rows.csv
rasp check table.yaml || echo "$?"
sed 's/50 ms/50 N/; s/0.1 N/-0.1 N/; s/3 g/-3 g/; s/^samples.*/samples: many/' drawn.yaml > wrong.yaml
rasp check wrong.yaml || echo "$?"
{ printf 'rasp-design: 1\nbase: tiny.yaml\nfactors: {motion.duration: [100 ms], load.constant: [1 N]}\ncells:\n'; printf '  - {motion.duration: 100 ms, load.constant: 1 N} # %d\n' {1..40000}; } > long.yaml
rasp check long.yaml || echo "$?"

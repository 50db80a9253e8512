# scripts/rasp.py: scenes from dictionaries, sweeps, sets, tables, and errors with their places.
command -v python3 > /dev/null || { echo "python3 is not installed: skipped"; exit 0; }
cat > own.py << 'END'
import sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import rasp

scene = {"surface": {"roughness": {"rms": "4 um"}, "material": "oak",
                     "object": {"shape": "plate", "length": "16 cm", "width": "10 cm", "thickness": "1.2 mm"}},
         "scraper": {"mass": "20 g"}, "motion": {"path": "line", "from": ["1 cm", "5 cm"], "to": ["9 cm", "5 cm"], "duration": "0.2 s"},
         "output": {"tail": "0.1 s", "diagnostics": {"rate": "100 Hz"}}}
sound = rasp.render(scene, "one.wav", seed=3)
print(sound["duration_s"], sound["sample_rate_hz"], [f["name"] for f in sound["files"]])
rows = rasp.table("one.csv")
print(len(rows), rows[0]["time_s"], type(rows[3]["force_peak_n"]).__name__)
swept = list(rasp.sweep(scene, "swept", {"surface.material": ["oak", "glass"], "motion.duration": ["0.2 s", "0.1 s"]}))
print([s["name"] for s in swept], sorted(s["duration_s"] for s in swept)[0])
print(rasp.render("swept/oak_0.2s.scene.yaml", "again.wav")["sound"]["rms"] == swept[0]["sound"]["rms"])
print([(m["stimulus_id"], m["surface_material"], m["status"]) for m in rasp.batch({"base": "swept/oak_0.2s.scene.yaml", "factors": {"surface.material": ["steel", "pvc"]}}, "set")])
for wrong in ({**scene, "scraper": {"mass": "20 xx"}}, "none.yaml"):
    try:
        rasp.render(wrong, "two.wav")
    except rasp.RaspError as e:
        print(e.code, e, e.errors[0]["line"], e.errors[0]["help"])
END
python3 own.py "$ROOT/scripts"
echo "-- from a shell"
echo '{"surface": {"roughness": {"rms": "4 um"}}, "scraper": {"mass": 0.02}, "motion": {"path": "line", "from": [0, 0], "to": [0.1, 0], "duration": 0.1}, "output": {"quantity": "force"}}' > in.json
python3 "$ROOT/scripts/rasp.py" in.json s.wav | grep -c rms
echo '{"motion": 3}' > in.json
python3 "$ROOT/scripts/rasp.py" in.json s.wav || echo $?
for left in .design*; do [ ! -e "$left" ] || echo "left: $left"; done

# A rolling ball keeps the stiffness that the ground gives it, whatever an ablation takes away of the force, and a render with that number given is the same
# to the nine digits of the summary. The effective scene makes the same bytes again.
stiffness() { python3 -c 'import json, sys
def find(o):
    for k, v in (o.items() if isinstance(o, dict) else enumerate(o) if isinstance(o, list) else ()):
        if k == "stiffness": yield v
        yield from find(v)
print(*find(json.load(open(sys.argv[1]))))' "$1"; }
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
for scene in eccentric_ball roll; do
    rasp render "$ROOT/scenes/$scene.yaml" -q -o whole.wav --set output.diagnostics=null
    k=$(stiffness whole.json)
    for what in normal_force=constant nonlinearity=omitted nonlinearity=smoothed; do
        rasp render "$ROOT/scenes/$scene.yaml" -q -o less.wav --set output.diagnostics=null --set ablation.$what
        rasp render "$ROOT/scenes/$scene.yaml" -q -o given.wav --set output.diagnostics=null --set ablation.$what --set contact.roll.stiffness="$k"
        rasp render less.scene.yaml -q -o again.wav
        [ "$(stiffness less.json)" = "$k" ] && echo "$scene, $what: the same stiffness"
        rasp compare less.wav given.wav --snr 120 > log && echo "as with that stiffness given" || cat log
        cmp less.wav again.wav && cmp less.scene.yaml again.scene.yaml
        rasp compare less.wav whole.wav > log && echo "it takes nothing away"
    done
done 2>&1 | grep -v warning

# A ball of 20 t on a plate of 0.05 mm: the energy is lost in the rounding of what the plate would bend. That is told, and nothing is left behind.
cat > scene.yaml << 'SCENE'
rasp: 1
surface: {along: path, material: steel, object: {shape: plate, edges: supported, length: 1 cm, width: 1 cm, thickness: 50 um}, modes: 20}
ball: {radius: 1 cm, mass: 20000 kg, patch: 0}
motion: {path: still, at: [3 mm, 4 mm], duration: 10 ms}
contact: {model: roll_coupled, roll: {stiffness: 1e3, mu: 100}}
output: {sample_rate: 44.1 kHz, diagnostics: {}, stems: [surface]}
accuracy: {contact_steps: 1, oversampling: 1}
SCENE
code=0
rasp render scene.yaml -o out.wav 2> told || code=$?
sed -E 's/-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?/#/g' told
ls
exit $code

# A ball that nothing holds down, or that is outside of what its model is of, is told of; each ends well all the same.
cat > scene.yaml << 'SCENE'
rasp: 1
surface: {roughness: {rms: 5 um}}
ball: {radius: 1 cm, mass: 10 g}
motion: {path: line, to: [6 cm, 0], speed: 30 cm/s}
contact: {model: roll}
output: {diagnostics: {}}
SCENE
roll() {
    echo "$*" >&2
    local sets=() word
    for word; do sets+=(--set "$word"); done
    rasp render scene.yaml --quiet -o out.wav "${sets[@]}"
}
roll contact.gravity=0
roll contact.gravity=0 'ball.offset=1 mm'
roll contact.gravity=0 'ball.lobe_height=1 mm'
roll contact.model=roll_coupled contact.gravity=0 'contact.roll.stiffness=1e9 N/m^1.5'
roll contact.model=roll_coupled 'contact.roll.stiffness=1e9 N/m^1.5'
roll 'ball.lobe_height=4 mm'
roll 'ball.lobe_height=1 um' ball.lobes=40

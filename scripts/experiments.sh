#!/bin/sh
# Writes the stimuli of the papers' rolling experiments, scenes/experiments/ (or the folder given): one short scene each, by `include` of the parts beside
# it. Same bytes every time.
#     scripts/experiments.sh [FOLDER]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/scenes/experiments}
mkdir -p "$to/002_rolling/parts" "$to/000_rolling/parts"
to=$(cd "$to" && pwd)

# ------------------------------------------------------------------ papers/002, section III-B

cd "$to/002_rolling"
cat > parts/ball.yaml << 'END'
# Conan et al. 2014, section III-B: 5 s at 20 cm/s, radius 1 cm, heights of at most 0.1 um, on a surface that does not give way, under an envelope that
# comes and goes. The ground's pitch of 0.1 mm and the sample rate of 44.1 kHz are the paper's too.
# It does not state: the ball's mass (ours: steel; force over mass does not depend on it), what lies between the heights (a cubic spline), the
# envelope's law (that of a source that passes, its ends 20 dB below its middle), the seed.
rasp: 1
seed: 1
surface:
  fractal: {maximum: 0.1 um, pitch: 0.1 mm, length: 2 m}
ball: {radius: 1 cm, material: steel, patch: 0}
motion: {path: line, to: [1 m, 0], speed: 20 cm/s}
contact: {model: roll_coupled, roll: {ground: rigid}}
output: {sample_rate: 44.1 kHz, envelope: approach_recede, tail: 0}
END
cat > parts/raw.yaml << 'END'
# The force itself.
output: {quantity: force}
END
cat > parts/metal.yaml << 'END'
# Through the response of a metal object. The paper has it from its synthesizer and prints none; ours is metal in the same space of materials.
surface:
  space: {from: [-0.5, 0.866], dimension: 2, fundamental: 400 Hz}
END
for kappa in 5e7 5e9 5e11; do
    for mu in 0.1 1 10; do
        for beta in -0.5 -1; do
            for part in raw metal; do
                cat > "kappa_${kappa}_mu_${mu}_beta_${beta#-}_$part.yaml" << END
include: [parts/ball.yaml, parts/$part.yaml]
title: "kappa $kappa, mu $mu, beta $beta, $part"
surface: {fractal: {exponent: $beta}}
contact: {roll: {kappa: $kappa, mu: $mu}}
END
            done
        done
    done
done

# ------------------------------------------------------------------ papers/000, experiment 3

cd "$to/000_rolling"
cat > parts/plank.yaml << 'END'
# Agarwal et al. 2021, experiment 3: a ball of ceramic, glass or wood rolls up or down a slope of ceramic, basswood or poplar. The paper prints no sizes.
# Ours: planks of 40 cm, a slope of 3 degrees, and the hollow balls of irs/, since a small solid ball of any of these rings above all hearing. Surfaces
# are the measured statistics of surfaces/, as profiles along the path. Balls of this weight touch over some 0.3 to 1 mm (Hertz); the patch of 0.2 mm
# smooths away all wavelengths below a millimetre, so that roughness below 0.1 mm is left out. Full model: both responses, the surface's by place.
rasp: 1
seed: 3
surface: {along: path, roughness: {grain: 1, shortest: 100 um}}
ball: {patch: 0.2 mm}
motion: {path: incline}
contact: {model: roll}
END
for surface in ceramic basswood poplar; do
    response=${surface}_plank
    [ $surface != ceramic ] || response=ceramic_tile
    printf 'surface: {recipe: ../../../../surfaces/%s.yaml, response: ../../../../irs/%s.csv}\n' $surface $response > parts/on_$surface.yaml
done
ball() { printf 'ball: {radius: %s, body: hollow, wall: %s, material: %s, response: ../../../../irs/%s_ball.csv}\n' "$2" "$3" "$4" "$1" > "parts/$1_ball.yaml"; }
ball ceramic '10 cm' '5 mm' ceramic
ball glass '10 cm' '4 mm' glass
ball wood '6 cm' '5 mm' poplar
echo 'motion: {from: [2 cm, 3.7 cm], to: [38 cm, 3.7 cm], incline: -3 deg, start_speed: 10 cm/s}' > parts/down.yaml
echo 'motion: {from: [2 cm, 3.7 cm], to: [38 cm, 3.7 cm], incline: 3 deg, start_speed: 50 cm/s}' > parts/up.yaml
for ball in ceramic glass wood; do
    for surface in ceramic basswood poplar; do
        for way in up down; do
            cat > "${ball}_on_${surface}_$way.yaml" << END
include: [parts/plank.yaml, parts/on_$surface.yaml, parts/${ball}_ball.yaml, parts/$way.yaml]
title: "a $ball ball rolling $way a slope of $surface"
END
        done
    done
done

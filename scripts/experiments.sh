#!/bin/sh
# Writes the stimuli of the papers' listening experiments, scenes/experiments/ (or the folder given): one short scene each, by `include` of the parts beside
# it. Same bytes every time.
#     scripts/experiments.sh [FOLDER]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/scenes/experiments}
mkdir -p "$to/002_rolling/parts" "$to/000_rolling/parts" "$to/002_controls/parts" "$to/004_continuum/parts" "$to/004_durations/parts"
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

# ------------------------------------------------------------------ papers/002, section VI-B

cd "$to/002_controls"
cat > parts/rolling.yaml << 'END'
# Conan et al. 2014, section VI-B: the controls size, velocity and roughness of the impact series; 3 s each, normalised to its greatest amplitude. The
# paper does not say what object rings: ours is metal in the space of materials.
rasp: 1
seed: 1
surface: {space: {from: [-0.5, 0.866], dimension: 2, fundamental: 400 Hz}}
motion: {path: still, duration: 3 s}
contact: {model: impacts, impacts: {prototype: roll}}
output: {sample_rate: 44.1 kHz, tail: 0, level: {peak: 0 dB}}
END
control() { # NAME SIZE VELOCITY ROUGHNESS
    cat > "$1_size_$2_velocity_$3_roughness_$4.yaml" << END
include: [parts/rolling.yaml]
title: "size $2, velocity $3, roughness $4"
contact: {impacts: {size: $2, velocity: $3, roughness: $4}}
END
}
for velocity in 0.1 0.5 1; do
    for size in 0.1 0.3 0.5 0.7 0.9; do control size $size $velocity 0.5; done
done
for size in 0.1 0.3 0.5; do
    for velocity in 0.1 0.3 0.5 0.8 1; do control velocity $size $velocity 0.75; done
done
for size in 0.1 0.5 0.9; do
    for roughness in 0 0.25 0.5 0.8 1; do control roughness $size 0.5 $roughness; done
done

# ------------------------------------------------------------------ papers/004, figure 3

cd "$to/004_continuum"
cat > parts/friction.yaml << 'END'
# Conan et al. 2014 (CMJ), figure 3: thirty sounds between rubbing and scratching, from few impacts to many. The paper prints neither densities nor
# the gesture: ours are 10 to 44100 impacts a second in even ratios, and strokes of 10 cm to and fro, whose speed the low-pass follows.
rasp: 1
seed: 1
surface: {space: {from: [1, 0], dimension: 2, fundamental: 250 Hz}}
motion: {path: back_and_forth, to: [10 cm, 0], rate: 1 Hz, duration: 2 s}
contact:
  model: impacts
  impacts: {prototype: scratch, floor: {interval: 1 us}}
  gesture: {cutoff: 10 kHz, speed: 0.3 m/s}
output: {sample_rate: 44.1 kHz}
END
awk 'BEGIN {
    for (i = 0; i < 30; i++) {
        rate = sprintf("%.4g", 10 * 4410 ^ (i / 29))
        file = sprintf("step_%02d.yaml", i + 1)
        printf "include: [parts/friction.yaml]\ntitle: \"%s impacts a second\"\ncontact: {impacts: {scratch: {interval: %.6g us}}}\n", rate, 1e6 / rate > file
        close(file)
    }
}'

# ------------------------------------------------------------------ papers/004, "Rolling Interaction"

cd "$to/004_durations"
cat > parts/rolling.yaml << 'END'
# Conan et al. 2014 (CMJ), an informal test: the same impacts with durations that depend on their amplitudes, and all of one duration, that of the mean
# amplitude. The force itself.
rasp: 1
seed: 1
motion: {path: still, duration: 3 s}
contact: {model: impacts, impacts: {prototype: roll, size: 0.5, velocity: 0.5, roughness: 0.5}}
output: {sample_rate: 44.1 kHz, tail: 0, quantity: force}
END
printf 'include: [parts/rolling.yaml]\ntitle: durations by amplitude\n' > by_amplitude.yaml
printf 'include: [parts/rolling.yaml]\ntitle: all of one duration\ncontact: {impacts: {duration: {theta: 0, zeta: 0.5342 ms}}}\n' > fixed.yaml

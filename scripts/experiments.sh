#!/bin/sh
# Writes the stimuli of the papers' listening experiments, scenes/experiments/ (or the folder given): one short scene each, by `include` of the parts beside
# it, or a design for rasp batch that crosses the parts. Same bytes every time.
#     scripts/experiments.sh [FOLDER]
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
to=${1:-$here/scenes/experiments}
mkdir -p "$to/000_scraping/parts" "$to/002_rolling/parts" "$to/000_rolling/parts" "$to/002_controls/parts" "$to/004_continuum/parts" "$to/004_durations/parts"
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

cat > "$to/002_rolling.yaml" << 'END'
# Conan et al. 2014, section III: is it rolling? The 36 stimuli of 002_rolling/ (3 kappa x 3 mu x 2 exponents, raw and through metal), each rated on five
# words; 17 listeners. Six others come first, for training: the paper does not say which, ours have another mu. Peaks are alike, as in
# those scenes: a raw force has the ball's weight in it, which nobody hears, and which at the loudness of the metal would be far beyond full scale.
rasp-design: 1
title: Conan et al. 2014, how much like rolling
base: 002_rolling/parts/ball.yaml
seed: 1
factors:
  kappa: [{label: 5e7, set: {contact.roll.kappa: 5e7}}, {label: 5e9, set: {contact.roll.kappa: 5e9}}, {label: 5e11, set: {contact.roll.kappa: 5e11}}]
  mu: [{label: 0.1, set: {contact.roll.mu: 0.1}}, {label: 1, set: {contact.roll.mu: 1}}, {label: 10, set: {contact.roll.mu: 10}}, {label: 3, set: {contact.roll.mu: 3}}]
  surface: [{label: -0.5, set: {surface.fractal.exponent: -0.5}}, {label: -1, set: {surface.fractal.exponent: -1}}]
  resonator:
    - {label: raw, set: {output.quantity: force}}
    - {label: convolved, set: {surface.space: {from: [-0.5, 0.866], dimension: 2, fundamental: 400 Hz}}}
exclude: [{mu: 3, surface: -1}]
name: "kappa_{kappa}_mu_{mu}_beta_{surface}_{resonator}"
level: {each: {peak: -3 dB}}
length: own
trials:
  task: rate
  question: How much does it sound like a rolling ball?
  answers: [Not at all, A little bit, Somewhat, Close to, Exactly like rolling]
  training: [{mu: 3}]
END

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
echo 'motion: {from: [2 cm, 0 cm], to: [38 cm, 0 cm], incline: -3 deg, start_speed: 10 cm/s}' > parts/down.yaml
echo 'motion: {from: [2 cm, 0 cm], to: [38 cm, 0 cm], incline: 3 deg, start_speed: 50 cm/s}' > parts/up.yaml
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

# ------------------------------------------------------------------ papers/000, experiments 1 to 3, as designs

cat > "$to/000_scraping/parts/scrape.yaml" << 'END'
# Agarwal et al. 2021, experiments 1 and 2: a rod of PVC or poplar wood scrapes over basswood, poplar wood or ceramic. The full model: the normal force is that of
# a hand (equations 8 and 9), curvature is limited by it, the surface rings by place, and the rod rings with it. The sample rate and the values of alpha, zeta, beta_1 and
# beta_2 are the paper's.
# The paper does not state: sizes, masses, angle and friction of the grip, eta, speeds, durations. Ours: planks and tile of irs/ (40 cm long), whose modes lie
# along the line y = 0 cm and count as at the nearest place of it beside; roughness of surfaces/; a rod of 25 cm held at 30 degrees, which weighs what such a
# rod does; friction 0.3, of plastic or wood on wood or a tile; eta 0.1, since the hand damps the rod.
rasp: 1
surface: {extrapolate: nearest}
scraper: {weight: 0.1}
grip: {angle: 30 deg, azimuth: 0 deg, friction: 0.3}
output: {sample_rate: 44.1 kHz}
END
# What all three have: materials of experiments 1 and 3, and the levels of the factor condition.
on() { # LABEL TEXT RECIPE RESPONSE
    printf '    - {label: %s, text: %s, set: {surface.recipe: ../../surfaces/%s.yaml, surface.response: ../../irs/%s.csv}}\n' "$1" "$2" "$3" "$4"
}
surfaces() {
    on basswood "$1" basswood basswood_plank
    on poplar 'poplar wood' poplar poplar_plank
    on ceramic ceramic ceramic ceramic_tile
}
scraping_conditions() {
    cat << 'END'
  condition:
    - {label: full, text: full model, set: {}}
    - {label: only_surface, text: only the surface's impulse response (eta = 0), set: {ablation.sound: surface}}
    - {label: constant_force, text: no variation of the normal force (without section 2.3), set: {ablation.normal_force: constant}}
    - {label: no_nonlinearity, text: no non-linearity (without section 2.2), set: {ablation.nonlinearity: omitted}}
    - {label: physical, text: "baseline: physical synthesis", set: {contact.force: paper, contact.limiter.curve: none, contact.smoothing: 0, grip: null}}
    - label: signal
      text: "baseline: signal manipulation"
      set: {contact: {model: impacts, impacts: {prototype: rub}, gesture: {}}, grip: null, scraper.mass: null, scraper.response: null, scraper.weight: null, surface.recipe: null, ablation: {response: constant, place: [13.7 cm, 0 cm]}}
    - label: noise
      text: "baseline: modulated noise"
      set: {contact: {model: impacts, impacts: {prototype: rub}, gesture: {}}, grip: null, scraper.mass: null, scraper.response: null, scraper.weight: null, surface.recipe: null, surface.response: null, surface.extrapolate: null, output.quantity: force}
END
}
# The same of both experiments on scraping, at their heads.
scraping_baselines() {
    cat << 'END'
# The paper's three baselines are its own implementations of other papers' methods, of which it says no more than this:
#   physical  Traer, Cusimano and McDermott 2019: "force derived from a surface depth map", the scraper's way "the same as the surface depth profile", equation 3
#             (which is theirs), impulse responses "cross-faded" from place to place. Here equations 2 and 3 as printed, no limiter, a hand that presses evenly, and no
#             cross-fade. These planks have the same poles everywhere: a cross-fade of the responses at their 33 places is straight lines between gains where the
#             full model has splines. Tried with a folder of 33 WAVs as surface.response: basswood's sounds change by 14 to 21 dB less than they are loud, and by
#             less than 1 dB in any third of an octave. Of a table with poles by place surface.pairing: 0 is a cross-fade.
#   signal    Conan et al. 2014 (papers/004), whole: random impacts, here those of rubbing, as both rods are soft, low-passed by the hand's speed, through
#             one response. Its object is one filter: it knows neither place nor rod.
#   noise     Thoret et al. 2014: "minimalist modulated noise"; what a listener hears is "the velocity profile of the writer's gesture" (004). Here 004's low-pass,
#             its cutoff in proportion to the speed, on white noise, and nothing that rings. Motions that share their speed over time are the same
#             samples, as they have to be.
END
}

{
    cat << 'END'
# Agarwal et al. 2021, experiment 1: the realism of scraping. 30 descriptions (2 scrapers x 3 surfaces x 5 motions), each by the seven methods of the paper: the
# full model, its three ablations and three baselines; 210 stimuli. A trial has one description, and the sounds that share it, in random order; `text` is
# what the listener reads.
END
    scraping_baselines
    cat << 'END'
#
# The motions, where the paper has names only; all of them are those of a hand on a plank of 40 cm:
#   slow    10 cm to and fro at 0.75 Hz: 15 cm/s on average, 24 at most
#   fast    the same at 2.5 Hz: 50 cm/s, 79 at most; just slow enough for the hand not to lift off (omega^2 L tan theta is 0.73 g)
#   circle  6 cm wide, 1.5 rounds a second: 28 cm/s all the time
#   short   8 cm in 0.4 s, from rest to rest: 20 cm/s, 38 at most
#   long    30 cm in 2 s, from rest to rest: 15 cm/s, 28 at most
# The rods weigh what 25 cm of 10 mm PVC and of a 12 mm dowel do. Each sound has the same loudness: without the non-linearity forces are larger by far, and it is
# not loudness that is judged. Levels are ours; so is the taking of a dowel for "poplar wood".
# The force is contact.force: directional, the default, whose formulas depart from the printed ones (src/README.md says where and why); set: {contact.force: paper} has those.
rasp-design: 1
title: Agarwal et al. 2021, experiment 1, realism of synthetic scraping sounds
base: 000_scraping/parts/scrape.yaml
seed: 1
text: "{motion} of a {scraper} on a {surface} surface."
factors:
  scraper:
    - {label: pvc, text: PVC rod, set: {scraper.mass: 27 g, scraper.response: ../../irs/pvc_rod.csv}}
    - {label: poplar, text: poplar wood rod, set: {scraper.mass: 13 g, scraper.response: ../../irs/poplar_rod.csv}}
  surface:
END
    surfaces basswood
    cat << 'END'
  motion:
    - {label: slow, text: Slow back and forth motion, set: {motion: {path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 0 cm], rate: 0.75 Hz, duration: 4 s}}}
    - {label: fast, text: Fast back and forth motion, set: {motion: {path: back_and_forth, from: [10 cm, 0 cm], to: [20 cm, 0 cm], rate: 2.5 Hz, duration: 4 s}}}
    - {label: circle, text: Circular motion, set: {motion: {path: circle, center: [15 cm, 5 cm], radius: 3 cm, turns: 6, duration: 4 s}}}
    - {label: short, text: Short single scrape, set: {motion: {path: line, from: [10 cm, 0 cm], to: [18 cm, 0 cm], duration: 0.4 s, law: minimum_jerk}}}
    - {label: long, text: Long single scrape, set: {motion: {path: line, from: [5 cm, 0 cm], to: [35 cm, 0 cm], duration: 2 s, law: minimum_jerk}}}
END
    scraping_conditions
    cat << 'END'
name: "{scraper}_on_{surface}_{motion}/{condition}"
level: {each: {lufs: -26}}
length: own
trials:
  task: rate
  question: How realistic is each of these sounds?
  within: condition
END
} > "$to/000_experiment_1.yaml"

{
    cat << 'END'
# Agarwal et al. 2021, experiment 2: which motion is heard? Five paths, each by the seven methods of experiment 1; 35 stimuli. The listener hears one
# sound and chooses one of the five texts. Back and forth and four in a line share their speed over time, and so do the line and the circle, as in
# the paper, from rest to rest all of them; sizes and durations are ours, 2 s each, and materials too (it does not say): PVC on basswood. The paper's scribble was tracked:
# give yours by motion: {path: recorded, file: ...}; this one is drawn from the seed. The paper's recordings are a condition more (40 sounds), which only they have:
#   - {label: recorded, text: a recording, of: recordings}
#   recordings: [{file: recordings/circle.wav, motion: circle, condition: recorded}]
END
    scraping_baselines
    cat << 'END'
# The force is contact.force: directional, the default, whose formulas depart from the printed ones (src/README.md says where and why); set: {contact.force: paper} has those.
rasp-design: 1
title: Agarwal et al. 2021, experiment 2, perception of motion from scraping sounds
base: 000_scraping/parts/scrape.yaml
seed: 2
text: "{motion}"
set: {scraper.mass: 27 g, scraper.response: ../../irs/pvc_rod.csv, surface.recipe: ../../surfaces/basswood.yaml, surface.response: ../../irs/basswood_plank.csv}
factors:
  motion:
    - {label: scribble, text: a scribble, set: {motion: {path: scribble, center: [20 cm, 5 cm], size: [8 cm, 6 cm], rate: 2 Hz, duration: 2 s}}}
    - {label: four_in_line, text: four scrapes in a straight line, set: {motion: {path: four_in_line, from: [8 cm, 0 cm], to: [32 cm, 0 cm], duration: 2 s}}}
    - {label: back_and_forth, text: four back-and-forth scrapes, set: {motion: {path: back_and_forth, from: [17 cm, 0 cm], to: [23 cm, 0 cm], rate: 1 Hz, duration: 2 s}}}
    - {label: line, text: a single long line, set: {motion: {path: line, from: [5.8629 cm, 0 cm], to: [34.1371 cm, 0 cm], duration: 2 s, law: minimum_jerk}}}
    - {label: circle, text: a circle, set: {motion: {path: circle, center: [20 cm, 5 cm], radius: 4.5 cm, turns: 1, duration: 2 s, law: minimum_jerk}}}
END
    scraping_conditions
    cat << 'END'
name: "{motion}/{condition}"
level: {each: {lufs: -26}}
length: own
trials:
  task: choose
  question: How was the object moved?
  answers: motion
END
} > "$to/000_experiment_2.yaml"

{
    cat << 'END'
# Agarwal et al. 2021, experiment 3: the realism of rolling. 18 descriptions (3 balls x 3 surfaces x up and down), each by the seven methods of the paper: the
# full model, four ablations and two baselines; 126 stimuli. Planks, balls and slopes are those of 000_rolling/, which has the full model as scenes. The paper's balls have their centres of mass off
# their centres, by how much it does not print: balls of this size turn once or twice at most on such planks, and 1 mm would vary the normal force by 0.3 %, so it
# is left out (set: {ball.offset: 1 mm} adds it). The constant response is that of a place between the nodal lines of the lower modes: where the ball starts, near
# the edge, the plank hardly rings. The ball follows the ground as a point does (contact.roll.follows: point), as the paper prints it: under the curve that the
# centre of so large a ball follows the limiter has nothing to do, and what is left out without it is not heard. The ground is that of the recipe, down to its
# shortest wavelength.
# The paper's two baselines are its own implementations of other papers' methods, of which it says no more than this:
#   coupled   Rath and Rocchesso 2005: a force "arising from the offset of the object's centre of mass", with "a non-linear dissipative component". Here
#             their model as Conan et al. 2014 print it (papers/002, equations 2 and 3), with the kappa and mu that its listeners rated best, over
#             the way of the ball's centre, the centre of mass 1 mm off; the force on a surface that does not give way, as in that paper's study, through one
#             response, since the model "does not take into account" where the ball is.
#   signal    Conan et al. 2014 (papers/004), whole: random impacts, those of rolling, of a large ball, through one response. It knows no ball: of three
#             on one surface the samples are the same, and the gravity of 6 m/s^2 is what the inertia of such a ball leaves of it on a slope.
# The force is contact.force: directional, the default, whose formulas depart from the printed ones (src/README.md says where and why); set: {contact.force: paper} has those.
rasp-design: 1
title: Agarwal et al. 2021, experiment 3, realism of synthetic rolling sounds
base: 000_rolling/parts/plank.yaml
seed: 3
text: "A {ball_material} ball rolled {way} a gradual incline of {surface}."
set: {output.sample_rate: 44.1 kHz, contact.roll.follows: point, ball.patch: null, surface.roughness.shortest: null}
factors:
  ball_material:
    - {label: ceramic, text: ceramic, set: {ball.radius: 10 cm, ball.body: hollow, ball.wall: 5 mm, ball.material: ceramic, ball.response: ../../irs/ceramic_ball.csv}}
    - {label: glass, text: glass, set: {ball.radius: 10 cm, ball.body: hollow, ball.wall: 4 mm, ball.material: glass, ball.response: ../../irs/glass_ball.csv}}
    - {label: wood, text: wood, set: {ball.radius: 6 cm, ball.body: hollow, ball.wall: 5 mm, ball.material: poplar, ball.response: ../../irs/wood_ball.csv}}
  surface:
END
    surfaces 'bass wood'
    cat << 'END'
  way:
    - {label: up, text: up, set: {motion.from: [2 cm, 0 cm], motion.to: [38 cm, 0 cm], motion.incline: 3 deg, motion.start_speed: 50 cm/s}}
    - {label: down, text: down, set: {motion.from: [2 cm, 0 cm], motion.to: [38 cm, 0 cm], motion.incline: -3 deg, motion.start_speed: 10 cm/s}}
  condition:
    - {label: full, text: full model, set: {}}
    - {label: only_surface, text: only the surface's impulse response, set: {ablation.sound: surface}}
    - {label: constant_response, text: a constant surface impulse response (no morphing), set: {ablation.response: constant, ablation.place: [13.7 cm, 0 cm]}}
    - {label: only_ball, text: only the ball's impulse response, set: {ablation.sound: ball}}
    - {label: no_nonlinearity, text: no non-linearity in the contact force, set: {ablation.nonlinearity: omitted}}
    - label: coupled
      text: "baseline: physics-based synthesis"
      set: {contact: {model: roll_coupled, roll: {follows: null, kappa: 5e9, mu: 1, ground: rigid}}, ball.offset: 1 mm, ablation: {response: constant, place: [13.7 cm, 0 cm]}}
    - label: signal
      text: "baseline: signal-based synthesis"
      set: {contact: {model: impacts, gravity: 6 m/s^2, roll: null, impacts: {prototype: roll, size: 0.9}}, ball: null, surface: {recipe: null, roughness: null, along: null}, ablation: {response: constant, place: [13.7 cm, 0 cm]}}
name: "{ball_material}_on_{surface}_{way}/{condition}"
level: {each: {lufs: -26}}
length: own
trials:
  task: rate
  question: How realistic is each of these sounds?
  within: condition
END
} > "$to/000_experiment_3.yaml"

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

{
    cat << 'END'
# Conan et al. 2014, section VI: do the controls act as they are called? 45 stimuli of 002_controls/: for each control three groups, in which the other two
# stand still, of five levels; 90 pairs. A session has one control, three blocks of ten pairs, and three pairs for training before them, drawn from its own;
# each order of sessions comes equally often over listeners (14 in the paper). What listeners read is ours.
rasp-design: 1
title: Conan et al. 2014, size, velocity and roughness compared
base: 002_controls/parts/rolling.yaml
seed: 1
text: "Which ball {control}?"
factors:
  control: [{label: size, text: is larger}, {label: velocity, text: is faster}, {label: roughness, text: rolls over rougher ground}]
  group: [{label: first}, {label: second}, {label: third}]
  contact.impacts.size: [0.1, 0.3, 0.5, 0.7, 0.9]
  contact.impacts.velocity: [0.1, 0.3, 0.5, 0.8, 1]
  contact.impacts.roughness: [0, 0.25, 0.5, 0.75, 0.8, 1]
cells:
END
    cell() {
        echo "  - {control: $1, group: $2, contact.impacts.size: $3, contact.impacts.velocity: $4, contact.impacts.roughness: $5}"
    }
    for size in 0.1 0.3 0.5 0.7 0.9; do
        cell size first $size 0.1 0.5
        cell size second $size 0.5 0.5
        cell size third $size 1 0.5
    done
    for velocity in 0.1 0.3 0.5 0.8 1; do
        cell velocity first 0.1 $velocity 0.75
        cell velocity second 0.3 $velocity 0.75
        cell velocity third 0.5 $velocity 0.75
    done
    for roughness in 0 0.25 0.5 0.8 1; do
        cell roughness first 0.1 0.5 $roughness
        cell roughness second 0.5 0.5 $roughness
        cell roughness third 0.9 0.5 $roughness
    done
    cat << 'END'
name: "{control}_{group}/size_{contact.impacts.size}_velocity_{contact.impacts.velocity}_roughness_{contact.impacts.roughness}"
level: scene
length: own
trials:
  task: compare
  within: [contact.impacts.size, contact.impacts.velocity, contact.impacts.roughness]
  session: control
  blocks: group
  training: 3
  answers: [A, no difference, B]
END
} > "$to/002_controls.yaml"

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

{
    cat << 'END'
# Conan et al. 2014 (CMJ), figure 3: rubbing or scratching? The thirty sounds of 004_continuum/, in random order; 35 listeners.
rasp-design: 1
title: Conan et al. 2014, from rubbing to scratching
base: 004_continuum/parts/friction.yaml
seed: 1
factors:
  contact.impacts.scratch.interval:
END
    awk 'BEGIN {
        for (i = 0; i < 30; i++) {
            printf "    - %.6g us\n", 1e6 / sprintf("%.4g", 10 * 4410 ^ (i / 29))
        }
    }'
    cat << 'END'
name: "step_{cell}"
level: {each: {lufs: -30}}
length: own
trials:
  task: choose
  question: Is this rubbing or scratching?
  answers: [rubbing, scratching]
END
} > "$to/004_continuum.yaml"

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

# ------------------------------------------------------------------ papers/003, section F

cat > "$to/003_materials.yaml" << 'END'
# Ren, Yeh, Lin 2013, section F: of which material is it? One of five answers to each of 24 clips, 8 recorded and 16 synthesised. These are the 16: a steel ball
# on five objects whose materials were fitted to strikes (scenes/*_fitted.yaml), at three speeds, and once on a smaller bowl. The paper does not say which
# clips it had, how often, how loud. Recordings are yours to give, 8 of them, as a level of condition that only they have, of one sample rate and one length:
#   condition: [{label: synthesised}, {label: recorded, of: recordings}]
#   recordings: [{file: recordings/wood_1.wav, material: wood, condition: recorded}, ...]
rasp-design: 1
title: Ren et al. 2013, which material is it?
seed: 1
factors:
  condition: [{label: synthesised}]
  material:
    - {label: wood, base: ../wood_plate_fitted.yaml}
    - {label: plastic, base: ../plastic_plate_fitted.yaml}
    - {label: metal, base: ../metal_plate_fitted.yaml}
    - {label: porcelain, base: ../porcelain_plate_fitted.yaml}
    - {label: glass, base: ../glass_bowl_fitted.yaml}
  strike:
    - {label: soft, set: {contact.strike.speed: 0.2 m/s}}
    - {label: medium, set: {contact.strike.speed: 0.8 m/s}}
    - {label: hard, set: {contact.strike.speed: 2 m/s}}
    - {label: small, set: {surface.response: ../../irs/fitted/glass_bowl_half.csv}}
exclude: [{strike: small, material: [wood, plastic, metal, porcelain]}]
name: "{material}_{strike}"
level: {each: {lufs: -28}}
length: 1.5 s
trials:
  task: choose
  question: Which material do you hear?
  answers: material
END

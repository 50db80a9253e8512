# Scenes like random ones that missed the error they asked for. Each must meet it: a mode narrower than the pilot's bins
# between lines of the force, a force that is enhanced and rings on after the motion, ramps of gains that
# share a harmonic, contacts of unlike gains, a mode on nodes where the pilot might strike.
. "$ROOT/tests/lib/test.sh"
cat > narrow.csv <<'END'
# poles: shared
# quantity: velocity
# radius_m: 0.146
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
1,0,0.15,1,1080.69677,43.4626388,0.0715211464,0
2,0.036,0.15,1,1080.69677,43.4626388,0.641205683,0
3,0.072,0.15,1,1080.69677,43.4626388,-0.620341015,-0.963289708
END
cat > narrow.yaml <<'END'
rasp: 1
output: {listen: {radiator: contact}, sample_rate: 134780}
accuracy: {error: -100 dB}
seed: 18446744073709551615
surface: {response: narrow.csv, grit: {diameter: 460 um, density: 0.572 /mm^2}, ridges: {spacing: 3.539 mm, shape: round}, gammatone: 3}
scraper: {mass: 94.4 g, radius: 3.87 mm}
load: {constant: 0.945}
motion: {path: four_in_line, law: constant, duration: 0.2, from: [17.8664 mm, 0.15], to: [18.6918 mm, 0.15]}
contact: {limiter: {curve: none}}
END
cat > enhanced.csv <<'END'
# poles: shared
# quantity: velocity
# radius_m: 0.0214
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
1,0.025,0.03,1,87.077398,113.061576,-0.577952141,-2.7489249
1,0.025,0.03,2,856.312913,55.5563882,0.121891871,0
1,0.025,0.03,3,2850.59809,7.82724377,-0.372598914,-2.57038951
1,0.025,0.03,4,5335.99641,3.26543107,-0.890129209,0
END
cat > enhanced.yaml <<'END'
rasp: 1
accuracy: {error: -63 dB}
surface: {response: enhanced.csv, roughness: {rms: 0.57 um, kurtosis: 4.78}}
ball: {radius: 2 mm, material: acrylic, body: hoop, mass: 200 g, lobe_height: 2.165 um, weight: 3.78}
contact: {model: roll, roll: {penetration: deviation, mu: 0.9 s/m, damping_ratio: 1.217}, enhance: {gain: 30, modes: 10}}
load: {approach: 0.28 ms, release: 2.2 ms}
motion: {path: line, law: constant, from: [0.0212, 0.0566], to: [0.0218, 0.0562], duration: 0.03}
END
cat > ramps.yaml <<'END'
rasp: 1
accuracy: {error: -100 dB}
surface: {space: {from: [0, -0.094], dimension_to: 1.288}, fractal: {pitch: 94.1 um, length: 25.63 cm}, along: x}
scraper: {mass: 1.2577 g}
grip: {angle: 0.39 rad}
motion: {path: polyline, duration: 0.173, points: [[-0.0391511, 0.0224885], [-0.0402678, 0.0333929]], corner: 0.042 mm}
load: {approach: 0.9 ms}
contact: {limiter: {zeta: 0.5651}}
END
cat > gains.yaml <<'END'
rasp: 1
accuracy: {error: -90 dB}
contacts:
  - name: loud
    surface: {roughness: {rms: 5 um}, material: steel, object: {shape: bar, length: 20 cm, width: 3 cm, thickness: 2 mm}}
    scraper: {mass: 20 g}
    motion: {path: line, from: [2 cm, 1 cm], to: [8 cm, 1 cm], duration: 0.1 s}
    gain: 0.001
  - name: soft
    surface: {material: steel, object: {shape: bar, length: 20 cm, width: 3 cm, thickness: 2 mm}}
    scraper: {mass: 5 g}
    contact: {model: strike, strike: {speed: 0.003 mm/s, pulse: half_sine, stiffness: 5e4 N/m}}
    motion: {path: still, at: [3 cm, 1 cm], duration: 0.1 s}
END
# A mode that lies on nodes at the middle of each third of the motion, and is most of the sound elsewhere.
{
    printf '# poles: shared\n# quantity: velocity\n# radius_m: 0.05\n'
    echo place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
    awk 'BEGIN { for (p = 0; p < 25; p++) for (m = 1; m <= 2; m++)
        printf "%d,%.6g,0,%d,%d,40,%.6g,0\n", p + 1, p / 24 * 0.12, m, m == 1 ? 80 : 17000,
            sin((m == 1 ? 1 : 6) * 3.14159265358979 * p / 24) }'
} > sixth.csv
cat > sixth.yaml <<'END'
rasp: 1
accuracy: {error: -104.5 dB}
surface: {response: sixth.csv, roughness: {rms: 5 um, longest: 10 mm}}
scraper: {mass: 5 g}
motion: {path: line, law: constant, to: [12 cm, 0], duration: 0.3}
END
[ -z "${SANITIZED:-}" ] || rm narrow.yaml enhanced.yaml ramps.yaml sixth.yaml # they would take minutes
# Enhanced, and the mode does not move where the pilot strikes; a mute contact is there for its table.
cat > node.csv <<'END'
# poles: shared
# quantity: velocity
# radius_m: 0.05
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
1,0.0,0.03,1,440,30,1,0
2,0.02,0.03,1,440,30,0,0
3,0.04,0.03,1,440,30,-1,0
END
cat > node.yaml <<'END'
rasp: 1
surface: {response: node.csv, roughness: {rms: 0.57 um}}
scraper: {mass: 20 g}
contact: {enhance: {gain: 20, modes: 10}}
motion: {path: line, law: constant, from: [0.0, 0.03], to: [0.04, 0.03], duration: 0.1}
END
rasp render node.yaml -q -o node.wav || fail 'a mode that does not move where it is struck'
sed 's/^scraper/gain: 0\noutput: {diagnostics: {}}\naccuracy: {error: -60 dB}\nscraper/' node.yaml > mute.yaml
rasp render mute.yaml -q -o mute.wav || fail 'a mute contact that is enhanced'
for name in narrow enhanced gains ramps sixth; do
    [ -e $name.yaml ] || continue
    rasp render "$name.yaml" --verify --set output.encoding=float64 --set output.level.full_scale=1e6 -o "$name.wav" \
        > said 2>&1 || fail "$name: $(grep 'accuracy' said)"
done
finish

#!/bin/sh
# A tour: renders ten scenes, and one scrape on ten solids, into out/, says what to listen for, and draws one of them.
#     scripts/demo.sh        rasp from $BUILD (default: build/ of this tree)
# One scene takes a measured profile from ../shared/data/surfaces/ when it is there, else the one that ships.
set -eu
unset CDPATH
BUILD=${BUILD:+$(cd "$BUILD" && pwd)}
cd "$(dirname "$0")/.."
rasp=${BUILD:-$PWD/build}/rasp
[ -x "$rasp" ] || { echo "demo: $rasp is not built; run make" >&2; exit 66; }
mkdir -p out

# tour SCENE WHAT [OPTION...]: renders scenes/SCENE.yaml and says what to listen for.
tour() {
    scene=$1 what=$2
    shift 2
    "$rasp" render "scenes/$scene.yaml" -o out/ --quiet "$@"
    printf '%-25s %s\n' "out/$scene.wav" "$what"
}

tour basswood_scrape "back and forth twice a second: bright where the hand presses near the torso, dull at the far end"
tour paper_force "the first second of that scrape by the paper's equations as printed, on a damped rod"
tour ceramic_stroke "one stroke, from rest to rest: it swells with the speed, and the tile rings on"
measured=../shared/data/surfaces/bass_wood.npy
if [ -f "$measured" ]; then
    tour ridged_profile "steady, at one speed and load, over basswood as it was measured ($measured)" --set title='rod drawn along a measured basswood profile' \
        --set surface.height_map="$PWD/$measured" --set 'surface.pitch=1.394068 um'
else
    tour ridged_profile "a steady buzz at 100 Hz: ridges of 0.8 mm at 8 cm/s (surfaces/ridged_plate.gsf)"
fi
tour strike "a steel ball struck on a glass plate, heard from two places: the stereo is the plate's modes and the way to each ear"
tour roll "a glass marble rolls along a plank: darker and steadier than a scrape, and the plank's modes come and go with the place"
tour marble_drop "the marble let fall: clear bounces, sooner and sooner, a rattle, then quiet rolling"
tour rolling_impacts "rolling drawn from the statistics of its impacts; a slow beat, four or five a second, as of a ball out of round"
tour action_space "a rub that becomes a roll: smooth hiss at first, then knocks that grow out of it, deeper and louder, until it rolls"
tour porcelain_scrape_fitted "a plate whose porcelain was fitted to a struck one: tones at 0.6, 1.3 and 3 to 4 kHz, and a little hiss between them, its residual"

# object NAME WHAT: the scrape of scenes/bowl_scrape.yaml on a solid of irs/.
object() {
    "$rasp" render scenes/bowl_scrape.yaml --set surface.response="$PWD/irs/$1.csv" --set title="$1, scraped back and forth" --quiet -o "out/scraped_$1.wav"
    printf '%-25s %s\n' "out/scraped_$1.wav" "$2"
}

echo "One scrape, ten solids, each meshed and solved by rasp (rasp modes compute), on the same roughness:"
object oak_plank "dry: tones near 0.3, 0.8, 1.5 and 3.3 kHz, gone as soon as the scrape ends"
object stoneware_tile "hard: 0.8 and 1.3 kHz, gone within a second"
object glass_plate "many tones from 0.2 kHz on, the strongest at 1.3 kHz; rings on, by 17 dB in 0.8 s"
object steel_bowl "2.6 kHz, and a shimmer round 8 kHz; rings on"
object ceramic_mug "2 kHz, three tones close together, and 5 kHz; dry"
object aluminium_rod "a chime: 0.5 and 2.7 kHz, far apart; long"
object steel_sphere "a hollow ball: bright, 10 kHz, nothing low"
object glass_sphere "the same of glass: 8 kHz, dry"
object oak_sphere "a solid ball: 4 kHz, hardly a pitch"
object steel_ring "nearly one tone, 1.5 kHz, with a little of 4.1 kHz; long"
for one in basswood_scrape porcelain_scrape_fitted; do
    printf '%-25s ' "out/$one.png"
    "$rasp" plot "out/$one.wav" | sed 's/^[^ ]* */what that looks like: /'
done
echo "Beside each sound: .json (level, cost), .scene.yaml (all that the scene left unsaid) and, where asked for, .csv (the forces)."

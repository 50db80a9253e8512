# An allocation fails, the n-th of a run, for n from 1 on (faults/memory.c): the program ends with 71 and says so, or does without; it never dies by a signal, leaves nothing
# half-written, holds no more blocks at its end than it should, and works when it is run again. Of many allocations the first ones are tried and then one in so many:
# evidence/memory.sh tries all, with FAULTS_MOST at least all of those whose name FAULTS_WHOLE is a pattern of.
# Long: see tests/run.sh.
. "$ROOT/tests/lib/test.sh"
MOST=${FAULTS_MOST:-60}
[ "$(nm "$BUILD/rasp" | grep -c __asan_init)" = 0 ] || skip "the address sanitizer has an allocator of its own"
"${CC:-gcc}" -O1 -Wall -Wextra -shared -fPIC -o memory.so "$ROOT/tests/faults/memory.c" || fail "tests/faults/memory.c does not compile"

cat > small.yaml << 'END'
rasp: 1
title: a small scene
surface:
  roughness: {rms: 4 um}
  object: {shape: plate, length: 20 cm, width: 10 cm, thickness: 4 mm}
  material: steel
  modes: 5
scraper: {mass: 5 g}
motion: {path: line, from: [2 cm, 2 cm], to: [4 cm, 3 cm], duration: 0.05 s}
output: {tail: 10 ms, sample_rate: 8 kHz, diagnostics: {rate: 1 kHz}, level: {peak: -3 dB}}
END
cat > design.yaml << 'END'
rasp-design: 1
base: small.yaml
seed: 1
factors: {motion.duration: [0.04 s, 0.05 s]}
level: {common: {peak: -3 dB}}
END
cp "$ROOT/irs/ceramic_tile_tap.wav" tap.wav

# each NAME VARIABLE=VALUE... COMMAND...: what is written goes to ./out.
each() {
    local most=$MOST
    ! [[ $1 =~ ${FAULTS_WHOLE:-^$} ]] || most=1000000000
    mkdir work
    env FAULTS_MOST="$most" FAULTS_OUT=out FAULTS_WORK=work LD_PRELOAD="$PWD/memory.so" "${@:2}" > log 2>&1 || { fail "$1"; cat log; }
    [ -z "${FAULTS_SHOW:-}" ] || echo "$1: $(tail -n 1 log)"
    rm -rf out work
}

each "a list of modes" rasp modes list "$ROOT/irs/steel_bowl.csv"
each "a comparison" rasp compare tap.wav tap.wav
each "a check" rasp check small.yaml
each "a check that is told as JSON" FAULTS_SAYS='{"severity": "error"' rasp check --diagnostics=json small.yaml
each "a plan" rasp plan --json small.yaml
each "a design" rasp check design.yaml
each "a render" rasp render --quiet small.yaml -o out/sound.wav
each "a render of a recorded response" rasp render --quiet small.yaml --set surface.object=null --set surface.material=null --set surface.modes=null \
    --set surface.response=tap.wav -o out/sound.wav
each "a render, all allocations from the n-th on" FAULTS_ALL=1 rasp render --quiet small.yaml -o out/sound.wav
each "a set" FAULTS_AGAIN=1 rasp batch --quiet -j2 design.yaml -o out
finish

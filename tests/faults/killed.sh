# A render that is killed leaves no half-written file, and running it again works.
. "$ROOT/tests/lib/test.sh"
scene=$(short_scene)
mkdir out.d
for delay in 0 0.002 0.005 0.01 0.02 0.04 0.08; do
    rasp render "$scene" -o out.d/sound.wav > /dev/null 2>&1 < /dev/null &
    pid=$!
    sleep $delay
    kill -KILL $pid 2> /dev/null
    wait $pid 2> /dev/null
    while read -r file; do
        case $file in
            *.wav) rasp compare "$file" "$file" > log 2>&1 || { fail "half-written after $delay s: $file"; cat log; } ;;
            */.*) fail "left behind after $delay s: $file" ;;
        esac
    done < <(find out.d -type f)
done
expect_exit 0 rasp render "$scene" -o out.d/sound.wav
finish

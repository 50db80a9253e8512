# The rows of tests/hard/list, all but those that take long; and rows that are wrong, which must fail.
. "$ROOT/tests/lib/test.sh"
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
rasp=$(command -v rasp)
"$ROOT/tests/hard/run" --rasp "$rasp" > said || fail "$(grep -v '^ok' said)"
[ "$(grep -c '^ok' said)" -ge 80 ] || fail "only $(grep -c '^ok' said) rows"
cat > wrong << 'END'
too loud | - | force | | peak < 1e-6
refused for nothing | - | force | | refused motion.path
refused for another reason | - | force | contact.smoothing=1 km | refused motion.path
as another | - | force | | like scraper.mass=40 g < -60
heavier than it is | - | ball | | mean = 0.3 +- 0.003
not a key | - | force | | loudness < 3
END
"$ROOT/tests/hard/run" --rasp "$rasp" --list wrong > said && fail "wrong rows hold"
[ "$(tail -n 1 said)" = "0 passed, 6 failed" ] || fail "$(grep '^ok' said)"
finish

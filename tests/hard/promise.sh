# accuracy.error on random scenes that nobody picked: none misses what was asked (tests/torture/promise.py; evidence/promise.md has 1000).
# Long: see tests/run.sh.
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
"$ROOT/tests/torture/promise.py" --rasp "$BUILD/rasp" --seed 28 --scenes ${PROMISE:-24} --limit 30

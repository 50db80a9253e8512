# SIGINT and SIGTERM at random moments, to every command that can take long or wait: exit code 75 within half a second, no half of what belongs together, no temporary file, no child.
# Long: see tests/run.sh.
. "$ROOT/tests/lib/test.sh"
python3 "$ROOT/tests/faults/signals.py" || fail "see above"
finish

# Every shell script passes shellcheck.
. "$ROOT/tests/lib/test.sh"
command -v shellcheck > /dev/null || skip "shellcheck is not installed"
cd "$ROOT" || exit 1
# SC2086: word lists in plain variables; SC1091: sourced files named by a variable; SC2154/SC2034: set by what is sourced or sources.
{ find .ci scripts tests evidence -type f \( -name '*.sh' -o -path .ci/run \) 2> /dev/null || true; } | sort > "$OLDPWD/scripts"
[ -s "$OLDPWD/scripts" ] || fail "shell: no scripts found"
xargs shellcheck -s bash -S warning -e SC1091,SC2086,SC2034,SC2154 < "$OLDPWD/scripts" || fail "shellcheck: see above"
finish

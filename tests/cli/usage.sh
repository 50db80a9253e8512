# No command: the usage on stderr, exit 64, nothing on stdout; commands stand in groups.
code=0
rasp > out 2> err || code=$?
echo "$code"
[ ! -s out ]
sed -n 1p err
grep -E '^[A-Z].*:$' err

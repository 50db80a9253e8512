echo right; echo "in $PWD" >&2; exit 3

echo "no such device"; exit 77

# No object fuses a multiplication with a sum: other CPUs, which do not, would give other last bits.
for object in "$BUILD"/*/*.o; do
    objdump -d "$object" | awk -v name="${object##*/}" '/^[0-9a-f]+ </ { at = $2 } /\tv?fn?m(add|sub)/ { print name ": " at ": " $0; found = 1 } END { exit found }' || bad=1
done
[ -z "${bad:-}" ]

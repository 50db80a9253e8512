# `rasp modes compute` of solids with equal frequencies: one table, byte for byte, whichever of OpenBLAS's kernels the
# environment or the CPU asks for. rasp-modes by itself takes those that are asked for: its tables agree to what is left
# of rounding once the basis of equal frequencies is fixed.
# Long: see tests/run.sh.
. "$ROOT/tests/lib/kernels.sh"
command -v python3 > /dev/null || { echo "no python3"; exit 77; }
read -r -a kinds <<< "$(kernels)"
[ ${#kinds[@]} -gt 1 ] || { echo "this CPU has one kind of kernels"; exit 77; }
last=${kinds[-1]}
# near A B: frequencies and decays to 1e-8 (nine digits), gains to what rounding of shapes leaves. A shape is rounded to
# 1.2e-7 of its greatest and may fall to either side; a gain g is the shape's square at the place, so it moves by 2.4e-7
# of sqrt(g G). G is the greatest square: of the table, since a mode that turns is greatest along the surface, unseen.
cat > near.py << 'END'
import math, sys
a, b = ([[float(c) for c in line.split(",")] for line in open(name) if line[0] not in "#p"] for name in sys.argv[1:])
most = max(abs(r[6]) for r in a)
far = [(x, y) for x, y in zip(a, b)
       if any(abs(x[k] / y[k] - 1) > 1e-8 for k in (4, 5)) or
       abs(x[6] - y[6]) > 4e-7 * math.sqrt(abs(x[6]) * most) + 1e-12 * most]
print("near" if len(a) == len(b) > 10 and not far else ("far", len(a), len(b), len(far), far[:3]))
END
for solid in ball:sphere:diameter=20cm,fineness=1 ring:ring:diameter=14cm,width=10mm,thickness=6mm,fineness=1 \
    square:plate:length=20cm,width=20cm,thickness=5mm,fineness=1 rod:rod:length=20cm,diameter=2cm; do
    name=${solid%%:*}
    words=(compute --shape "${solid#*:}" --material steel --modes 20 --top 60kHz --grid "17,17" -q -f)
    rasp modes "${words[@]}" -o "$name.csv"
    several=$(grep -v '^[#p]' "$name.csv" | cut -d , -f 4,5 | sort -u | cut -d , -f 2 | sort | uniq -d | wc -l)
    echo "$name: $several frequencies of several modes"
    OPENBLAS_CORETYPE=$last rasp modes "${words[@]}" -o asked.csv
    cmp "$name.csv" asked.csv || echo "$name: asked for $last"
    for kind in ${KINDS:-${kinds[0]} $last}; do
        OPENBLAS_CORETYPE=$kind rasp-modes "${words[@]}" -o own.csv
        far=$(python3 near.py "$name.csv" own.csv)
        [ "$far" = near ] || echo "$name: by $kind: $far"
        rm own.csv
    done
    rm asked.csv
done

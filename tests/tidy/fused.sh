# No object fuses a multiplication with a sum, but where its source writes fma(): other CPUs, which do not, would give other last bits.
# Of those that write it the compiler must not fuse more: what is compiled without its fma() has none.
fused() { objdump -d "$1" | awk -v name="$2" '/^[0-9a-f]+ </ { at = $2 } /\tv?fn?m(add|sub)/ { print name ": " at ": " $0; found = 1 } END { exit found }'; }
for object in "$BUILD"/*/*.o; do
    source=src/${object#"$BUILD"/} name=${object##*/}
    source=$ROOT/${source%.o}.c
    if [ -f "$source" ] && grep -q '[^a-z_]fma(' "$source"; then
        # shellcheck disable=SC2046
        "${CC:-gcc}" -std=c11 -D_GNU_SOURCE -ffp-contract=off -fno-math-errno -fno-tree-slp-vectorize -fopenmp-simd -O2 -include math.h '-Dfma(a,b,c)=((a)*(b)+(c))' -I"$ROOT/src" \
            $(pkg-config --cflags fftw3) -c -o without.o "$source"
        fused without.o "$name, its fma() taken as a product and a sum" || bad=1
    else
        fused "$object" "$name" || bad=1
    fi
done
[ -z "${bad:-}" ]

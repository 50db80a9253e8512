#!/bin/sh
# Writes the mode tables and the impulse response of irs/ (or of the folder given) from closed forms. Same bytes every time.
set -eu
export LC_ALL=C
here=$(dirname "$0")
to=${1:-$here/../irs}
mkdir -p "$to"

# plate NAME OBJECT SOURCE HOLDS E ratio nu G rho eta h b listen_y
plate() {
    awk -v kind=plate -v object="$2" -v source="$3" -v holds="$4" -v E="$5" -v ratio="$6" -v nu="$7" -v G="$8" -v rho="$9" \
        -v eta="${10}" -v h="${11}" -v b="${12}" -v listen_y="${13}" -v a=0.4 -v y=0.037 -v listen_x=0.117 -v steps=32 \
        -f "$here/irs.awk" > "$to/$1.csv"
}

# bar NAME OBJECT SOURCE HOLDS E rho eta d l
bar() {
    awk -v kind=bar -v object="$2" -v source="$3" -v holds="$4" -v E="$5" -v rho="$6" -v eta="$7" -v d="$8" -v l="$9" \
        -f "$here/irs.awk" > "$to/$1.csv"
}

handbook="Wood Handbook, USDA Forest Products Laboratory, FPL-GTR-190 (2010), ch. 5, at 12 % moisture"
loss="loss factor 0.01 chosen from the order of 1e-2 given for dry wood (Cremer, Heckl, Structure-Borne Sound)"
thin="thin plate, simply supported, no shear deformation (wood: frequencies of the highest modes come out too high), no radiation; \
places on the line y = 0.037 m"
slim="slender bar, free, bending in one plane, no shear deformation (frequencies of the highest modes come out too high), no radiation"

# E_L is the bending modulus of table 5-3 plus 10 % for shear, as the handbook says; density 1000 kg/m^3 x specific gravity x 1.12.
plate basswood_plank "basswood plank 0.4 m (along the grain, x) x 0.1 m x 0.01 m, flat-sawn" \
    "$handbook: E_L 11.1 GPa, E_T/E_L 0.027, G_LT/E_L 0.046, nu_LT 0.406, 414 kg/m^3; $loss" "$thin" \
    11.1e9 0.027 0.406 0.5106e9 414 0.01 0.01 0.1 0.029
plate poplar_plank "yellow-poplar plank 0.4 m (along the grain, x) x 0.1 m x 0.01 m, flat-sawn" \
    "$handbook: E_L 12.0 GPa, E_T/E_L 0.043, G_LT/E_L 0.069, nu_LT 0.392, 470 kg/m^3; $loss" "$thin" \
    12.0e9 0.043 0.392 0.828e9 470 0.01 0.01 0.1 0.029
# Isotropic: ratio 1, G = E/(2 (1 + nu)).
plate ceramic_tile "porcelain stoneware tile 0.4 m (x) x 0.2 m x 0.008 m" \
    "typical of porcelain stoneware (manufacturers give 50 to 70 GPa, 2300 to 2400 kg/m^3): E 60 GPa, nu 0.2, 2350 kg/m^3; \
loss factor 0.004 assumed" "$thin" \
    60e9 1 0.2 25e9 2350 0.004 0.008 0.2 0.071
bar pvc_rod "rigid PVC rod, 0.25 m long, 10 mm in diameter, solid" \
    "typical of rigid PVC (Ashby, Materials Selection in Mechanical Design: 2.1 to 4.1 GPa, 1300 to 1580 kg/m^3): E 3 GPa, \
1400 kg/m^3; loss factor 0.03 assumed" "$slim" 3e9 1400 0.03 0.010 0.25
bar poplar_rod "yellow-poplar dowel, 0.25 m long, 12 mm in diameter" "$handbook: E_L 12.0 GPa, 470 kg/m^3; $loss" "$slim" \
    12.0e9 470 0.01 0.012 0.25

# A tap on the tile at x = 0.15 m: 0.25 s at 48 kHz.
printf '%b' "$(awk -v place=13 -v rate=48000 -v samples=12000 -f "$here/ir_wav.awk" "$to/ceramic_tile.csv")" > "$to/ceramic_tile_tap.wav"

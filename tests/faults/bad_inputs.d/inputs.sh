# Good inputs of a case, and the tools that make them bad. Sourced by tests/faults/bad_inputs.sh; functions work in the folder they stand in.
# shellcheck shell=bash

# A scene of 0.15 s that renders with all its outputs, two mode tables, and results of an earlier render that must survive.
good_made() {
    cat > scene.yaml << 'END'
rasp: 1
title: a short stroke
surface:
  roughness: {rms: 3 um, longest: 1 mm, shortest: 40 um}
  response: modes.csv
scraper:
  mass: 10 g
  response: rod.csv
motion:
  path: line
  from: [1 cm, 0 cm]
  to: [3 cm, 0 cm]
  speed: 20 cm/s
load: {constant: 1 N}
output:
  sample_rate: 16 kHz
  tail: 0.05 s
  diagnostics: {rate: 100 Hz}
END
    cat > modes.csv << 'END'
# poles: shared
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
a,0,0,1,500,20,1,0
a,0,0,2,900,30,1,0
b,0.05,0,1,500,20,0.5,0
b,0.05,0,2,900,30,-1,0
END
    cat > rod.csv << 'END'
# poles: shared
# quantity: velocity
place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
end,0,0,1,700,40,1,0
END
    rasp render -q scene.yaml -o out.wav --set surface.roughness.rms='1 um'
}

# They are made once.
good_inputs() {
    [ -d "$TOP/good" ] || { mkdir "$TOP/good" && (cd "$TOP/good" && good_made); }
    cp "$TOP"/good/* .
}

# ------------------------------------------------------------------ text

# line N TEXT [FILE]: line N becomes TEXT, which may be several lines.
line() {
    awk -v n="$1" -v text="$2" 'NR == n { print text; next } { print }' "${3:-scene.yaml}" > edited && mv edited "${3:-scene.yaml}"
}

drop() { sed -i "$1d" "${2:-scene.yaml}"; }
add() { printf '%s\n' "$1" >> "${2:-scene.yaml}"; }
scene() { cat > scene.yaml; }
repeat() { printf "%$1s" '' | sed "s/ /$2/g"; }

# What makes a scene of several contacts out of the good one: its contact becomes an entry with this name, twice.
two_contacts() {
    local name
    {
        sed -n 1,2p scene.yaml
        echo "contacts:"
        for name; do
            echo "  - name: $name"
            sed -n 3,14p scene.yaml | sed 's/^/    /'
        done
        sed -n '15,$p' scene.yaml
    } > edited && mv edited scene.yaml
}

# ------------------------------------------------------------------ bytes

# bytes HEX...: as they are.
bytes() { printf "$(echo "$*" | sed 's/ //g; s/../\\x&/g')"; }

# le VALUE SIZE: little-endian.
le() {
    local value=$1 i
    for ((i = 0; i < $2; i++)); do
        bytes "$(printf %02x $((value & 255)))"
        value=$((value >> 8))
    done
}

# ------------------------------------------------------------------ height maps

# npy DESCR FORTRAN_ORDER SHAPE: the header of an NPY file.
npy() {
    local header="{'descr': '$1', 'fortran_order': $2, 'shape': $3, }"
    bytes 934e554d50590100
    le ${#header} 2
    printf %s "$header"
}

# ridges N: N heights of type i2, 0 and 1000 by turns.
ridges() {
    local i
    for ((i = 0; i < $1; i++)); do le $((i % 2 * 1000)) 2; done
}

# on_map FILE [KEY...]: the scene's surface is a height map; with nanometres as its unit the ridges are 1 um high.
on_map() {
    local text="  height_map: $1" key
    shift
    for key; do text="$text"$'\n'"  $key"; done
    line 4 "$text"
}
on_npy() { on_map map.npy "pitch: 10 um" "height_scale: 1 nm"; }

# gsf HEADER_LINE...: the header of a GSF file, padded as it has to be.
gsf() {
    local text="Gwyddion Simple Field 1.0" entry
    for entry; do text="$text"$'\n'"$entry"; done
    printf '%s\n' "$text"
    le 0 $((4 - (${#text} + 1) % 4))
}

# floats N: N heights of type f4, 0 and 1 um by turns.
floats() {
    local i
    for ((i = 0; i < $1; i += 2)); do bytes 00000000 bd378635; done | head -c $(($1 * 4))
}

# sdf_text POINTS PROFILES XSCALE YSCALE HEIGHTS: a text file of 16-bit micrometres.
sdf_text() {
    printf '%s\n' aISO-1.0 "NumPoints = $1" "NumProfiles = $2" "Xscale = $3" "Yscale = $4" "Zscale = 1e-6" "DataType = 5" '*'
    echo $5 | tr ' ' '\n'
    echo '*'
}

# sdf_binary POINTS PROFILES DATATYPE: the header of a binary file; pitch 2^-17 m (7.6 um) both ways, unit 2^-30 m (0.93 nm).
sdf_binary() {
    printf 'bISO-1.0somebody  010120260000010120260000'
    le "$1" 2
    le "$2" 2
    bytes 000000000000e03e 000000000000e03e 000000000000103e 000000000000f0bf 00
    le "$3" 1
    le 0 1
}

# png BITS [COLOUR_TYPE]: the head and the end of a picture of 4 x 4; the pixels are not there.
png() {
    bytes 89504e470d0a1a0a 0000000d
    { printf IHDR; bytes 00000004 00000004; le "$1" 1; le "${2:-0}" 1; bytes 000000; } > chunk
    cat chunk
    crc32 chunk
    bytes 00000000 49444154 35af061e 00000000 49454e44 ae426082
    rm chunk
}

# crc32 FILE: big-endian, as gzip has it in its trailer the other way round.
crc32() { bytes "$(gzip -c "$1" | tail -c 8 | od -An -tx1 -N4 | awk '{ print $4 $3 $2 $1 }')"; }

# ------------------------------------------------------------------ sounds

# wav RATE CHANNELS FORMAT BITS HEX...: a WAV; FORMAT is 1 (integers) or 3 (floating point).
wav() {
    local rate=$1 channels=$2 format=$3 bits=$4 size
    shift 4
    size=$(bytes "$*" | wc -c)
    printf RIFF
    le $((36 + size)) 4
    printf 'WAVEfmt '
    le 16 4
    le "$format" 2
    le "$channels" 2
    le "$rate" 4
    le $((rate * channels * bits / 8)) 4
    le $((channels * bits / 8)) 2
    le "$bits" 2
    printf data
    le "$size" 4
    bytes "$*"
}

# The surface's response is tap.wav.
on_wav() { line 5 "  response: tap.wav"; }

# ------------------------------------------------------------------ small disks

# limited KIB COMMAND...: no file may grow beyond KIB KiB.
limited() {
    (
        ulimit -f "$1"
        trap '' XFSZ
        shift
        "$@"
    )
}

# on_small_disk COMMAND...: with a file system of 8 KiB as folder disk, where it can be mounted; else no file may grow beyond 8 KiB.
# What is left on it would not be seen afterwards: that is exit code 99.
on_small_disk() {
    local code=0
    mkdir -p disk
    if [ "$(id -u)" != 0 ] || ! mount -t tmpfs -o size=8k none disk 2> /dev/null; then
        limited 8 "$@"
        return
    fi
    "$@" || code=$?
    [ -z "$(ls -A disk)" ] || code=99
    umount disk
    return $code
}

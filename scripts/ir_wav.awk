# One place of a mode table as a WAV (mono, 32-bit float), written as octal escapes for printf %b (POSIX awk; called by scripts/irs.sh):
# sample n is h(n/rate), h(t) = sum gain e^(-decay t) sin(2 pi f t + phase), cut after `length` samples.
# With burst, noise besides, of that amplitude, three quarters of which falls by e in 4 ms and the rest in 30 ms: a strike's sound that is no mode.

function byte(v) { printf "\\0%03o", v }

function little(v, bytes,    i) {
    for (i = 0; i < bytes; i++) { byte(v % 256); v = int(v / 256) }
}

function text(s,    i) {
    for (i = 1; i <= length(s); i++) printf "\\0%03o", code[substr(s, i, 1)]
}

# IEEE single, nearest, ties to even; no subnormals, no overflow.
function single(v,    sign, exponent, whole, rest) {
    if (v == 0) { little(0, 4); return }
    sign = v < 0
    if (sign) v = -v
    exponent = 127
    while (v >= 2) { v /= 2; exponent++ }
    while (v < 1) { v *= 2; exponent-- }
    v *= 8388608
    whole = int(v)
    rest = v - whole
    if (rest > 0.5 || (rest == 0.5 && whole % 2)) whole++
    if (whole == 16777216) { whole = 8388608; exponent++ }
    little((sign * 256 + exponent) * 8388608 + whole - 8388608, 4)
}

BEGIN {
    FS = ","
    two_pi = 2 * atan2(0, -1)
    letters = "RIFWAVEfmt acd"
    split("82 73 70 87 65 86 69 102 109 116 32 97 99 100", codes, " ")
    for (i = 1; i <= length(letters); i++) code[substr(letters, i, 1)] = codes[i]
}

$1 == place { f[++modes] = $5; decay[modes] = $6; gain[modes] = $7; phase[modes] = $8 }

END {
    text("RIFF"); little(50 + 4 * samples, 4); text("WAVE")
    text("fmt "); little(18, 4); little(3, 2); little(1, 2); little(rate, 4); little(4 * rate, 4); little(4, 2); little(32, 2); little(0, 2)
    text("fact"); little(4, 4); little(samples, 4)
    text("data"); little(4 * samples, 4)
    for (n = 0; n < samples; n++) {
        sum = 0
        for (k = 1; k <= modes; k++) sum += gain[k] * exp(-decay[k] * n / rate) * sin(two_pi * f[k] * n / rate + phase[k])
        if (burst) {
            seed = seed ? 16807 * seed % 2147483647 : 1
            sum += burst * (2 * seed / 2147483647 - 1) * (0.75 * exp(-n / rate / 0.004) + 0.25 * exp(-n / rate / 0.03))
        }
        single(sum)
    }
}

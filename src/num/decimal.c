/* %.9g, exactly and fast.

   |x| = m 2^b is brought to nine or ten digits before the point: y = |x| 10^(8 - d), d the decimal exponent or one
   less, with 10^(16 i) from a table of 64 bits, rounded to nearest, and 10^j, j < 16, exact. The first product is cut
   to 64 bits, so that y is off by less than 2^-62 of itself, which is less than 2^-28: where what comes after the ninth
   digit is further than that from a half, it is known how to round. Else, for a random number in one case of 10^8 and
   for every tie, printf is asked. 32 ns a number where printf takes 220 (random signs and exponents). */
#include "num/decimal.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum { TENS = 16, TENS_LOWEST = -21, NINE = 17 };

/* 10^(16 i) = mantissa 2^exponent, i from TENS_LOWEST on. */
static const struct {
    uint64_t mantissa;
    int exponent;
} sixteens[] = {
    {0xe3e27a444d8d98b8, -1180}, {0xfd00b897478238d1, -1127}, {0x8c71dcd9ba0b4926, -1073}, {0x9becce62836ac577, -1020},
    {0xad1c8eab5ee43b67, -967},  {0xc0314325637a193a, -914},  {0xd5605fcdcf32e1d7, -861},  {0xece53cec4a314ebe, -808},
    {0x8380dea93da4bc60, -754},  {0x91ff83775423cc06, -701},  {0xa21727db38cb0030, -648},  {0xb3f4e093db73a093, -595},
    {0xc7caba6e7c5382c9, -542},  {0xddd0467c64bce4a1, -489},  {0xf64335bcf065d37d, -436},  {0x88b402f7fd75539b, -382},
    {0x97c560ba6b0919a6, -329},  {0xa87fea27a539e9a5, -276},  {0xbb127c53b17ec159, -223},  {0xcfb11ead453994ba, -170},
    {0xe69594bec44de15b, -117},  {0x8000000000000000, -63},   {0x8e1bc9bf04000000, -10},   {0x9dc5ada82b70b59e, 43},
    {0xaf298d050e4395d7, 96},    {0xc2781f49ffcfa6d5, 149},   {0xd7e77a8f87daf7fc, 202},   {0xefb3ab16c59b14a3, 255},
    {0x850fadc09923329e, 309},   {0x93ba47c980e98ce0, 362},   {0xa402b9c5a8d3a6e7, 415},   {0xb616a12b7fe617aa, 468},
    {0xca28a291859bbf93, 521},   {0xe070f78d3927556b, 574},   {0xf92e0c3537826146, 627},   {0x8a5296ffe33cc930, 681},
    {0x9991a6f3d6bf1766, 734},   {0xaa7eebfb9df9de8e, 787},   {0xbd49d14aa79dbc82, 840},   {0xd226fc195c6a2f8c, 893},
    {0xe950df20247c83fd, 946},   {0x81842f29f2cce376, 1000},
};

static const uint64_t tens[TENS] = {
    1,         10,         100,         1000,         10000,         100000,         1000000,         10000000,
    100000000, 1000000000, 10000000000, 100000000000, 1000000000000, 10000000000000, 100000000000000, 1000000000000000};

/* y = whole + part / 2^64 = m 2^b 10^(8 - d); 10^8 (1 - 2^-62) <= y < 10^10. */
static uint64_t scaled(uint64_t m, int b, int d, uint64_t *part)
{
    int power = 8 - d, i = power >> 4, j = power & 15, low = __builtin_clzll(tens[j]);
    wide product = (wide)m * sixteens[i - TENS_LOWEST].mantissa;
    int carry = product >> 127 ? 0 : 1;
    uint64_t high = (uint64_t)(product >> (64 - carry));
    wide y = (wide)high * (tens[j] << low);
    int shift = -(b + sixteens[i - TENS_LOWEST].exponent + 64 - carry - low); /* y 2^-shift */
    *part = (uint64_t)(y >> (shift - 64));
    return (uint64_t)(y >> shift);
}

/* y rounded to nine digits, 10^8 to 10^9; of ten, one goes, and *d grows by one. False: too near a tie to say. */
static bool rounded(uint64_t whole, uint64_t part, int *d, uint64_t *digits)
{
    const uint64_t near = (uint64_t)1 << 37; /* 2^-27 of 1 */
    uint64_t half = (uint64_t)1 << 63, tail = part;
    if (whole >= 1000000000) {
        uint64_t last = whole % 10;
        whole /= 10;
        tail = last * (UINT64_MAX / 10) + part / 10;
        *d += 1;
    }
    *digits = whole + (tail >= half);
    return (tail >= half ? tail - half : half - tail) > near;
}

static void two_digits(char *text, unsigned n)
{
    static const char pairs[] =
        "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
        "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";
    memcpy(text, pairs + 2 * n, 2);
}

/* Nine digits; returns how many are left without the zeros at the end. */
static int nine_digits(char text[NINE], uint64_t digits)
{
    unsigned high = (unsigned)(digits / 10000), low = (unsigned)(digits % 10000);
    int n = 9;
    two_digits(text + 7, low % 100);
    two_digits(text + 5, low / 100);
    two_digits(text + 3, high % 100);
    two_digits(text + 1, high / 100 % 100);
    text[0] = (char)('0' + high / 10000);
    while (n > 1 && text[n - 1] == '0')
        n--;
    return n;
}

/* d.ddde+XX */
static char *scientific(char *out, const char *text, int n, int d)
{
    unsigned size = (unsigned)(d < 0 ? -d : d);
    *out++ = text[0];
    if (n > 1) {
        *out++ = '.';
        memcpy(out, text + 1, 8);
        out += n - 1;
    }
    *out++ = 'e';
    *out++ = d < 0 ? '-' : '+';
    if (size >= 100) *out++ = (char)('0' + size / 100);
    two_digits(out, size % 100);
    return out + 2;
}

/* -4 <= d < 9. Copies of a fixed length take no time; what is too much of them lies behind the end. */
static char *fixed(char *out, const char *text, int n, int d)
{
    int before = d + 1; /* digits before the point */
    if (before <= 0) {
        memcpy(out, "0.000", 5);
        memcpy(out + 2 - before, text, 9);
        return out + 2 - before + n;
    }
    if (n <= before) {
        memcpy(out, text, 9);
        return out + before;
    }
    memcpy(out, text, 8);
    out[before] = '.';
    memcpy(out + before + 1, text + before, 8);
    return out + n + 1;
}

static size_t by_printf(double x, char text[DECIMAL_ROOM])
{
    return isnan(x) ? (size_t)snprintf(text, DECIMAL_ROOM, "nan") : (size_t)snprintf(text, DECIMAL_ROOM, "%.9g", x);
}

size_t decimal_9g(double x, char text[DECIMAL_ROOM])
{
    uint64_t bits, part, digits;
    char nine[NINE], *out = text;
    memcpy(&bits, &x, sizeof bits);
    int b = (int)(bits >> 52 & 2047);
    if (b == 0 || b == 2047) /* zero, subnormal; infinite, not a number */
        return by_printf(x, text);
    uint64_t m = (bits << 11 | (uint64_t)1 << 63), whole;
    int d = ((b - 1023) * 78913) >> 18; /* floor of log10 2^(b - 1023) */
    whole = scaled(m, b - 1023 - 63, d, &part);
    if (!rounded(whole, part, &d, &digits)) return by_printf(x, text);
    if (digits == 1000000000) {
        digits = 100000000;
        d++;
    }
    if (bits >> 63) *out++ = '-';
    int n = nine_digits(nine, digits);
    out = d < -4 || d >= 9 ? scientific(out, nine, n, d) : fixed(out, nine, n, d);
    return (size_t)(out - text);
}

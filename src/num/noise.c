/* Philox 4x32 with 10 rounds: J. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011, from the
   authors' header (Random123). Key words are the low and high half of the stream's key; counter words those of row,
   then of column; output words pair up the same way, low half first. Normals: G. Box, M. Muller, Ann. Math. Stat. 29
   (1958) 610,

       y[2j] = sqrt(-2 log u) cos(2 pi v),  y[2j + 1] = sqrt(-2 log u) sin(2 pi v),

   u and v uniform from the two words of counter (row, j). u >= 2^-53, so |y| <= 8.58. */
#include "num/noise.h"

#include <Random123/philox.h>
#include <math.h>

#include "num/vecmath.h"

/* One step of splitmix64 (S. Vigna; the finaliser is D. Stafford's Mix13): one-to-one, every output bit depends on
 * every input bit. */
static uint64_t mix(uint64_t z)
{
    z += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

struct noise noise_make(uint64_t seed, const char *name)
{
    uint64_t h = 0xcbf29ce484222325; /* FNV-1a of the name (Fowler, Noll, Vo) */
    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 0x100000001b3;
    return (struct noise){mix(mix(seed) ^ h)};
}

void noise_bits(struct noise s, uint64_t row, uint64_t column, uint64_t out[2])
{
    philox4x32_key_t key = {{(uint32_t)s.key, (uint32_t)(s.key >> 32)}};
    philox4x32_ctr_t counter = {{(uint32_t)row, (uint32_t)(row >> 32), (uint32_t)column, (uint32_t)(column >> 32)}};
    philox4x32_ctr_t r = philox4x32_R(10, counter, key);
    out[0] = r.v[0] | (uint64_t)r.v[1] << 32;
    out[1] = r.v[2] | (uint64_t)r.v[3] << 32;
}

/* An odd multiple of 2^-53: never 0 or 1, symmetric about 1/2, and exact. */
static double uniform_of(uint64_t bits) { return (double)(bits >> 11 | 1) * 0x1p-53; }

double noise_uniform(struct noise s, uint64_t row, uint64_t column)
{
    uint64_t bits[2];
    noise_bits(s, row, column, bits);
    return uniform_of(bits[0]);
}

/* u and v of counter (row, column); v as the angle over pi. */
static void normal_draw(struct noise s, uint64_t row, uint64_t column, double *u, double *turns)
{
    uint64_t bits[2];
    noise_bits(s, row, column, bits);
    *u = uniform_of(bits[0]);
    *turns = 2 * uniform_of(bits[1]);
}

enum { PAIRS = 128 }; /* at a time */

void noise_normal(struct noise s, uint64_t row, size_t n, double *y)
{
    double u[PAIRS], turns[PAIRS], sine[PAIRS];
    for (size_t from = 0; from < n; from += 2 * PAIRS) {
        size_t some = n - from < 2 * PAIRS ? n - from : 2 * PAIRS, pairs = (some + 1) / 2;
        for (size_t i = 0; i < pairs; i++)
            normal_draw(s, row, from / 2 + i, &u[i], &turns[i]);
        vecmath_log(pairs, u, u);
        vecmath_sincospi(pairs, turns, sine, turns);
        for (size_t i = 0; i < some; i++)
            y[from + i] = sqrt(-2 * u[i / 2]) * (i % 2 ? sine : turns)[i / 2];
    }
}

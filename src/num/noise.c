/* Philox 4x32 with 10 rounds: J. Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011, from the
   authors' header (Random123). Key words are the low and high half of the stream's key; counter words those of row,
   then of column; output words pair up the same way, low half first. Normals: G. Box, M. Muller, Ann. Math. Stat. 29
   (1958) 610,

       y[2j] = sqrt(-2 log u) cos(2 pi v),  y[2j + 1] = sqrt(-2 log u) sin(2 pi v),

   u and v uniform from the two words of counter (row, j). u >= 2^-53, so |y| <= 8.58. */
#include "num/noise.h"

#include <Random123/philox.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "num/real.h"

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

#ifdef __SSE2__
/* y[0..3] from counters (row, column) and (row, column + 1): SLEEF's deterministic functions for two at a time, which
   give the bits of those for one, in half the time. */
static void normal_four(struct noise s, uint64_t row, uint64_t column, double *y)
{
    double u[2], turns[2];
    normal_draw(s, row, column, &u[0], &turns[0]);
    normal_draw(s, row, column + 1, &u[1], &turns[1]);
    __m128d angle = _mm_loadu_pd(turns),
            radius = _mm_sqrt_pd(_mm_mul_pd(_mm_set1_pd(-2), Sleef_cinz_logd2_u10sse2(_mm_loadu_pd(u))));
    __m128d x = _mm_mul_pd(radius, Sleef_cinz_cospid2_u05sse2(angle)),
            z = _mm_mul_pd(radius, Sleef_cinz_sinpid2_u05sse2(angle));
    _mm_storeu_pd(y, _mm_unpacklo_pd(x, z));
    _mm_storeu_pd(y + 2, _mm_unpackhi_pd(x, z));
}
#endif

void noise_normal(struct noise s, uint64_t row, size_t n, double *y)
{
    size_t i = 0;
#ifdef __SSE2__
    for (; i + 4 <= n; i += 4)
        normal_four(s, row, i / 2, y + i);
#endif
    for (; i < n; i += 2) {
        double u, turns;
        normal_draw(s, row, i / 2, &u, &turns);
        double radius = sqrt(-2 * real_log(u));
        y[i] = radius * real_cospi(turns);
        if (i + 1 < n) y[i + 1] = radius * real_sinpi(turns);
    }
}

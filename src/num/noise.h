/* Counter-based random numbers (Philox 4x32-10, Random123): any number of any stream is computed from its key and
   counter alone, so noise can be read at any place, in any order, from any thread. Streams are keyed by the scene's
   seed and a *name* (stage and contact): adding a stage changes no other stage's noise. */
#ifndef NUM_NOISE_H
#define NUM_NOISE_H
#include <stddef.h>
#include <stdint.h>

struct noise {
    uint64_t key;
};

/* The stream of that seed and name. Two different names or seeds give different keys (64-bit mix of FNV-1a and
 * splitmix64). */
struct noise noise_make(uint64_t seed, const char *name);

/* Two 64-bit words of 128-bit counter (row, column). */
void noise_bits(struct noise s, uint64_t row, uint64_t column, uint64_t out[2]);

/* Uniform in (0, 1): an odd multiple of 2^-53, never 0 or 1, from the first word of the counter. */
double noise_uniform(struct noise s, uint64_t row, uint64_t column);

/* n independent standard normal numbers y[i] of counters (row, i / 2), by Box-Muller on real_log, real_sinpi,
   real_cospi; |y| <= 8.58. The first n numbers of a row do not depend on n. */
void noise_normal(struct noise s, uint64_t row, size_t n, double *y);

#endif

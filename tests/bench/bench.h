/* What the timings share: the thread's time, the time stamp counter, random numbers and a hash that are the same
 * everywhere. */
#ifndef TESTS_BENCH_BENCH_H
#define TESTS_BENCH_BENCH_H
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <time.h>
#include <x86intrin.h>

static inline double bench_seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* That the thread has run. */
static inline double bench_seconds(void) { return bench_seconds_of(CLOCK_THREAD_CPUTIME_ID); }

/* Cycles of the time stamp counter in a second. */
static inline double bench_cycles_per_second(void)
{
    double from = bench_seconds_of(CLOCK_MONOTONIC), passed;
    uint64_t start = __rdtsc();
    do
        passed = bench_seconds_of(CLOCK_MONOTONIC) - from;
    while (passed < 0.1);
    return (double)(__rdtsc() - start) / passed;
}

/* Even from -1 to 1: Knuth's linear congruential generator, its upper 53 bits. */
static inline double bench_draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1;
}

/* FNV-1a over the bits of x, 64 at a time; starts from BENCH_HASH. */
#define BENCH_HASH 14695981039346656037u

static inline uint64_t bench_hash(uint64_t hash, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &x[i], sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
    }
    return hash;
}

#endif

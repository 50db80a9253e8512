/* Vector loops with the same bits on every CPU. LANES_CLONES before the definition of a hot function compiles it for
   AVX-512 (x86-64-v4), AVX2 (x86-64-v3) and any x86-64, and the loader takes the best one the CPU has. The bits agree
   because such loops use + - * / sqrt, fma() and selections only, without contraction (-ffp-contract=off), and because
   sums run over LANES accumulators in a fixed order, whatever the width of a register. fma() is an instruction in the
   two clones that AVX2 has; elsewhere the C library's, which IEEE 754 gives the same bits: slowly, some 10 cycles where
   the CPU has the instruction, hundreds where it has not. So it is written where a loop is hot and nowhere else.

       LANES_CLONES
       double dot(size_t n, const double *x, const double *y)
       {
           double sum[LANES] = {0};
           ... for (i = 0; i + LANES <= n; i += LANES)
       #pragma omp simd
                   for (int l = 0; l < LANES; l++) sum[l] += x[i + l] * y[i + l];
           ... add sum[0..7] in order, then the rest

   Nothing is cloned with clang (version 14 gives the dispatcher another name than the function, so that other files do
   not find it), nor when the instruction set is set by hand (`make ISA=v3` defines RASP_NO_CLONES), nor under the
   sanitizers, whose run time is not ready yet when the loader picks a clone. A cloned function must not be static
   inline. */
#ifndef NUM_LANES_H
#define NUM_LANES_H
#include <stdint.h>
#include <string.h>

enum { LANES = 8 }; /* doubles per group: one register of AVX-512, two of AVX2, four of SSE2 */

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__AVX2__) && !defined(RASP_NO_CLONES)
#define LANES_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LANES_CLONES
#endif

/* test ? a : b by bit masks: of the conditional operator gcc makes branches where the CPU has no masked moves, or where
   one side costs more, and does not vectorise the loop. */
static inline __attribute__((always_inline)) double lanes_select(int test, double a, double b)
{
    uint64_t mask = -(uint64_t)test, u, v;
    memcpy(&u, &a, sizeof u);
    memcpy(&v, &b, sizeof v);
    u = (u & mask) | (v & ~mask);
    memcpy(&a, &u, sizeof a);
    return a;
}

/* The order of every sum over lanes. */
static inline __attribute__((always_inline)) double lanes_total(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

/* floor(x) and ceil(x) for |x| < 2^51, by rounding to the nearest first; in clones gcc 12 leaves floor() itself a call.
 */
static inline __attribute__((always_inline)) double lanes_floor(double x)
{
    double near = x + 0x1.8p52 - 0x1.8p52;
    return near - lanes_select(near > x, 1, 0);
}

static inline __attribute__((always_inline)) double lanes_ceil(double x)
{
    double near = x + 0x1.8p52 - 0x1.8p52;
    return near + lanes_select(near < x, 1, 0);
}

#endif

/* Sampled heights for the tests of maps and profiles: random ones, their continuation by the plainest rule, and the
 * cubic B-spline that goes through them. */
#ifndef TESTS_UNIT_SAMPLES_H
#define TESTS_UNIT_SAMPLES_H
#include "scene/scene.h"
#include "unit.h"

/* Up to 1 um, by drand48. */
static inline double samples_random(void) { return 1e-6 * (drand48() + drand48() - 1); }

/* Index after stepping i times from sample 0 on, by the rule. */
static inline long samples_walked(long n, int off_map, long i)
{
    long at = 0, step = i < 0 ? -1 : 1;
    for (long k = 0; k != i; k += i < 0 ? -1 : 1) {
        if (off_map == OFF_MAP_WRAP) {
            at = at + step == n ? 0 : at + step < 0 ? n - 1 : at + step;
            continue;
        }
        if (at + step == n || at + step < 0) step = -step;
        at += step;
    }
    return at;
}

/* The cubic B-spline and its derivatives, as polynomials over |x| <= 1 and 1 <= |x| <= 2. */
static inline double samples_b_spline(double x, int derivative)
{
    double r = fabs(x), side = x < 0 ? -1 : 1;
    if (r >= 2) return 0;
    if (derivative == 0) return r < 1 ? 2.0 / 3 - r * r + r * r * r / 2 : (2 - r) * (2 - r) * (2 - r) / 6;
    if (derivative == 1) return side * (r < 1 ? -2 * r + 1.5 * r * r : -(2 - r) * (2 - r) / 2);
    return r < 1 ? 3 * r - 2 : 2 - r;
}

#endif

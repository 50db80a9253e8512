/* What the rolling curve in one coordinate costs (surface/rolling_envelope.h): fractal heights 2.5 um apart, an
   amplitude of 10 um, under discs of several radii and over rows of several lengths. One CSV row each: nanoseconds of
   the thread per height to find the arcs, arcs that are left over heights, nanoseconds per reading in rising order at
   the heights' pitch; and for the same envelope at the heights by the search of surface/envelope.h, which the plane
   needs, nanoseconds per height. Linear time: the columns do not grow with n or with the radius. */
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "surface/envelope.h"
#include "surface/rolling_envelope.h"

#define PITCH 2.5e-6

enum { LONGEST = 1 << 18, REPEATS = 3 };

static double z[LONGEST], x[LONGEST], e[LONGEST];

static void ground_make(void)
{
    uint64_t seed = 3;
    for (int octave = 0; octave < 16; octave++) {
        double from = 0, to = 0;
        for (long i = 0; i < LONGEST; i++) {
            if (i % (1 << octave) == 0) {
                from = to;
                to = 5e-6 * pow(2, 0.7 * (octave - 12)) * bench_draw(&seed);
            }
            z[i] += from + (to - from) * (double)(i % (1 << octave)) / (1 << octave);
        }
    }
}

/* Nanoseconds per height: finding, reading. */
static void crest_time(double radius, long n, double best[2])
{
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, n);
    for (int k = 0; k < REPEATS; k++) {
        double start = bench_seconds();
        rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, n, 0);
        double middle = bench_seconds();
        rolling_envelope_at(c, (size_t)n, x, e, NULL);
        best[0] = fmin(best[0], (middle - start) / (double)n * 1e9);
        best[1] = fmin(best[1], (bench_seconds() - middle) / (double)n * 1e9);
    }
    arena_close(a);
}

static double search_time(double radius, long n)
{
    struct arena *a = arena_open();
    struct envelope *s = envelope_make(a, radius, PITCH, n, 1);
    long stride;
    double *held = envelope_heights(s, &stride), start = bench_seconds(), worst = 0;
    for (long i = 0; i < n; i++)
        held[i] = z[i];
    envelope_prepare(s);
    for (long i = 0; i < n; i++)
        worst = fmax(worst, fabs(envelope_at(s, i, 0) - e[i]));
    start = bench_seconds() - start;
    arena_close(a);
    if (worst > 1e-16) printf("# the two differ by %g m\n", worst);
    return start / (double)n * 1e9;
}

int main(void)
{
    static const double radii[] = {1e-4, 1e-3, 1e-2, 0.1, 1, 10};
    ground_make();
    for (long i = 0; i < LONGEST; i++)
        x[i] = (double)i * PITCH;
    printf("radius_m,heights,find_ns,read_ns,search_ns\n");
    for (int k = 0; k < 6; k++)
        for (long n = 4096; n <= LONGEST; n *= 8) {
            double best[2] = {HUGE_VAL, HUGE_VAL};
            crest_time(radii[k], n, best);
            printf("%g,%ld,%.1f,%.1f,%.1f\n", radii[k], n, best[0], best[1], search_time(radii[k], n));
        }
    return 0;
}

/* Short-time levels, and what counts as the noise: a recording of strikes is quiet for a fiftieth of its time at least,
 * or its floor is the ringing's. */
#include "analysis/strikes_level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int rising(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double rms_about_mean(const double *x, long n)
{
    double mean = 0.0, square = 0.0;
    for (long i = 0; i < n; i++)
        mean += x[i];
    mean /= (double)n;
    for (long i = 0; i < n; i++)
        square += (x[i] - mean) * (x[i] - mean);
    return sqrt(square / (double)n);
}

struct strikes_level strikes_level(const double *x, long n, double rate, double seconds, struct arena *a)
{
    struct strikes_level l = {.frame = (long)fmax(1.0, rint(seconds * rate))};
    l.n = n / l.frame;
    l.rms = ARENA_TAKE(a, double, l.n + 1);
    for (long k = 0; k < l.n; k++)
        l.rms[k] = rms_about_mean(x + k * l.frame, l.frame);
    double *sorted = ARENA_TAKE(a, double, l.n + 1);
    memcpy(sorted, l.rms, (size_t)l.n * sizeof *sorted);
    qsort(sorted, (size_t)l.n, sizeof *sorted, rising);
    l.floor = sorted[l.n / 50];
    return l;
}

void strikes_level_quiet(const struct strikes_level *l, double most, long *from, long *to)
{
    *from = *to = 0;
    for (long k = 0, first = 0; k <= l->n; k++)
        if (k == l->n || !(l->rms[k] <= most)) {
            if ((k - first) * l->frame > *to - *from) {
                *from = first * l->frame;
                *to = k * l->frame;
            }
            first = k + 1;
        }
}

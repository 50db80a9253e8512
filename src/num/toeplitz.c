#include "num/toeplitz.h"

#include <string.h>

#include "base/arena.h"

struct work {
    double *x, *re, *im; /* [size], [size/2 + 1] */
};

/* to[n] = M from; or of the circulant's inverse. */
static void times(const struct toeplitz *t, const struct work *w, bool inverse, const double *from, double *to)
{
    memset(w->x, 0, (size_t)t->size * sizeof *w->x);
    memcpy(w->x, from, (size_t)t->n * sizeof *from);
    fft_forward(t->fft, w->x, w->re, w->im);
    for (long k = 0; k <= t->size / 2; k++) {
        double g = (inverse ? 1.0 / t->spectrum[k] : t->spectrum[k]) / (double)t->size;
        w->re[k] *= g;
        w->im[k] *= g;
    }
    fft_inverse(t->fft, w->re, w->im, w->x);
    memcpy(to, w->x, (size_t)t->n * sizeof *to);
}

/* z of a rest; returns rest z. */
static double conditioned(const struct toeplitz *t, const struct work *w, const double *rest, double *z)
{
    double sum = 0;
    if (t->preconditioned)
        times(t, w, true, rest, z);
    else
        memcpy(z, rest, (size_t)t->n * sizeof *z);
    for (long i = 0; i < t->n; i++)
        sum += rest[i] * z[i];
    return sum;
}

int toeplitz_solve(const struct toeplitz *t, const double *c, double *h)
{
    struct arena *a = arena_open();
    struct work w = {ARENA_TAKE(a, double, t->size), ARENA_TAKE(a, double, t->size / 2 + 1),
                     ARENA_TAKE(a, double, t->size / 2 + 1)};
    double *rest = ARENA_TAKE(a, double, t->n), *z = ARENA_TAKE(a, double, t->n), *way = ARENA_TAKE(a, double, t->n),
           *ahead = ARENA_TAKE(a, double, t->n), least = t->enough * conditioned(t, &w, c, z), left;
    int step = 0;
    times(t, &w, false, h, ahead);
    for (long i = 0; i < t->n; i++)
        rest[i] = c[i] - ahead[i];
    left = conditioned(t, &w, rest, z);
    memcpy(way, z, (size_t)t->n * sizeof *way);
    for (; step < t->most && left > least; step++) {
        double by = 0, was = left;
        times(t, &w, false, way, ahead);
        for (long i = 0; i < t->n; i++)
            by += way[i] * ahead[i];
        by = left / by;
        for (long i = 0; i < t->n; i++) {
            h[i] += by * way[i];
            rest[i] -= by * ahead[i];
        }
        left = conditioned(t, &w, rest, z);
        for (long i = 0; i < t->n; i++)
            way[i] = z[i] + left / was * way[i];
    }
    arena_close(a);
    return step;
}

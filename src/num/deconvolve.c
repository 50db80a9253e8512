#include "num/deconvolve.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "num/fft.h"

enum { MOST = 500 };
static const double enough = 1e-9;

struct deconvolution {
    long n, size, bins;
    struct fft *fft;
    double *x, *re, *im; /* work: [size], [bins] */
    double *f_re, *f_im; /* the force's spectrum */
    double *power;       /* [bins] |F|^2 + weak */
};

/* to[n]: of from[n], filtered by the spectrum `by` or, inverse, by 1 over it. */
static void filtered(struct deconvolution *d, const double *from, bool inverse, double *to)
{
    memset(d->x, 0, (size_t)d->size * sizeof *d->x);
    memcpy(d->x, from, (size_t)d->n * sizeof *from);
    fft_forward(d->fft, d->x, d->re, d->im);
    for (long k = 0; k < d->bins; k++) {
        double g = (inverse ? 1.0 / d->power[k] : d->power[k]) / (double)d->size;
        d->re[k] *= g;
        d->im[k] *= g;
    }
    fft_inverse(d->fft, d->re, d->im, d->x);
    memcpy(to, d->x, (size_t)d->n * sizeof *to);
}

/* to[n]: y by the conjugate of the force's spectrum. */
static void correlated(struct deconvolution *d, const double *y, double *to)
{
    memset(d->x, 0, (size_t)d->size * sizeof *d->x);
    memcpy(d->x, y, (size_t)d->n * sizeof *y);
    fft_forward(d->fft, d->x, d->re, d->im);
    for (long k = 0; k < d->bins; k++) {
        double real = (d->re[k] * d->f_re[k] + d->im[k] * d->f_im[k]) / (double)d->size;
        d->im[k] = (d->im[k] * d->f_re[k] - d->re[k] * d->f_im[k]) / (double)d->size;
        d->re[k] = real;
    }
    fft_inverse(d->fft, d->re, d->im, d->x);
    memcpy(to, d->x, (size_t)d->n * sizeof *to);
}

static double product(const double *x, const double *y, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

/* The force's spectrum, and the power that is divided by. Returns false if there is no force. */
static bool force(struct deconvolution *d, const double *f, long m, double limit)
{
    double most = 0.0;
    memset(d->x, 0, (size_t)d->size * sizeof *d->x);
    memcpy(d->x, f, (size_t)m * sizeof *f);
    fft_forward(d->fft, d->x, d->f_re, d->f_im);
    for (long k = 0; k < d->bins; k++)
        most = fmax(most, d->power[k] = d->f_re[k] * d->f_re[k] + d->f_im[k] * d->f_im[k]);
    for (long k = 0; k < d->bins; k++)
        d->power[k] += limit * most;
    return most > 0.0;
}

int deconvolve(const double *y, long n, const double *f, long m, double limit, double *h)
{
    struct arena *work = arena_open();
    struct deconvolution d = {.n = n, .size = (long)fft_good_size((size_t)(2 * n + 2 * m))};
    d.bins = d.size / 2 + 1;
    d.fft = fft_open((size_t)d.size);
    d.x = ARENA_TAKE(work, double, d.size);
    double **spectra[] = {&d.re, &d.im, &d.f_re, &d.f_im, &d.power};
    for (int k = 0; k < 5; k++)
        *spectra[k] = ARENA_TAKE(work, double, d.bins);
    double *r = ARENA_TAKE(work, double, n), *z = ARENA_TAKE(work, double, n), *p = ARENA_TAKE(work, double, n),
           *q = ARENA_TAKE(work, double, n);
    int step = 0;
    memset(h, 0, (size_t)n * sizeof *h);
    if (force(&d, f, m, limit)) {
        correlated(&d, y, r);
        filtered(&d, r, true, z);
        memcpy(p, z, (size_t)n * sizeof *p);
        double rz = product(r, z, n), first = rz;
        for (; step < MOST && rz > enough * enough * first; step++) {
            filtered(&d, p, false, q);
            double length = rz / product(p, q, n), before = rz;
            for (long i = 0; i < n; i++) {
                h[i] += length * p[i];
                r[i] -= length * q[i];
            }
            filtered(&d, r, true, z);
            rz = product(r, z, n);
            for (long i = 0; i < n; i++)
                p[i] = z[i] + rz / before * p[i];
        }
    }
    fft_close(d.fft);
    arena_close(work);
    return step;
}

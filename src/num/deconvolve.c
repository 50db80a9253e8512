#include "num/deconvolve.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "num/toeplitz.h"

enum { MOST = 500 };
static const double enough = 1e-9;

struct deconvolution {
    long n, size, bins;
    struct fft *fft;
    double *x, *re, *im; /* work: [size], [bins] */
    double *f_re, *f_im; /* the force's spectrum */
    double *power;       /* [bins] |F|^2 + weak */
};

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
    double *c = ARENA_TAKE(work, double, n);
    int step = 0;
    memset(h, 0, (size_t)n * sizeof *h);
    if (force(&d, f, m, limit)) {
        struct toeplitz t = {d.fft, n, d.size, d.power, true, MOST, enough * enough};
        correlated(&d, y, c);
        step = toeplitz_solve(&t, c, h);
    }
    fft_close(d.fft);
    arena_close(work);
    return step;
}

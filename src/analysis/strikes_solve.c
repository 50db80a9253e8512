/* Regularised least squares of a convolution, by conjugate gradients.

   With the matrix F of the convolution and the diagonal W of weights, h solves (F' W F + ridge) h = F' W x. Products are transforms, padded so that nothing wraps round.
   Where all samples weigh the same and the pulses stand alone, F' W F is sum |F_k|^2 over the pulses k, a division in frequency; that division, between divisions by
   the root of the weight that each lag has, is the preconditioner (Chan and Jin, An Introduction to Iterative Toeplitz Solvers, 2007): what stands alone takes a few steps,
   overlapping strikes some hundreds. What is left of the gradient stands as error around every strong mode, and is no
   noise: stopped at 1e-3 it was taken for modes.

   The search ends when `enough` is reached, and where rounding allows no more: when PATIENCE steps have not halved the
   least that was left. */
#include "analysis/strikes_solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/fft.h"

enum { STEPS = 3000, PATIENCE = 300 };
static const double enough = 1e-6; /* of the gradient, as the preconditioner weighs it */

struct work {
    const struct strikes_system *s;
    struct fft *fft;
    long size, bins;
    double *re, *im;   /* the force's spectrum */
    double *qr, *qi, *x, *y;
};

long strikes_solve_size(long n, long length)
{
    return (long)fft_good_size((size_t)(n + length));
}

static void forward(struct work *w, const double *x, long n)
{
    memcpy(w->x, x, (size_t)n * sizeof *x);
    memset(w->x + n, 0, (size_t)(w->size - n) * sizeof *x);
    fft_forward(w->fft, w->x, w->qr, w->qi);
}

/* Times the force's spectrum, or its conjugate (sign -1). */
static void times_force(struct work *w, double sign)
{
    for (long j = 0; j < w->bins; j++) {
        double re = w->qr[j], im = w->qi[j], c = w->re[j], d = sign * w->im[j];
        w->qr[j] = (re * c - im * d) / (double)w->size;
        w->qi[j] = (re * d + im * c) / (double)w->size;
    }
    fft_inverse(w->fft, w->qr, w->qi, w->y);
}

static struct work work_open(const struct strikes_system *s, struct arena *a)
{
    struct work w = {.s = s, .size = strikes_solve_size(s->n, s->length)};
    w.bins = w.size / 2 + 1;
    w.fft = fft_open((size_t)w.size);
    w.re = ARENA_TAKE(a, double, w.bins);
    w.im = ARENA_TAKE(a, double, w.bins);
    w.qr = ARENA_TAKE(a, double, w.bins);
    w.qi = ARENA_TAKE(a, double, w.bins);
    w.x = ARENA_TAKE(a, double, w.size);
    w.y = ARENA_TAKE(a, double, w.size);
    forward(&w, s->force, s->n);
    memcpy(w.re, w.qr, (size_t)w.bins * sizeof *w.re);
    memcpy(w.im, w.qi, (size_t)w.bins * sizeof *w.im);
    return w;
}

/* to[length] = F' W of what stands in y. */
static void back(struct work *w, const double *y, double *to)
{
    for (long i = 0; i < w->s->n; i++)
        w->x[i] = w->s->weight[i] * y[i];
    memset(w->x + w->s->n, 0, (size_t)(w->size - w->s->n) * sizeof *w->x);
    fft_forward(w->fft, w->x, w->qr, w->qi);
    times_force(w, -1.0);
    memcpy(to, w->y, (size_t)w->s->length * sizeof *to);
}

static void normal(struct work *w, const double *h, double *to)
{
    forward(w, h, w->s->length);
    times_force(w, 1.0);
    back(w, w->y, to);
    for (long i = 0; i < w->s->length; i++)
        to[i] += w->s->ridge * h[i];
}

static void precondition(struct work *w, const double *r, double *z)
{
    for (long i = 0; i < w->s->length; i++)
        z[i] = r[i] / sqrt(w->s->lag[i]);
    forward(w, z, w->s->length);
    for (long j = 0; j < w->bins; j++) {
        double over = 1.0 / (double)w->size / (w->s->power[j] + w->s->ridge);
        w->qr[j] *= over;
        w->qi[j] *= over;
    }
    fft_inverse(w->fft, w->qr, w->qi, w->y);
    for (long i = 0; i < w->s->length; i++)
        z[i] = w->y[i] / sqrt(w->s->lag[i]);
}

static double dot(const double *a, const double *b, long n)
{
    double sum = 0.0;
    for (long i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void add(double *to, double factor, const double *x, long n)
{
    for (long i = 0; i < n; i++)
        to[i] += factor * x[i];
}

/* direction = z + factor direction */
static void turn(double *direction, const double *z, double factor, long n)
{
    for (long i = 0; i < n; i++)
        direction[i] = z[i] + factor * direction[i];
}

int strikes_solve(const struct strikes_system *s, double *h, double *left)
{
    struct arena *a = arena_open();
    struct work w = work_open(s, a);
    long n = s->length;
    double *r = ARENA_TAKE(a, double, n), *z = ARENA_TAKE(a, double, n), *p = ARENA_TAKE(a, double, n), *q = ARENA_TAKE(a, double, n);
    memset(h, 0, (size_t)n * sizeof *h);
    back(&w, s->sound, r);
    precondition(&w, r, z);
    memcpy(p, z, (size_t)n * sizeof *p);
    double rz = dot(r, z, n), first = rz, least = rz;
    int steps = 0, idle = 0;
    for (; steps < STEPS && idle < PATIENCE && rz > enough * enough * first; steps++) {
        normal(&w, p, q);
        double alpha = rz / dot(p, q, n), before = rz;
        add(h, alpha, p, n);
        add(r, -alpha, q, n);
        precondition(&w, r, z);
        rz = dot(r, z, n);
        turn(p, z, rz / before, n);
        idle = rz < 0.25 * least ? 0 : idle + 1;
        least = idle == 0 ? rz : least;
    }
    *left = first > 0.0 ? sqrt(rz / first) : 0.0;
    fft_close(w.fft);
    arena_close(a);
    return steps;
}

void strikes_solve_sound(const struct strikes_system *s, const double *h, double *y)
{
    struct arena *a = arena_open();
    struct work w = work_open(s, a);
    forward(&w, h, s->length);
    times_force(&w, 1.0);
    memcpy(y, w.y, (size_t)s->n * sizeof *y);
    fft_close(w.fft);
    arena_close(a);
}

/* Standard errors of poles and gains: the noise around a component times the inverse of Fisher's matrix (Kay, Fundamentals of Statistical Signal Processing:
   Estimation Theory, 1993, sections 3.7 and 15.7). With C of the poles (their matrix inverted), the gains' is v G0^-1 + X M C M' X', X = G0^-1 G1. */
#include <cblas.h>
#include <lapacke.h>
#include <math.h>

#include "analysis/ringing_fit.h"
#include "analysis/ringing_normal.h"

struct covariance {
    struct ringing_normal normal;
    double *pole;       /* [w][w] */
    double *inverse;    /* [w][w] of G0 */
    double *moved, *by; /* [w][w] X M of one place; that times pole */
};

/* Inverse of a symmetric matrix through its diagonal's scale. */
static void invert(double *h, int w, struct arena *a)
{
    double *scale = ARENA_TAKE(a, double, w);
    for (int i = 0; i < w; i++)
        scale[i] = h[(long)i * w + i] > 0 ? 1 / sqrt(h[(long)i * w + i]) : 0;
    for (int i = 0; i < w; i++)
        for (int k = 0; k < w; k++)
            h[(long)i * w + k] = i == k ? 1 : h[(long)i * w + k] * scale[i] * scale[k];
    ringing_normal_factor(h, w);
    LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', w, h, w);
    for (long i = 0; i < w; i++)
        for (long k = i; k < w; k++)
            h[i * w + k] = h[k * w + i] = h[i * w + k] * scale[i] * scale[k];
}

static void pole_make(const struct ringing_fit *f, const double *variance, struct covariance *c, struct arena *a)
{
    int w = c->normal.w;
    double *weight = ARENA_TAKE(a, double, f->r->places * f->m);
    for (int i = 0; i < f->r->places * f->m; i++)
        weight[i] = 1 / variance[i];
    ringing_normal_poles(f, &c->normal, weight, c->pole);
    invert(c->pole, w, a);
    for (int i = 0; i < f->m; i++) {
        for (long k = 0; f->held[i] && k < w; k++)
            for (int x = 0; x < 2; x++)
                c->pole[(2 * i + x) * w + k] = c->pole[k * w + 2 * i + x] = 0;
        for (long k = 0; f->tie[i] >= 0 && k < w; k++)
            c->pole[(2 * i + 1) * w + k] = c->pole[(2 * f->tie[i] + 1) * w + k];
        for (long k = 0; f->tie[i] >= 0 && k < w; k++)
            c->pole[k * w + 2 * i + 1] = c->pole[k * w + 2 * f->tie[i] + 1];
    }
}

/* X M of a place, and its product with the poles' covariance. */
static void moved_make(const struct ringing_fit *f, int place, struct covariance *c)
{
    const struct ringing_normal *n = &c->normal;
    int w = n->w;
    for (int k = 0; k < f->m; k++) {
        double complex gain = f->gain[(long)place * f->most + k];
        for (int i = 0; i < w; i++) {
            double u = n->scale[2 * k] > 0 ? n->scale[i] * n->cross[(long)2 * k * w + i] / n->scale[2 * k] : 0;
            double v = n->scale[2 * k + 1] > 0 ? n->scale[i] * n->cross[((long)2 * k + 1) * w + i] / n->scale[2 * k + 1] : 0;
            c->moved[(long)2 * k * w + i] = u * creal(gain) + v * cimag(gain);
            c->moved[((long)2 * k + 1) * w + i] = v * creal(gain) - u * cimag(gain);
        }
    }
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, w, w, w, 1, c->moved, w, c->pole, w, 0, c->by, w);
}

/* b' m^-1 b of a symmetric 2 x 2 matrix m. */
static double form(const double m[3], const double b[2])
{
    double determinant = m[0] * m[2] - m[1] * m[1];
    if (!(determinant > 0))
        return m[0] > 0 ? b[0] * b[0] / m[0] : 0;
    return (b[0] * b[0] * m[2] - 2 * b[0] * b[1] * m[1] + b[1] * b[1] * m[0]) / determinant;
}

static void gain_error(const struct ringing_fit *f, int place, int i, double variance, struct covariance *c, struct ringing_fit_errors *e)
{
    long w = c->normal.w, at = 2 * i;
    double complex gain = f->gain[(long)place * f->most + i];
    double size = sqrt(creal(gain) * creal(gain) + cimag(gain) * cimag(gain)), b[2] = {creal(gain), cimag(gain)};
    double fixed[3] = {c->inverse[at * w + at] * variance, c->inverse[at * w + at + 1] * variance, c->inverse[(at + 1) * w + at + 1] * variance}, all[3];
    for (int x = 0; x < 3; x++) {
        long row = at + x / 2, column = at + (x + 1) / 2;
        all[x] = fixed[x] + cblas_ddot((int)w, c->by + row, (int)w, c->moved + column, (int)w);
    }
    double u = size > 0 ? b[0] / size : 1, v = size > 0 ? b[1] / size : 0;
    e->gain[place * f->m + i] = sqrt(fmax(u * u * all[0] + 2 * u * v * all[1] + v * v * all[2], 0));
    e->energy[i] += form(fixed, b);
    e->apart[i] += form(all, b);
}

static void covariance_open(const struct ringing_fit *f, struct covariance *c, struct arena *a)
{
    ringing_normal_make(f, a, &c->normal);
    int w = c->normal.w;
    c->pole = ARENA_TAKE(a, double, (long)w * w);
    c->inverse = c->normal.g[0];
    c->moved = ARENA_TAKE(a, double, (long)w * w);
    c->by = ARENA_TAKE(a, double, (long)w * w);
    LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', w, c->inverse, w);
    for (long i = 0; i < w; i++)
        for (long k = i; k < w; k++)
            c->inverse[i * w + k] = c->inverse[k * w + i] = c->inverse[i * w + k] * c->normal.scale[i] * c->normal.scale[k];
}

void ringing_fit_covariance(struct ringing_fit *f, const double *variance, struct arena *a, struct ringing_fit_errors *e)
{
    struct arena *inner = arena_open();
    struct covariance c;
    e->decay = ARENA_TAKE(a, double, f->m);
    e->omega = ARENA_TAKE(a, double, f->m);
    e->energy = ARENA_TAKE(a, double, f->m);
    e->apart = ARENA_TAKE(a, double, f->m);
    e->gain = ARENA_TAKE(a, double, f->m * f->r->places);
    covariance_open(f, &c, inner);
    pole_make(f, variance, &c, inner);
    for (long i = 0; i < f->m; i++) {
        e->decay[i] = sqrt(fmax(c.pole[2 * i * c.normal.w + 2 * i], 0));
        e->omega[i] = sqrt(fmax(c.pole[(2 * i + 1) * c.normal.w + 2 * i + 1], 0));
    }
    for (int p = 0; p < f->r->places; p++) {
        moved_make(f, p, &c);
        for (int i = 0; i < f->m; i++)
            gain_error(f, p, i, variance[p * f->m + i], &c, e);
    }
    arena_close(inner);
}

/* The normal equations of h = Re sum B_i e^(s_i t) at one set of poles. Rows of the basis: u_i = Re e^(s_i t), v_i = -Im e^(s_i t), so that
   h = sum Re B_i u_i + Im B_i v_i, and by the pole, real and imaginary part: d h = t (u, v) M (d s), M = [Re B, -Im B; Im B, Re B]. Gains eliminated
   (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973; Kaufman's form), the poles' matrix is sum over places of M' S M,
   S = G2 - G1 G0^-1 G1, G_q the inner products with weight t^q, which do not depend on the place. */
#include "analysis/ringing_normal.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

double ringing_normal_factor(double *matrix, int w)
{
    struct arena *a = arena_open();
    size_t size = (size_t)w * (size_t)w;
    double *kept = ARENA_TAKE(a, double, size), ridge = 0;
    memcpy(kept, matrix, size * sizeof *kept);
    while (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', w, matrix, w) != 0 && ridge < 1) {
        ridge = ridge > 0 ? 10 * ridge : 1e-14;
        memcpy(matrix, kept, size * sizeof *kept);
        for (int i = 0; i < w; i++)
            matrix[(long)i * w + i] *= 1 + ridge;
    }
    arena_close(a);
    return ridge;
}

/* A row that is 0 throughout (the constant's second) is left out: 1 on the diagonal. */
static void scale_make(struct ringing_normal *n)
{
    long w = n->w;
    for (long i = 0; i < w; i++) {
        double size = n->g[0][i * w + i];
        n->scale[i] = size > 1e-200 ? 1 / sqrt(size) : 0;
    }
    for (int q = 0; q < 3; q++)
        for (long i = 0; i < w; i++)
            for (long k = 0; k < w; k++)
                n->g[q][i * w + k] *= n->scale[i] * n->scale[k];
    for (long i = 0; i < w; i++)
        if (n->scale[i] == 0)
            n->g[0][i * w + i] = 1;
}

void ringing_normal_make(const struct ringing_fit *f, struct arena *a, struct ringing_normal *n)
{
    int w = n->w = 2 * f->m;
    long size = (long)w * w;
    for (int q = 0; q < 3; q++)
        n->g[q] = ARENA_TAKE(a, double, size);
    n->scale = ARENA_TAKE(a, double, w);
    n->cross = ARENA_TAKE(a, double, size);
    n->schur = ARENA_TAKE(a, double, size);
    ringing_basis_gram(f->m, f->decay, f->omega, &f->basis, n->g);
    scale_make(n);
    ringing_normal_factor(n->g[0], w);
    memcpy(n->cross, n->g[1], (size_t)size * sizeof *n->cross);
    LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'L', w, w, n->g[0], w, n->cross, w);
    memcpy(n->schur, n->g[2], (size_t)size * sizeof *n->schur);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, w, w, w, -1, n->g[1], w, n->cross, w, 1, n->schur, w);
}

void ringing_normal_solve(const struct ringing_normal *n, double *x)
{
    LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'L', n->w, 1, n->g[0], n->w, x, n->w);
}

/* M' block M of one pair of components at one place; block = s[2i..][2k..] with the scales taken off. */
static void pair_add(const struct ringing_normal *n, int i, int k, const double complex gain[2], double *h)
{
    double b[2][2], left[2][2], first[2][2] = {{creal(gain[0]), -cimag(gain[0])}, {cimag(gain[0]), creal(gain[0])}};
    double second[2][2] = {{creal(gain[1]), -cimag(gain[1])}, {cimag(gain[1]), creal(gain[1])}};
    long w = n->w;
    for (int x = 0; x < 2; x++)
        for (int y = 0; y < 2; y++) {
            double p = n->scale[2 * i + x], q = n->scale[2 * k + y];
            b[x][y] = p > 0 && q > 0 ? n->schur[(2 * k + y) * w + 2 * i + x] / (p * q) : 0;
        }
    for (int x = 0; x < 2; x++)
        for (int y = 0; y < 2; y++)
            left[x][y] = first[0][x] * b[0][y] + first[1][x] * b[1][y];
    for (int x = 0; x < 2; x++)
        for (int y = 0; y < 2; y++)
            h[(2 * k + y) * w + 2 * i + x] += left[x][0] * second[0][y] + left[x][1] * second[1][y];
}

/* Row and column `from` are added to `to`, and become those of the identity. */
static void tie(double *h, long w, long from, long to)
{
    for (long k = 0; to >= 0 && k < w; k++)
        h[to * w + k] += h[from * w + k];
    for (long k = 0; to >= 0 && k < w; k++)
        h[k * w + to] += h[k * w + from];
    for (long k = 0; k < w; k++)
        h[from * w + k] = h[k * w + from] = 0;
    h[from * w + from] = 1;
}

void ringing_normal_poles(const struct ringing_fit *f, const struct ringing_normal *n, const double *weight, double *h)
{
    long w = n->w;
    memset(h, 0, (size_t)(w * w) * sizeof *h);
    for (int i = 0; i < f->m; i++)
        for (int k = 0; k < f->m; k++)
            for (int p = 0; p < f->r->places; p++) {
                double root = sqrt(weight[p * f->m + i] * weight[p * f->m + k]);
                const double complex *gain = f->gain + (long)p * f->most;
                pair_add(n, i, k, (const double complex[]){gain[i] * root, gain[k]}, h);
            }
    for (int i = 0; i < f->m; i++) {
        if (f->held[i])
            tie(h, w, 2 * i, -1);
        if (f->held[i] || f->tie[i] >= 0)
            tie(h, w, 2 * i + 1, f->held[i] ? -1 : 2 * f->tie[i] + 1);
    }
}

void ringing_normal_reduce(const struct ringing_fit *f, double *g)
{
    for (int i = 0; i < f->m; i++) {
        if (!f->held[i] && f->tie[i] >= 0)
            g[2 * f->tie[i] + 1] += g[2 * i + 1];
        if (f->held[i])
            g[2 * i] = 0;
        if (f->held[i] || f->tie[i] >= 0)
            g[2 * i + 1] = 0;
    }
}

void ringing_normal_expand(const struct ringing_fit *f, double *step)
{
    for (int i = 0; i < f->m; i++)
        if (!f->held[i] && f->tie[i] >= 0)
            step[2 * i + 1] = step[2 * f->tie[i] + 1];
}

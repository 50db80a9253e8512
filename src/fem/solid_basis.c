/* Modes of equal frequency (of a square, a ring, a ball) are a space, of which a solver returns any basis. Here it is
   the one that makes extreme, and so M-orthogonal, the weighted energy

       Q(u) = sum over axes p of 1, 1/2, 1/4 times |W_p u|^2_M,   W_p(x) = diag(1, 7/8, 3/4)/(1 + |x - x_p|^2/s^2),

   x_p where the line from the middle of the box along +x, +y, +z leaves it, s a quarter of the longest side. The first
   of a cluster is the one that moves most near +x, as of modes that are struck there. W has no symmetry that a solid
   could share, and every angular order, so that Q's eigenvalues within a cluster differ. The diagonal tells apart the
   two ways in which a slender rod bends: they move the same places. */
#include "fem/solid_basis.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct cluster {
    int first, n;
    double *weighted, *times; /* [n][freedoms], [freedoms] */
    double *q;                /* [n][n] */
};

static void weigh(const struct solid_place *at, int axis, const double *v, double *w)
{
    const struct boundary *b = at->net->boundary;
    double place[3], side = 0.0;
    for (int k = 0; k < 3; k++) {
        place[k] = k == axis ? b->high[k] : 0.5 * (b->low[k] + b->high[k]);
        side = fmax(side, b->high[k] - b->low[k]);
    }
    for (int i = 0; i < at->net->nodes; i++) {
        double far = 0.0;
        for (int k = 0; k < 3; k++)
            far += (at->net->at[i][k] - place[k]) * (at->net->at[i][k] - place[k]);
        for (int k = 0; k < 3; k++) {
            int freedom = at->freedoms->of[i][k];
            if (freedom >= 0) w[freedom] = (1.0 - 0.125 * k) * v[freedom] / (1.0 + 16.0 * far / (side * side));
        }
    }
}

/* q += share of one axis. */
static void add_energy(struct solid_matrices *x, const struct solid_place *at, int axis, const struct solid_pairs *p,
                       struct cluster *c)
{
    size_t n = p->freedoms;
    for (int i = 0; i < c->n; i++)
        weigh(at, axis, p->vector + (size_t)(c->first + i) * n, c->weighted + (size_t)i * n);
    for (int i = 0; i < c->n; i++) {
        solid_matrices_times(x, x->m_thin, c->weighted + (size_t)i * n, c->times);
        for (int k = 0; k < c->n; k++)
            c->q[i * c->n + k] += cblas_ddot((int)n, c->times, 1, c->weighted + (size_t)k * n, 1) / (double)(1 << axis);
    }
}

/* The vectors times the eigenvectors of q, largest first. */
static bool rotate(const struct solid_pairs *p, struct cluster *c)
{
    int n = c->n, wide = (int)p->freedoms;
    double *value = (double *)malloc((size_t)n * sizeof *value), *v = p->vector + (size_t)c->first * p->freedoms;
    bool ok = value && LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', n, c->q, n, value) == 0;
    if (ok) {
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, wide, n, n, 1.0, v, wide, c->q, n, 0.0, c->weighted,
                    wide);
        for (int i = 0; i < n; i++)
            memcpy(v + (size_t)(n - 1 - i) * p->freedoms, c->weighted + (size_t)i * p->freedoms,
                   p->freedoms * sizeof *v);
    }
    free(value);
    return ok;
}

static bool turn(struct solid_matrices *x, const struct solid_place *at, struct solid_pairs *p, int first, int n)
{
    struct cluster c = {.first = first, .n = n};
    double mean = 0.0;
    c.weighted = (double *)calloc((size_t)n * p->freedoms, sizeof *c.weighted);
    c.times = (double *)malloc(p->freedoms * sizeof *c.times);
    c.q = (double *)calloc((size_t)n * n, sizeof *c.q);
    bool ok = c.weighted && c.times && c.q;
    for (int axis = 0; axis < 3 && ok; axis++)
        add_energy(x, at, axis, p, &c);
    ok = ok && rotate(p, &c);
    for (int i = 0; i < n; i++)
        mean += p->lambda[first + i] / n;
    for (int i = 0; i < n; i++)
        p->lambda[first + i] = mean;
    free(c.weighted);
    free(c.times);
    free(c.q);
    return ok;
}

bool solid_basis(struct solid_matrices *x, const struct solid_place *at, int first, struct solid_pairs *p)
{
    for (int to; first < p->n; first = to) {
        for (to = first + 1; to < p->n && p->lambda[to] - p->lambda[to - 1] <= 2e-6 * p->lambda[to]; to++) {
        }
        if (to - first > 1 && !turn(x, at, p, first, to - first)) return false;
    }
    return true;
}

void solid_basis_sign(double *u, size_t n)
{
    double most = 0.0;
    size_t at = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(u[i]));
    while (at < n && fabs(u[at]) < (1.0 - 1e-6) * most)
        at++;
    for (size_t i = 0; i < n && at < n && u[at] < 0.0; i++)
        u[i] = i == at ? u[i] : -u[i];
    if (at < n) u[at] = fabs(u[at]);
}

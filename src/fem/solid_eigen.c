/* Block Lanczos (solid_lanczos) on CHOLMOD's supernodal factor of K - shift M, nested dissection by METIS. lambda is
   the Rayleigh quotient, whose error is the square of the vector's. Few freedoms, or a good part of all pairs: LAPACK's
   dense solver. */
#include "fem/solid_eigen.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FEW = 400, DENSE_MOST = 3000 };

static void full(const cholmod_sparse *a, double *d)
{
    const int *p = (const int *)a->p, *i = (const int *)a->i;
    memset(d, 0, a->ncol * a->ncol * sizeof *d);
    for (size_t c = 0; c < a->ncol; c++)
        for (int k = p[c]; k < p[c + 1]; k++)
            d[c * a->ncol + (size_t)i[k]] = ((const double *)a->x)[k];
}

/* All pairs; the first ones are kept. */
static bool dense(struct solid_matrices *x, struct solid_pairs *p, struct err *e)
{
    size_t n = p->freedoms;
    double *k = (double *)malloc(n * n * sizeof *k), *m = (double *)malloc(n * n * sizeof *m),
           *value = (double *)malloc(n * sizeof *value);
    bool ok = k && m && value;
    if (!ok) solid_matrices_no_memory(n, e);
    if (ok) {
        full(x->k, k);
        full(x->m, m);
        ok = LAPACKE_dsygvd(LAPACK_COL_MAJOR, 1, 'V', 'L', (int)n, k, (int)n, m, (int)n, value) == 0;
        if (ok)
            memcpy(p->vector, k, (size_t)p->n * n * sizeof *k);
        else
            err_set(e, ERR_NUMBERS,
                    "the modes of the solid were not found: the mass matrix of %zu freedoms is not positive definite; "
                    "look for elements of no volume",
                    n);
    }
    free(k);
    free(m);
    free(value);
    return ok;
}

/* Factor, Lanczos vectors and pairs against what the machine has. */
static bool fits(const cholmod_factor *l, int want)
{
    double need = 8.0 * ((double)l->xsize + (double)l->n * (6.0 * want + 50.0));
    return need < (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGE_SIZE);
}

static bool factorise(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor, struct err *e)
{
    cholmod_sparse *a = solid_matrices_shifted(x, ask->shift);
    if (a && !*factor) *factor = cholmod_analyze(a, &x->common);
    bool ok = a && *factor && fits(*factor, ask->want) && cholmod_factorize(a, *factor, &x->common);
    if (!ok)
        solid_matrices_no_memory(x->k->ncol, e);
    else if ((*factor)->minor < (*factor)->n)
        ok = err_set(e, ERR_NUMBERS,
                     "the stiffness of the solid is not positive definite: look for elements that are nearly flat, or "
                     "a mesh of much too small or large a unit");
    cholmod_free_sparse(&a, &x->common);
    return ok;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Products of WIDE of the vectors with both matrices; the last block has 0 where there are no more. */
struct products {
    double *v, *k, *m, *room; /* [WIDE][freedoms]; 2 WIDE freedoms */
};

static bool products_open(struct products *b, size_t freedoms)
{
    b->v = (double *)malloc(5 * SOLID_MATRICES_WIDE * freedoms * sizeof *b->v);
    if (!b->v) return false;
    b->k = b->v + SOLID_MATRICES_WIDE * freedoms;
    b->m = b->k + SOLID_MATRICES_WIDE * freedoms;
    b->room = b->m + SOLID_MATRICES_WIDE * freedoms;
    return true;
}

static void products_of(struct products *b, const struct solid_matrices *x, const struct solid_pairs *p, int first)
{
    int n = p->n - first < SOLID_MATRICES_WIDE ? p->n - first : SOLID_MATRICES_WIDE;
    memset(b->v, 0, SOLID_MATRICES_WIDE * p->freedoms * sizeof *b->v);
    memcpy(b->v, p->vector + (size_t)first * p->freedoms, (size_t)n * p->freedoms * sizeof *b->v);
    solid_matrices_times_block(x->k, b->v, b->k, b->room);
    solid_matrices_times_block(x->m_thin, b->v, b->m, b->room);
}

struct place {
    double lambda;
    int from;
};

/* Rayleigh quotients, u^T M u = 1. */
static void measure(const struct solid_matrices *x, struct solid_pairs *p, struct products *b, struct place *order)
{
    int n = (int)p->freedoms;
    for (int i = 0; i < p->n; i++) {
        double *v = p->vector + (size_t)i * p->freedoms;
        size_t at = (size_t)(i % SOLID_MATRICES_WIDE) * p->freedoms;
        if (i % SOLID_MATRICES_WIDE == 0) products_of(b, x, p, i);
        double mass = cblas_ddot(n, v, 1, b->m + at, 1);
        order[i] = (struct place){cblas_ddot(n, v, 1, b->k + at, 1) / mass, i};
        cblas_dscal(n, 1.0 / sqrt(mass), v, 1);
    }
}

/* Pairs by rising quotients. */
static bool settle(const struct solid_matrices *x, struct solid_pairs *p)
{
    struct products b = {0};
    struct place *order = (struct place *)calloc((size_t)p->n, sizeof *order);
    double *sorted = (double *)malloc((size_t)p->n * p->freedoms * sizeof *sorted);
    bool ok = products_open(&b, p->freedoms) && order && sorted;
    if (ok) {
        measure(x, p, &b, order);
        qsort(order, (size_t)p->n, sizeof *order, compare);
        for (int i = 0; i < p->n; i++) {
            p->lambda[i] = order[i].lambda;
            memcpy(sorted + (size_t)i * p->freedoms, p->vector + (size_t)order[i].from * p->freedoms,
                   p->freedoms * sizeof *sorted);
        }
        free(p->vector);
        p->vector = sorted;
        sorted = NULL;
    }
    free(b.v);
    free(order);
    free(sorted);
    return ok;
}

static bool find(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor,
                 struct solid_pairs *p, struct err *e)
{
    size_t n = p->freedoms;
    bool small = n <= FEW || (ask->want > (int)(n / 3) && n <= DENSE_MOST);
    p->n = ask->want < (int)(small ? n : n / 2) ? ask->want : (int)(small ? n : n / 2);
    p->lambda = (double *)calloc((size_t)p->n, sizeof *p->lambda);
    p->vector = (double *)calloc((size_t)p->n * n, sizeof *p->vector);
    bool ok = p->lambda && p->vector;
    if (!ok) solid_matrices_no_memory(n, e);
    ok = ok && (small ? dense(x, p, e) : factorise(x, ask, factor, e) && solid_lanczos(x, *factor, ask, p, e));
    return ok && (settle(x, p) || solid_matrices_no_memory(n, e));
}

bool solid_eigen(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor,
                 struct solid_pairs *p, struct err *e)
{
    int threads = openblas_get_num_threads();
    *p = (struct solid_pairs){.freedoms = x->k->ncol};
    openblas_set_num_threads(1);
    bool ok = find(x, ask, factor, p, e);
    openblas_set_num_threads(threads);
    return ok;
}

void solid_eigen_close(struct solid_pairs *p)
{
    free(p->lambda);
    free(p->vector);
    *p = (struct solid_pairs){0};
}

double solid_eigen_residual(const struct solid_matrices *x, const struct solid_pairs *p, int first, int n)
{
    struct products b;
    double worst = 0.0;
    if (!products_open(&b, p->freedoms)) return INFINITY;
    for (int i = first; i < first + n; i++) {
        size_t at = (size_t)((i - first) % SOLID_MATRICES_WIDE) * p->freedoms;
        double off = 0.0, size = 0.0;
        if (at == 0) products_of(&b, x, p, i);
        for (size_t k = at; k < at + p->freedoms; k++) {
            double want = p->lambda[i] * b.m[k];
            off += (b.k[k] - want) * (b.k[k] - want);
            size += want * want;
        }
        worst = fmax(worst, sqrt(off / size));
    }
    free(b.v);
    return worst;
}

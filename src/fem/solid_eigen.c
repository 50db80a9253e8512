/* Implicitly restarted Lanczos, shift and invert (Lehoucq, Sorensen and Yang, ARPACK Users' Guide, 1998, mode 3):

       (K - s M)^-1 M u = theta u,   lambda = s + 1/theta,

   with s below 0: K - s M is positive definite for free solids too, and Cholesky's supernodal factor serves (CHOLMOD, nested dissection by METIS). The start
   vector is noise of a fixed key, BLAS runs in one thread: the same mesh gives the same pairs in every run. lambda is the Rayleigh quotient, whose error is the square of
   the vector's. Few freedoms, or a good part of all pairs: LAPACK's dense solver. */
#include "fem/solid_eigen.h"

#include <arpack/arpack.h>
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "num/noise.h"

/* Ritz values to 1e-12: vectors and restarts beyond that cost twice the time, and give no smaller residual. */
static const double TOLERANCE = 1e-12;

enum { FEW = 400, DENSE_MOST = 3000, RESTARTS = 300 };

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
    double *k = (double *)malloc(n * n * sizeof *k), *m = (double *)malloc(n * n * sizeof *m), *value = (double *)malloc(n * sizeof *value);
    bool ok = k && m && value;
    if (!ok)
        solid_matrices_no_memory(n, e);
    if (ok) {
        full(x->k, k);
        full(x->m, m);
        ok = LAPACKE_dsygvd(LAPACK_COL_MAJOR, 1, 'V', 'L', (int)n, k, (int)n, m, (int)n, value) == 0;
        if (ok)
            memcpy(p->vector, k, (size_t)p->n * n * sizeof *k);
        else
            err_set(e, ERR_NUMBERS, "the modes of the solid were not found: the mass matrix of %zu freedoms is not positive definite; look for elements of no volume", n);
    }
    free(k);
    free(m);
    free(value);
    return ok;
}

/* What ARPACK works on. */
struct lanczos {
    int n, want, vectors, param[11], pointer[14], info, ido;
    double *resid, *v, *work, *small;
};

static bool lanczos_open(struct lanczos *l, size_t n, int want, unsigned start)
{
    int vectors = 2 * want + 10;
    *l = (struct lanczos){.n = (int)n, .want = want, .vectors = vectors < (int)n ? vectors : (int)n, .info = 1};
    size_t wide = (size_t)l->vectors;
    l->param[0] = 1;
    l->param[2] = RESTARTS;
    l->param[3] = 1;
    l->param[6] = 3;
    l->resid = (double *)malloc(n * sizeof *l->resid);
    l->v = (double *)malloc(n * wide * sizeof *l->v);
    l->work = (double *)calloc(3 * n, sizeof *l->work);
    l->small = (double *)calloc(wide * (wide + 8), sizeof *l->small);
    if (!l->resid || !l->v || !l->work || !l->small)
        return false;
    noise_normal(noise_make(0, "solid"), start, n, l->resid);
    return true;
}

static void lanczos_close(struct lanczos *l)
{
    free(l->resid);
    free(l->v);
    free(l->work);
    free(l->small);
}

struct solver {
    cholmod_factor *l;
    cholmod_dense *x, *y, *e; /* CHOLMOD's, kept from solution to solution */
};

static bool solve(struct solid_matrices *m, struct solver *s, double *right, double *answer)
{
    cholmod_dense b = solid_matrices_column(right, s->l->n);
    if (!cholmod_solve2(CHOLMOD_A, s->l, &b, NULL, &s->x, NULL, &s->y, &s->e, &m->common))
        return false;
    memcpy(answer, s->x->x, s->l->n * sizeof *answer);
    return true;
}

/* Until ARPACK has what it wants. */
static bool iterate(struct lanczos *l, struct solid_matrices *m, struct solver *s)
{
    bool ok = true;
    while (ok) {
        dsaupd_c(&l->ido, "G", l->n, "LM", l->want, TOLERANCE, l->resid, l->vectors, l->v, l->n, l->param, l->pointer, l->work, l->small, l->vectors * (l->vectors + 8), &l->info);
        double *in = l->work + l->pointer[0] - 1, *out = l->work + l->pointer[1] - 1;
        if (l->ido == -1) { /* out is scratch until the end */
            solid_matrices_times(m, m->m_thin, in, out);
            ok = solve(m, s, out, out);
        } else if (l->ido == 1) {
            ok = solve(m, s, l->work + l->pointer[2] - 1, out);
        } else if (l->ido == 2) {
            solid_matrices_times(m, m->m_thin, in, out);
        } else {
            break;
        }
    }
    return ok;
}

/* Vectors and values into the pairs, in ARPACK's order. */
static bool extract(struct lanczos *l, double shift, struct solid_pairs *p)
{
    int *select = (int *)calloc((size_t)l->vectors, sizeof *select);
    if (!select)
        return false;
    dseupd_c(1, "A", select, p->lambda, p->vector, l->n, shift, "G", l->n, "LM", l->want, TOLERANCE, l->resid, l->vectors, l->v, l->n, l->param, l->pointer, l->work, l->small,
             l->vectors * (l->vectors + 8), &l->info);
    free(select);
    return true;
}

static bool sparse(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor *factor, struct solid_pairs *p, struct err *e)
{
    struct lanczos l;
    struct solver s = {.l = factor};
    bool ok = lanczos_open(&l, p->freedoms, p->n, ask->start) && iterate(&l, x, &s);
    if (ok && l.info == 0)
        ok = extract(&l, ask->shift, p);
    if (!ok)
        solid_matrices_no_memory(p->freedoms, e);
    else if (l.info != 0 || l.param[4] < p->n)
        ok = err_set(e, ERR_NUMBERS, "the modes of the solid were not found: %d of %d after %d restarts (ARPACK's %d); a mesh of better elements, or fewer modes, may help",
                     l.param[4], p->n, l.param[2], l.info);
    cholmod_free_dense(&s.x, &x->common);
    cholmod_free_dense(&s.y, &x->common);
    cholmod_free_dense(&s.e, &x->common);
    lanczos_close(&l);
    return ok;
}

/* Factor, Lanczos vectors and their copy against what the machine has. */
static bool fits(const cholmod_factor *l, int want)
{
    double need = 8.0 * ((double)l->xsize + (double)l->n * (3.0 * want + 20.0));
    return need < (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGE_SIZE);
}

static bool factorise(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor, struct err *e)
{
    cholmod_sparse *a = solid_matrices_shifted(x, ask->shift);
    if (a && !*factor)
        *factor = cholmod_analyze(a, &x->common);
    bool ok = a && *factor && fits(*factor, ask->want) && cholmod_factorize(a, *factor, &x->common);
    if (!ok)
        solid_matrices_no_memory(x->k->ncol, e);
    else if ((*factor)->minor < (*factor)->n)
        ok = err_set(e, ERR_NUMBERS, "the stiffness of the solid is not positive definite: look for elements that are nearly flat, or a mesh of much too small or large a unit");
    cholmod_free_sparse(&a, &x->common);
    return ok;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Rayleigh quotients, u^T M u = 1, rising. work: [2 freedoms]. */
static bool settle(struct solid_matrices *x, struct solid_pairs *p, double *work)
{
    int n = (int)p->freedoms;
    struct { double lambda; int from; } *order = calloc((size_t)p->n, sizeof *order);
    double *sorted = (double *)malloc((size_t)p->n * p->freedoms * sizeof *sorted);
    bool ok = order && sorted;
    for (int i = 0; i < p->n && ok; i++) {
        double *v = p->vector + (size_t)i * p->freedoms;
        solid_matrices_times(x, x->m_thin, v, work);
        solid_matrices_times(x, x->k, v, work + n);
        double mass = cblas_ddot(n, v, 1, work, 1);
        order[i].lambda = cblas_ddot(n, v, 1, work + n, 1) / mass;
        order[i].from = i;
        cblas_dscal(n, 1.0 / sqrt(mass), v, 1);
    }
    if (ok) {
        qsort(order, (size_t)p->n, sizeof *order, compare);
        for (int i = 0; i < p->n; i++) {
            p->lambda[i] = order[i].lambda;
            memcpy(sorted + (size_t)i * p->freedoms, p->vector + (size_t)order[i].from * p->freedoms, p->freedoms * sizeof *sorted);
        }
        free(p->vector);
        p->vector = sorted;
        sorted = NULL;
    }
    free(order);
    free(sorted);
    return ok;
}

static bool find(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor, struct solid_pairs *p, struct err *e)
{
    size_t n = p->freedoms;
    bool small = n <= FEW || (ask->want > (int)(n / 3) && n <= DENSE_MOST);
    p->n = ask->want < (int)(small ? n : n / 2) ? ask->want : (int)(small ? n : n / 2);
    p->lambda = (double *)calloc((size_t)p->n, sizeof *p->lambda);
    p->vector = (double *)calloc((size_t)p->n * n, sizeof *p->vector);
    double *work = (double *)malloc(2 * n * sizeof *work);
    bool ok = p->lambda && p->vector && work;
    if (!ok)
        solid_matrices_no_memory(n, e);
    ok = ok && (small ? dense(x, p, e) : factorise(x, ask, factor, e) && sparse(x, ask, *factor, p, e));
    if (ok && !settle(x, p, work))
        ok = solid_matrices_no_memory(n, e);
    free(work);
    return ok;
}

bool solid_eigen(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor, struct solid_pairs *p, struct err *e)
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

double solid_eigen_residual(struct solid_matrices *x, const struct solid_pairs *p, int first, int n)
{
    double worst = 0.0, *work = (double *)malloc(2 * p->freedoms * sizeof *work);
    for (int i = first; i < first + n && work; i++) {
        const double *v = p->vector + (size_t)i * p->freedoms;
        double *left = work, *right = work + p->freedoms, off = 0.0, size = 0.0;
        solid_matrices_times(x, x->k, v, left);
        solid_matrices_times(x, x->m_thin, v, right);
        for (size_t k = 0; k < p->freedoms; k++) {
            double want = p->lambda[i] * right[k];
            off += (left[k] - want) * (left[k] - want);
            size += want * want;
        }
        worst = fmax(worst, sqrt(off / size));
    }
    free(work);
    return work ? worst : INFINITY;
}

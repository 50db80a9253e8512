/* Block Lanczos (lanczos) on CHOLMOD's supernodal factor of K - shift M, nested dissection by METIS. lambda is
   the Rayleigh quotient, whose error is the square of the vector's. Few freedoms, or a good part of all pairs: LAPACK's
   dense solver. */
#include "fem/solid_eigen.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "num/noise.h"

/* Block Lanczos, shift and invert (Golub and Underwood 1977; Grimes, Lewis and Simon 1994):

       S = (K - s M)^-1,   S M u = theta u,   lambda = s + 1/theta,

   with s below 0: K - s M is positive definite for free solids too, and Cholesky's supernodal factor serves. From a
   block of noise each step takes V_j to S M V_j, makes it M-orthogonal to all earlier ones (twice, by all of V) and
   M-orthonormal in itself (eigenvectors, then Cholesky's factor of its Gram matrix): S M V_j = V V^T M S M V_j +
   V_(j+1) R. What is left of S M V_j may be less than a block: noise takes the missing places. T = V^T M S M V is
   small; its eigenpairs (theta, y) give vectors V y, and |S M V y - theta V y| = |R y_last|. Done when that is below
   1e-12 theta for all that are wanted.

   Blocks: the factor and V are read from memory once for WIDE vectors, not for each; and equal frequencies (5 of a
   ball's lowest, 2 of whatever is round) are found by more than rounding. Nothing is restarted: about three to four
   vectors for each pair, all kept. The start is noise of a fixed key, BLAS runs in one thread: the same mesh gives the
   same pairs. */

static const double TOLERANCE = 1e-12; /* of theta */
static const double EXHAUSTED = 1e-8;  /* of |S M V_j|: what is left of that is rounding */
static const double LITTLE = 1e-3;     /* of it: what is left is M-orthogonal to V to 1e-13 */

enum { WIDE = SOLID_MATRICES_WIDE };

struct krylov {
    struct solid_matrices *x;
    cholmod_factor *l;
    cholmod_dense *out, *y, *e; /* CHOLMOD's, kept from solution to solution */
    int n, m, room;             /* freedoms; vectors there are, and that there is room for */
    double *v;                  /* [room][n] */
    double *u, *z, *lace;       /* [WIDE][n] the next block, M times it; room for the product */
    double *t, *ritz, *theta;   /* [room][room] V^T M S M V, its upper half; its eigenvectors; eigenvalues, rising */
    double *h, r[WIDE * WIDE];  /* [WIDE][room] V^T M u; R, by columns */
    double size;                /* the longest of the last block before its part along V was taken out */
    uint64_t start;
};

static bool room_for(struct krylov *k, int room)
{
    size_t n = (size_t)k->n, was = (size_t)k->room, wide = (size_t)room;
    double *v = (double *)realloc(k->v, wide * n * sizeof *v), *t = (double *)calloc(wide * wide, sizeof *t);
    k->v = v ? v : k->v;
    for (size_t j = 0; j < was && t; j++)
        memcpy(t + j * wide, k->t + j * was, was * sizeof *t);
    free(k->t);
    free(k->ritz);
    free(k->theta);
    free(k->h);
    k->t = t;
    k->ritz = (double *)malloc(wide * wide * sizeof *k->ritz);
    k->theta = (double *)malloc(wide * sizeof *k->theta);
    k->h = (double *)malloc(wide * WIDE * sizeof *k->h);
    k->room = room;
    return v && t && k->ritz && k->theta && k->h;
}

static bool krylov_open(struct krylov *k, int room)
{
    size_t block = (size_t)k->n * WIDE * sizeof(double);
    k->u = (double *)malloc(block);
    k->z = (double *)malloc(block);
    k->lace = (double *)malloc(2 * block);
    return k->u && k->z && k->lace && room_for(k, room);
}

static void krylov_close(struct krylov *k)
{
    double *all[] = {k->v, k->u, k->z, k->lace, k->t, k->ritz, k->theta, k->h};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        free(all[i]);
    cholmod_free_dense(&k->out, &k->x->common);
    cholmod_free_dense(&k->y, &k->x->common);
    cholmod_free_dense(&k->e, &k->x->common);
}

/* u = S z. */
static bool solve(struct krylov *k)
{
    cholmod_dense b = {.nrow = (size_t)k->n,
                       .ncol = WIDE,
                       .nzmax = (size_t)k->n * WIDE,
                       .d = (size_t)k->n,
                       .x = k->z,
                       .xtype = CHOLMOD_REAL,
                       .dtype = CHOLMOD_DOUBLE};
    if (!cholmod_solve2(CHOLMOD_A, k->l, &b, NULL, &k->out, NULL, &k->y, &k->e, &k->x->common)) return false;
    memcpy(k->u, k->out->x, (size_t)k->n * WIDE * sizeof *k->u);
    return true;
}

/* u less its part along V, which is added to T where T's last columns are V's last block. z is M u before the second
 * time, and so M u after it to rounding. */
static void part(struct krylov *k, bool known)
{
    for (int pass = 0; pass < 2; pass++) {
        solid_matrices_times_block(k->x->m_thin, k->u, k->z, k->lace);
        for (int j = 0; j < WIDE && pass == 0; j++)
            k->size =
                fmax(j ? k->size : 0.0, sqrt(cblas_ddot(k->n, k->u + (size_t)j * k->n, 1, k->z + (size_t)j * k->n, 1)));
        if (k->m == 0) return;
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, k->m, WIDE, k->n, 1.0, k->v, k->n, k->z, k->n, 0.0, k->h,
                    k->room);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, k->n, WIDE, k->m, -1.0, k->v, k->n, k->h, k->room, 1.0,
                    k->u, k->n);
        for (int j = 0; j < WIDE && known; j++)
            cblas_daxpy(k->m, 1.0, k->h + (size_t)j * k->room, 1, k->t + (size_t)(k->m - WIDE + j) * k->room, 1);
    }
}

static void gram(const struct krylov *k, double g[WIDE * WIDE])
{
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, WIDE, WIDE, k->n, 1.0, k->u, k->n, k->z, k->n, 0.0, g, WIDE);
}

/* w times q, columns of q by falling d. */
static void block_turn(const struct krylov *k, const double *q, double *w)
{
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, k->n, WIDE, WIDE, 1.0, w, k->n, q, WIDE, 0.0, k->lace, k->n);
    memcpy(w, k->lace, (size_t)k->n * WIDE * sizeof *w);
}

/* u = (u q/d) (d q^T), u^T z = q d^2 q^T; where d is rounding, noise in place of u q/d and 0 of d. *again: what is left
 * is so little that its part along V has to be taken out once more. false: numbers that are none. */
static bool split(struct krylov *k, bool *again)
{
    double g[WIDE * WIDE], square[WIDE], q[WIDE * WIDE];
    int lost = 0;
    *again = false;
    gram(k, g);
    if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', WIDE, g, WIDE, square) != 0) return false;
    for (int j = 0; j < WIDE; j++) {
        double d = sqrt(fmax(square[WIDE - 1 - j], 0.0));
        bool none = d <= EXHAUSTED * k->size;
        lost += none;
        *again = *again || d <= LITTLE * k->size;
        for (int i = 0; i < WIDE; i++) {
            double x = g[(WIDE - 1 - j) * WIDE + i];
            q[j * WIDE + i] = none ? 0.0 : x / d;
            k->r[i * WIDE + j] = none ? 0.0 : d * x;
        }
    }
    block_turn(k, q, k->u);
    block_turn(k, q, k->z);
    for (int j = WIDE - lost; j < WIDE; j++)
        noise_normal(noise_make(0, "solid"), k->start + (uint64_t)(k->m + j) * 16, (size_t)k->n,
                     k->u + (size_t)j * k->n);
    return true;
}

/* The next block: u M-orthonormal, z = M u, and R, so that what u was is u R. false: numbers that are none. */
static bool norm(struct krylov *k)
{
    double g[WIDE * WIDE];
    bool again, ok = split(k, &again);
    if (ok && again) part(k, false);
    gram(k, g);
    if (!ok || LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', WIDE, g, WIDE) != 0) return false;
    cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, k->n, WIDE, 1.0, g, WIDE, k->u,
                k->n);
    cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, k->n, WIDE, 1.0, g, WIDE, k->z,
                k->n);
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, WIDE, WIDE, 1.0, g, WIDE, k->r, WIDE);
    return true;
}

/* The block u becomes V's last. */
static bool append(struct krylov *k)
{
    if (k->m + WIDE > k->room && !room_for(k, k->m + WIDE + k->room / 2)) return false;
    memcpy(k->v + (size_t)k->m * (size_t)k->n, k->u, (size_t)k->n * WIDE * sizeof *k->u);
    k->m += WIDE;
    return true;
}

/* How many of the greatest theta are as near as they should be; -1: numbers that are none. */
static int near_enough(struct krylov *k, int want)
{
    int m = k->m;
    for (int j = 0; j < m; j++)
        memcpy(k->ritz + (size_t)j * m, k->t + (size_t)j * k->room, (size_t)m * sizeof *k->ritz);
    if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', m, k->ritz, m, k->theta) != 0) return -1;
    int good = 0;
    for (bool ok = true; ok && good < want; good += ok) {
        double last[WIDE], *y = k->ritz + (size_t)(m - 1 - good) * m;
        cblas_dgemv(CblasColMajor, CblasNoTrans, WIDE, WIDE, 1.0, k->r, WIDE, y + m - WIDE, 1, 0.0, last, 1);
        ok = cblas_dnrm2(WIDE, last, 1) <= TOLERANCE * k->theta[m - 1 - good];
    }
    return good;
}

static bool grow(struct krylov *k, int want, struct err *e)
{
    int most = 20 * want + 400 < k->n ? 20 * want + 400 : k->n, next = 4 * want, good = 0;
    noise_normal(noise_make(0, "solid"), k->start, (size_t)k->n * WIDE, k->u);
    part(k, false);
    while (norm(k)) {
        if (k->m >= next || k->m + WIDE > most) {
            good = near_enough(k, want);
            if (good == want) return true;
            if (good < 0 || k->m + WIDE > most) break;
            next = k->m + k->m / 10;
        }
        if (!append(k) || !solve(k)) return solid_matrices_no_memory((size_t)k->n, e);
        part(k, true);
    }
    return err_set(e, ERR_NUMBERS,
                   "the modes of the solid were not found: %d of %d in %d steps; a mesh of better elements, or fewer "
                   "modes, may help",
                   good < 0 ? 0 : good, want, k->m / WIDE);
}

/* p->n vectors of p->freedoms, M-orthonormal, in p->vector, greatest theta first; `factor` is that of K - shift M.
 * ERR_NUMBERS: no convergence; ERR_SCENE: too large for the memory. */
static bool lanczos(struct solid_matrices *x, cholmod_factor *factor, const struct solid_search *ask,
                    struct solid_pairs *p, struct err *e)
{
    struct krylov k = {.x = x, .l = factor, .n = (int)p->freedoms, .start = ask->start};
    bool ok = krylov_open(&k, 4 * p->n + 2 * WIDE) || solid_matrices_no_memory(p->freedoms, e);
    ok = ok && grow(&k, p->n, e);
    for (int i = 0; i < p->n / 2 && ok; i++) /* greatest first */
        cblas_dswap(k.m, k.ritz + (size_t)(k.m - 1 - i) * k.m, 1, k.ritz + (size_t)(k.m - p->n + i) * k.m, 1);
    if (ok)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, k.n, p->n, k.m, 1.0, k.v, k.n,
                    k.ritz + (size_t)(k.m - p->n) * k.m, k.m, 0.0, p->vector, k.n);
    krylov_close(&k);
    return ok;
}

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

static bool factorise(struct solid_matrices *x, const struct solid_search *ask, cholmod_factor **factor, struct err *e)
{
    cholmod_sparse *a = solid_matrices_shifted(x, ask->shift);
    if (a && !*factor) *factor = cholmod_analyze(a, &x->common);
    bool ok = a && *factor;
    if (ok) { /* factor, Lanczos vectors and pairs against what the machine has */
        double need = 8.0 * ((double)(*factor)->xsize + (double)(*factor)->n * (6.0 * ask->want + 50.0));
        ok = need < (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGE_SIZE) &&
             cholmod_factorize(a, *factor, &x->common);
    }
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
static bool sort_pairs(const struct solid_matrices *x, struct solid_pairs *p)
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
    ok = ok && (small ? dense(x, p, e) : factorise(x, ask, factor, e) && lanczos(x, *factor, ask, p, e));
    return ok && (sort_pairs(x, p) || solid_matrices_no_memory(n, e));
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

/* Sylvester's law of inertia: K - shift M = L D L^T has as many negative pivots as there are lambda below shift.

   The matrix is indefinite, which CHOLMOD's Cholesky cannot factor, so here is the multifrontal method (Duff and Reid
   1983; Liu 1992) over the supernodes that CHOLMOD has found: each supernode's columns and its children's updates are
   summed in a dense front
       F = [F11 F21^T; F21 F22],   F11 = P L D L^T P^T (Bunch and Kaufman, pivots within the supernode),   update F22 -
                                   F21 F11^-1 F21^T  to its parent.
   Only signs of pivots are kept, so no factor needs memory, only updates that wait for their parents. */

struct fronts {
    const cholmod_factor *l;
    cholmod_sparse *a;    /* permuted, lower half */
    int *place;           /* [n] row -> row of the front */
    int *super_of;        /* [n] column -> supernode */
    int *child, *sibling; /* [nsuper] lists, -1 ends */
    double **update;      /* [nsuper] lower half, m x m by columns; NULL: none, or used */
};

struct front {
    int s, columns, rows;
    const int *row; /* [rows] the first `columns` are its own */
    double *f;      /* rows x rows, lower half, by columns */
    double *x;      /* columns x (rows - columns): F11^-1 F21^T */
    int *pivot;
};

static struct front front_of(const struct fronts *t, int s)
{
    const int *super = (const int *)t->l->super, *pi = (const int *)t->l->pi;
    return (struct front){
        .s = s, .columns = super[s + 1] - super[s], .rows = pi[s + 1] - pi[s], .row = (const int *)t->l->s + pi[s]};
}

static void gather(struct fronts *t, struct front *f)
{
    const int *p = (const int *)t->a->p, *i = (const int *)t->a->i, first = f->row[0];
    const double *x = (const double *)t->a->x;
    for (int r = 0; r < f->rows; r++)
        t->place[f->row[r]] = r;
    for (int c = 0; c < f->columns; c++)
        for (int k = p[first + c]; k < p[first + c + 1]; k++)
            f->f[(size_t)c * f->rows + t->place[i[k]]] = x[k];
    for (int s = t->child[f->s]; s >= 0; s = t->sibling[s]) {
        struct front from = front_of(t, s);
        int m = from.rows - from.columns;
        const int *row = from.row + from.columns;
        for (int c = 0; c < m; c++)
            for (int r = c; r < m; r++)
                f->f[(size_t)t->place[row[c]] * f->rows + t->place[row[r]]] += t->update[s][(size_t)c * m + r];
        free(t->update[s]);
        t->update[s] = NULL;
    }
}

static long negative(const struct front *f)
{
    long n = 0;
    for (int c = 0; c < f->columns; c++) {
        bool pair = f->pivot[c] < 0; /* of Bunch and Kaufman's 2 x 2 pivots one is negative, one positive */
        n += pair || f->f[(size_t)c * f->rows + c] < 0.0;
        c += pair;
    }
    return n;
}

/* F22 - F21 X, its lower half, by strips of columns. */
static bool pass_on(struct fronts *t, const struct front *f)
{
    enum { STRIP = 96 };
    int m = f->rows - f->columns, parent = t->super_of[f->row[f->columns]];
    double *u = (double *)malloc((size_t)m * m * sizeof *u);
    if (!u) return false;
    for (int c = 0; c < m; c++)
        memcpy(u + (size_t)c * m + c, f->f + (size_t)(f->columns + c) * f->rows + f->columns + c,
               (size_t)(m - c) * sizeof *u);
    for (int c = 0; c < m; c += STRIP) {
        int wide = m - c < STRIP ? m - c : STRIP;
        for (int k = 1; k < wide; k++) /* of its corner the upper half is computed too, and not used */
            memset(u + (size_t)(c + k) * m + c, 0, (size_t)k * sizeof *u);
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m - c, wide, f->columns, -1.0, f->f + f->columns + c,
                    f->rows, f->x + (size_t)c * f->columns, f->columns, 1.0, u + (size_t)c * m + c, m);
    }
    t->update[f->s] = u;
    t->sibling[f->s] = t->child[parent];
    t->child[parent] = f->s;
    return true;
}

static bool eliminate(struct fronts *t, struct front *f, long *count)
{
    int m = f->rows - f->columns;
    if (LAPACKE_dsytrf(LAPACK_COL_MAJOR, 'L', f->columns, f->f, f->rows, f->pivot) != 0) return false;
    *count += negative(f);
    if (m == 0) return true;
    for (int c = 0; c < f->columns; c++)
        for (int r = 0; r < m; r++)
            f->x[(size_t)r * f->columns + c] = f->f[(size_t)c * f->rows + f->columns + r];
    return LAPACKE_dsytrs2(LAPACK_COL_MAJOR, 'L', f->columns, m, f->f, f->rows, f->pivot, f->x, f->columns) == 0 &&
           pass_on(t, f);
}

static bool one_front(struct fronts *t, int s, long *count)
{
    struct front f = front_of(t, s);
    f.f = (double *)calloc((size_t)f.rows * f.rows, sizeof *f.f);
    f.x = (double *)malloc((size_t)f.rows * f.columns * sizeof *f.x);
    f.pivot = (int *)calloc((size_t)f.columns, sizeof *f.pivot);
    bool ok = f.f && f.x && f.pivot;
    if (ok) {
        gather(t, &f);
        ok = eliminate(t, &f, count);
    }
    free(f.f);
    free(f.x);
    free(f.pivot);
    return ok;
}

static bool fronts_open(struct fronts *t, struct solid_matrices *x, double shift)
{
    cholmod_sparse *a = solid_matrices_shifted(x, shift), *upper = NULL;
    size_t n = t->l->n, supers = t->l->nsuper;
    if (a) upper = cholmod_ptranspose(a, 1, (int *)t->l->Perm, NULL, 0, &x->common);
    if (upper) t->a = cholmod_transpose(upper, 1, &x->common);
    cholmod_free_sparse(&a, &x->common);
    cholmod_free_sparse(&upper, &x->common);
    t->place = (int *)calloc(n, sizeof *t->place);
    t->super_of = (int *)calloc(n, sizeof *t->super_of);
    t->child = (int *)malloc(supers * sizeof *t->child);
    t->sibling = (int *)malloc(supers * sizeof *t->sibling);
    t->update = (double **)calloc(supers, sizeof *t->update);
    if (!t->a || !t->place || !t->super_of || !t->child || !t->sibling || !t->update) return false;
    for (int s = 0; s < (int)supers; s++) {
        t->child[s] = t->sibling[s] = -1;
        for (int c = ((int *)t->l->super)[s]; c < ((int *)t->l->super)[s + 1]; c++)
            t->super_of[c] = s;
    }
    return true;
}

static void fronts_close(struct fronts *t, cholmod_common *c)
{
    for (size_t s = 0; t->update && s < t->l->nsuper; s++)
        free(t->update[s]);
    cholmod_free_sparse(&t->a, c);
    free(t->place);
    free(t->super_of);
    free(t->child);
    free(t->sibling);
    free(t->update);
}

long solid_eigen_count(struct solid_matrices *x, const cholmod_factor *like, double shift)
{
    struct fronts t = {.l = like};
    long count = 0;
    bool ok = fronts_open(&t, x, shift);
    for (int s = 0; ok && s < (int)like->nsuper; s++)
        ok = one_front(&t, s, &count);
    fronts_close(&t, &x->common);
    return ok ? count : -1;
}

/* Modes of equal frequency (of a square, a ring, a ball) are a space, of which a solver returns any basis. Here it is
   the one that makes extreme, and so M-orthogonal, the weighted energy

       Q(u) = sum over axes p of 1, 1/2, 1/4 times |W_p u|^2_M,   W_p(x) = diag(1, 7/8, 3/4)/(1 + |x - x_p|^2/s^2),

   x_p where the line from the middle of the box along +x, +y, +z leaves it, s a quarter of the longest side. The first
   of a cluster is the one that moves most near +x, as of modes that are struck there. W has no symmetry that a solid
   could share, and every angular order, so that Q's eigenvalues within a cluster differ. The diagonal tells apart the
   two ways in which a slender rod bends: they move the same places. */

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

static bool basis_turn(struct solid_matrices *x, const struct solid_place *at, struct solid_pairs *p, int first, int n)
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

bool solid_eigen_basis(struct solid_matrices *x, const struct solid_place *at, int first, struct solid_pairs *p)
{
    for (int to; first < p->n; first = to) {
        for (to = first + 1; to < p->n && p->lambda[to] - p->lambda[to - 1] <= 2e-6 * p->lambda[to]; to++) {
        }
        if (to - first > 1 && !basis_turn(x, at, p, first, to - first)) return false;
    }
    return true;
}

void solid_eigen_sign(double *u, size_t n)
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

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
#include "fem/solid_lanczos.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fem/solid_eigen.h"
#include "num/noise.h"

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

static void product(struct krylov *k) { solid_matrices_times_block(k->x->m_thin, k->u, k->z, k->lace); }

/* u less its part along V, which is added to T where T's last columns are V's last block. z is M u before the second
 * time, and so M u after it to rounding. */
static void part(struct krylov *k, bool known)
{
    for (int pass = 0; pass < 2; pass++) {
        product(k);
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
static void turn(const struct krylov *k, const double *q, double *w)
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
    turn(k, q, k->u);
    turn(k, q, k->z);
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

bool solid_lanczos(struct solid_matrices *x, cholmod_factor *factor, const struct solid_search *ask,
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

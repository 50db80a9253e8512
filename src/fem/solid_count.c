/* Sylvester's law of inertia: K - shift M = L D L^T has as many negative pivots as there are lambda below shift.

   The matrix is indefinite, which CHOLMOD's Cholesky cannot factor, so here is the multifrontal method (Duff and Reid
   1983; Liu 1992) over the supernodes that CHOLMOD has found: each supernode's columns and its children's updates are
   summed in a dense front F = [F11 F21^T; F21 F22],   F11 = P L D L^T P^T (Bunch and Kaufman, pivots within the
   supernode),   update F22 - F21 F11^-1 F21^T  to its parent. Only signs of pivots are kept, so no factor needs memory,
   only updates that wait for their parents. */
#include "fem/solid_count.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

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

long solid_count(struct solid_matrices *x, const cholmod_factor *like, double shift)
{
    struct fronts t = {.l = like};
    long count = 0;
    bool ok = fronts_open(&t, x, shift);
    for (int s = 0; ok && s < (int)like->nsuper; s++)
        ok = one_front(&t, s, &count);
    fronts_close(&t, &x->common);
    return ok ? count : -1;
}

/* See heightfile_fill.h. With weights w = 1/pitch^2 of the two directions, each missing height is the weighted mean of
   its neighbours in the map:

     sum over neighbours n of w_n (z_n - z) = 0,        known neighbours on the right-hand side

   a symmetric, positive definite system (every hole touches a known height), solved by conjugate gradients with its
   diagonal as preconditioner, all sums in order: the same bits everywhere. A harmonic polynomial up to the third degree
   solves it exactly. The number of steps goes with the width of the widest hole in samples. */
#include "file/heightfile_fill.h"

#include <math.h>
#include <stdint.h>

enum { FILL_KNOWN = -1 };

struct fill {
    size_t n;             /* unknowns                                                 */
    uint32_t *place;      /* [n] index in the map, rising                             */
    int32_t (*beside)[4]; /* [n] left, right, up, down: unknown, or FILL_KNOWN      */
    double *diagonal;     /* [n]                                                      */
    double *x, *r, *p, *q;
    double weight[2]; /* along rows, across                                       */
};

static size_t fill_find(const struct fill *f, size_t place)
{
    size_t low = 0, high = f->n;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (f->place[middle] <= place)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The four neighbours of unknown k: whether inside the map, and where. */
static bool fill_neighbour(const struct heightfile *h, size_t place, int side, size_t *there)
{
    size_t column = place % h->columns, row = place / h->columns;
    switch (side) {
    case 0:
        *there = place - 1;
        return column > 0;
    case 1:
        *there = place + 1;
        return column + 1 < h->columns;
    case 2:
        *there = place - h->columns;
        return row > 0;
    default:
        *there = place + h->columns;
        return row + 1 < h->rows;
    }
}

/* The unknowns, their neighbours, the diagonal, and the right-hand side in r: heights from the middle of their range,
 * in units of it. */
static void fill_system(struct fill *f, const struct heightfile *h, double middle, double span)
{
    size_t k = 0, there;
    for (size_t i = 0; i < h->rows * h->columns; i++)
        if (isnan(h->z[i])) f->place[k++] = (uint32_t)i;
    for (k = 0; k < f->n; k++)
        for (int side = 0; side < 4; side++) {
            f->beside[k][side] = FILL_KNOWN;
            if (!fill_neighbour(h, f->place[k], side, &there)) continue;
            f->diagonal[k] += f->weight[side / 2];
            if (isnan(h->z[there]))
                f->beside[k][side] = (int32_t)fill_find(f, there);
            else
                f->r[k] += f->weight[side / 2] * ((h->z[there] - middle) / span);
        }
}

/* q = A p. */
static void fill_apply(struct fill *f)
{
    for (size_t k = 0; k < f->n; k++) {
        double sum = f->diagonal[k] * f->p[k];
        for (int side = 0; side < 4; side++)
            if (f->beside[k][side] >= 0) sum -= f->weight[side / 2] * f->p[f->beside[k][side]];
        f->q[k] = sum;
    }
}

/* Largest residual over its diagonal: as a height. Infinite if one is not a number (which fmax would pass over). */
static double fill_residual(const struct fill *f)
{
    double most = 0;
    for (size_t k = 0; k < f->n; k++) {
        double r = fabs(f->r[k]) / f->diagonal[k];
        most = isnan(r) ? HUGE_VAL : fmax(most, r);
    }
    return most;
}

static double fill_product(const struct fill *f)
{
    double sum = 0;
    for (size_t k = 0; k < f->n; k++)
        sum += f->r[k] * f->r[k] / f->diagonal[k];
    return sum;
}

static bool fill_solve(struct fill *f, double tolerance)
{
    double rho = fill_product(f);
    for (size_t k = 0; k < f->n; k++)
        f->p[k] = f->r[k] / f->diagonal[k];
    for (size_t step = 0; step < 100000 && fill_residual(f) > tolerance; step++) {
        double pq = 0, before = rho;
        fill_apply(f);
        for (size_t k = 0; k < f->n; k++)
            pq += f->p[k] * f->q[k];
        if (!(pq > 0)) return false;
        for (size_t k = 0; k < f->n; k++) {
            f->x[k] += rho / pq * f->p[k];
            f->r[k] -= rho / pq * f->q[k];
        }
        rho = fill_product(f);
        for (size_t k = 0; k < f->n; k++)
            f->p[k] = f->r[k] / f->diagonal[k] + rho / before * f->p[k];
    }
    return fill_residual(f) <= tolerance;
}

static struct fill fill_make(const struct heightfile *h, struct arena *a)
{
    struct fill f = {.n = h->holes, .weight = {1, 1}};
    if (!isnan(h->pitch_x) && !isnan(h->pitch_y)) f.weight[1] = h->pitch_x * h->pitch_x / (h->pitch_y * h->pitch_y);
    f.place = ARENA_TAKE(a, uint32_t, f.n);
    f.beside = arena_take(a, f.n, sizeof *f.beside);
    f.diagonal = ARENA_TAKE(a, double, f.n);
    f.x = ARENA_TAKE(a, double, f.n);
    f.r = ARENA_TAKE(a, double, f.n);
    f.p = ARENA_TAKE(a, double, f.n);
    f.q = ARENA_TAKE(a, double, f.n);
    return f;
}

static void fill_extent(const struct heightfile *h, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        *low = fmin(*low, h->z[i]); /* fmin passes over NaN */
        *high = fmax(*high, h->z[i]);
    }
}

/* A profile's gaps are straight lines: no need of steps. */
static void fill_profile(struct heightfile *h)
{
    size_t n = h->columns;
    for (size_t from = 0, to; from < n; from = to + 1) {
        for (to = from; to < n && isnan(h->z[to]); to++)
            ;
        double before = from > 0 ? h->z[from - 1] : h->z[to], after = to < n ? h->z[to] : before;
        for (size_t i = from; i < to; i++) {
            double share = (double)(i - from + 1) / (double)(to - from + 1);
            h->z[i] = before * (1 - share) + after * share;
        }
    }
}

static bool fill_map(const char *path, struct heightfile *h, struct err *e)
{
    struct arena *own = arena_open();
    struct fill f = fill_make(h, own);
    double low, high;
    fill_extent(h, &low, &high);
    double middle = 0.5 * low + 0.5 * high, span = high > low ? high - low : 1;
    fill_system(&f, h, middle, span);
    bool ok = (isfinite(span) && f.weight[1] > 1e-30 && f.weight[1] < 1e30 && fill_solve(&f, 1e-12)) ||
              err_set(e, ERR_NUMBERS, "%s: its %zu missing points cannot be filled: the solution does not converge",
                      path, h->holes);
    for (size_t k = 0; ok && k < f.n; k++)
        h->z[f.place[k]] = middle + span * f.x[k];
    arena_close(own);
    return ok;
}

bool heightfile_fill(const char *path, struct heightfile *h, struct err *e)
{
    size_t n = h->rows * h->columns;
    if (h->holes == 0) return true;
    if (h->holes > n / 2)
        return err_set(e, ERR_SCENE,
                       "%s: %zu of %zu points are missing: too many to be filled (more than half): cut out a part that "
                       "has them (rasp surface convert --crop), or mend the file",
                       path, h->holes, n);
    if (h->rows == 1)
        fill_profile(h);
    else if (!fill_map(path, h, e))
        return false;
    h->filled = h->holes;
    h->holes = 0;
    return true;
}

/* Householder's reduction to a tridiagonal matrix, its eigenvalues and vectors by implicit QL steps, and the vectors
   turned back (Wilkinson and Reinsch, Handbook for Automatic Computation II, 1971, II/2 tred2, II/4 imtql2). The
   reduction begins at the last row, which becomes the top of the tridiagonal matrix, where QL takes eigenvalues first.
   Its shift is not Wilkinson's, the eigenvalue of the top 2 x 2 that is nearer to its corner, but the larger one: where
   large ones begin at the top, they come one after the other. It ends when all above `least` are found; how many these
   are Sturm's sequence tells beforehand. */
#include "num/eigen.h"

#include <math.h>
#include <stddef.h>

#include "base/stopwatch.h"
#include "num/lanes.h"

enum { SWEEPS = 60 }; /* most QL steps for an eigenvalue; 1.7 are usual */

static inline __attribute__((always_inline)) double dot(int n, const double *x, const double *y)
{
    double sum[LANES] = {0};
    int i = 0;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += x[i + l] * y[i + l];
    for (int l = 0; i + l < n; l++)
        sum[l] += x[i + l] * y[i + l];
    return lanes_total(sum);
}

/* y += s x */
static inline __attribute__((always_inline)) void add(int n, double s, const double *x, double *y)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        y[i] += s * x[i];
}

/* Sweeps each pivot: of a matrix [p q'; q R] it makes [-1/p q'/p; q/p R - q q'/p], after all of them minus the inverse
   (Beaton 1964; Goodnight, Am. Stat. 33, 1979, 149). row: [n] of room. */
LANES_CLONES
static bool sweep(int n, double *a, double *row)
{
    for (int k = 0; k < n; k++) {
        double p = a[(size_t)k * n + k];
        if (!(p > 0)) return false;
        for (int i = 0; i < n; i++)
            row[i] = i <= k ? a[(size_t)k * n + i] : a[(size_t)i * n + k];
        for (int i = 0; i < n; i++)
            if (i != k) add(i + 1, -row[i] / p, row, a + (size_t)i * n);
        for (int i = 0; i < n; i++)
            a[i <= k ? (size_t)k * n + i : (size_t)i * n + k] = i == k ? -1 / p : row[i] / p;
    }
    return true;
}

bool eigen_inverse(int n, double *a)
{
    stopwatch_spend(0.15 * n * n * n);
    struct arena *room = arena_open();
    bool good = sweep(n, a, ARENA_TAKE(room, double, n));
    arena_close(room);
    for (size_t i = 0; good && i < (size_t)n * n; i++)
        a[i] = -a[i];
    return good;
}

/* ------------------------------------------------------------------ to a tridiagonal matrix */

struct tridiagonal {
    double *d, *e; /* [n] diagonal; e[i] beside it, of i and i + 1 */
    double *h;     /* [n] v'v/2 of the reflection that row i of the matrix, v [i], now is; 0: none */
};

/* Row j of the matrix, of length j + 1, less x_j y' + y_j x'; what it then adds to p = A v. */
static inline __attribute__((always_inline)) void row_step(int j, const double *x, const double *y, const double *v,
                                                           double *r, double *p)
{
    double sum[LANES] = {0}, xj = x[j], yj = y[j], vj = v[j];
    int i = 0;
    for (; i + LANES <= j; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double now = r[i + l] - (xj * y[i + l] + yj * x[i + l]);
            r[i + l] = now;
            sum[l] += now * v[i + l];
            p[i + l] += now * vj;
        }
    for (int l = 0; i + l < j; l++) {
        double now = r[i + l] - (xj * y[i + l] + yj * x[i + l]);
        r[i + l] = now;
        sum[l] += now * v[i + l];
        p[i + l] += now * vj;
    }
    r[j] -= 2 * xj * yj;
    p[j] = lanes_total(sum) + r[j] * vj;
}

/* Each step's change of the matrix waits for the next step's product with it: one pass over the memory. room: [3 n], 0.
 */
LANES_CLONES
static void reduce(int n, double *a, const struct tridiagonal *t, double *room)
{
    double *x = room, *y = room + n, *p = room + 2 * n; /* waiting: x y' + y x' */
    for (int i = n - 1; i >= 0; i--) {
        double *v = a + (size_t)i * n;
        for (int k = 0; k <= i; k++)
            v[k] -= x[i] * y[k] + y[i] * x[k];
        t->d[n - 1 - i] = v[i];
        if (i == 0) break;
        double square = dot(i, v, v), f = v[i - 1], g = f > 0 ? -sqrt(square) : sqrt(square);
        t->e[n - 1 - i] = g;
        t->h[i] = square - f * g;
        v[i - 1] = f - g;
        for (int j = 0; j < i; j++)
            row_step(j, x, y, v, a + (size_t)j * n, p);
        double scale = t->h[i] > 0 ? 1 / t->h[i] : 0, half = 0.5 * scale * scale * dot(i, v, p);
        for (int k = 0; k < i; k++) {
            x[k] = v[k];
            y[k] = p[k] * scale - half * v[k];
        }
    }
}

/* ------------------------------------------------------------------ its eigenvalues */

/* How many are above x. */
static int above(int n, const struct tridiagonal *t, double x)
{
    int count = 0;
    double q = 1;
    for (int i = 0; i < n; i++) {
        q = t->d[i] - x - (i > 0 ? t->e[i - 1] * t->e[i - 1] / q : 0);
        if (q == 0) q = -0x1p-1000;
        count += q > 0;
    }
    return count;
}

/* Vectors as rows of z, cut into blocks of WIDE columns, [blocks][n][WIDE]; these turn in registers. */
enum { WIDE = 4 * LANES };

static double *at(int n, double *z, int row, int column)
{
    return z + ((size_t)(column / WIDE) * n + row) * WIDE + column % WIDE;
}

/* The rotations of a QL step, cs[i] = (c, s) of rows i and i + 1, from `high` down to `low`. */
LANES_CLONES
static void rotate(int n, double *z, int low, int high, const double (*cs)[2])
{
    for (int first = 0; first < n; first += WIDE, z += (size_t)n * WIDE) {
        double lower[WIDE];
        memcpy(lower, z + (size_t)(high + 1) * WIDE, sizeof lower);
        for (int i = high; i >= low; i--) {
            double *row = z + (size_t)i * WIDE, c = cs[i][0], s = cs[i][1];
#pragma omp simd
            for (int k = 0; k < WIDE; k++) {
                double u = row[k], w = lower[k];
                row[k + WIDE] = s * u + c * w;
                lower[k] = c * u - s * w;
            }
        }
        memcpy(z + (size_t)low * WIDE, lower, sizeof lower);
    }
}

/* One step on rows l to m. Returns the lowest row that was turned. */
static int ql_step(const struct tridiagonal *t, int l, int m, double (*cs)[2])
{
    double *d = t->d, *e = t->e, half = 0.5 * (d[l + 1] - d[l]), r = sqrt(half * half + e[l] * e[l]), s = 1, c = 1,
           p = 0;
    double g = d[m] - d[l] - (half < 0 ? e[l] * e[l] / (r - half) : half + r);
    for (int i = m - 1; i >= l; i--) {
        double f = s * e[i], b = c * e[i];
        r = sqrt(f * f + g * g);
        e[i + 1] = r;
        if (r == 0) {
            d[i + 1] -= p;
            e[m] = 0;
            return i + 1;
        }
        s = f / r;
        c = g / r;
        g = d[i + 1] - p;
        r = (d[i] - g) * s + 2 * c * b;
        p = s * r;
        d[i + 1] = g + p;
        g = c * r - b;
        cs[i][0] = c;
        cs[i][1] = s;
    }
    d[l] -= p;
    e[l] = g;
    e[m] = 0;
    return l;
}

/* Until all eigenvalues above `least` stand in d; the rows of z become vectors. How many rows are done; -1: no end.
 */
static int ql(int n, const struct tridiagonal *t, double least, double *z, double (*cs)[2])
{
    int l = 0, wanted = above(n, t, least);
    for (int found = 0; l < n && found < wanted; l++) {
        for (int step = 0;; step++) {
            int m = l;
            while (m + 1 < n && fabs(t->e[m]) > 0x1p-53 * (fabs(t->d[m]) + fabs(t->d[m + 1])))
                m++;
            if (m == l) break;
            if (step == SWEEPS) return -1;
            rotate(n, z, ql_step(t, l, m, cs), m - 1, (const double(*)[2])cs);
        }
        found += t->d[l] > least;
    }
    return l;
}

LANES_CLONES
static void turn_back(int n, const double *a, const double *h, double *z)
{
    for (int i = 1; i < n; i++)
        if (h[i] > 0) add(i, -dot(i, a + (size_t)i * n, z) / h[i], a + (size_t)i * n, z);
}

int eigen_above(int n, double *a, double least, struct arena *arena, double *value, double **vector)
{
    stopwatch_spend(0.7 * n * n * n);
    struct arena *room = arena_open();
    struct tridiagonal t = {ARENA_TAKE(room, double, n), ARENA_TAKE(room, double, n), ARENA_TAKE(room, double, n)};
    double *z = ARENA_TAKE(room, double, (size_t)n *(n + WIDE)),
           (*cs)[2] = (double(*)[2])ARENA_TAKE(room, double, 2 * n);
    int *order = ARENA_TAKE(room, int, n), found = 0;
    reduce(n, a, &t, ARENA_TAKE(room, double, 3 * n));
    for (int i = 0; i < n; i++)
        *at(n, z, i, n - 1 - i) = 1;
    int done = ql(n, &t, least, z, cs);
    for (int i = 0; i < done; i++)
        if (t.d[i] > least) {
            int k = found++;
            for (; k > 0 && t.d[order[k - 1]] < t.d[i]; k--)
                order[k] = order[k - 1];
            order[k] = i;
        }
    *vector = ARENA_TAKE(arena, double, (size_t)found *n);
    for (int k = 0; k < found; k++) {
        double *to = *vector + (size_t)k * n;
        for (int i = 0; i < n; i++)
            to[i] = *at(n, z, order[k], i);
        turn_back(n, a, t.h, to);
        value[k] = t.d[order[k]];
    }
    arena_close(room);
    return done < 0 ? -1 : found;
}

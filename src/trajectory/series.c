/* See series.h. */
#include "trajectory/series.h"

#include <math.h>
#include <string.h>

#include "file/csv.h"
#include "num/real.h"

static bool series_column(const struct csv *t, const char *name, const char *const columns[2], double *out,
                          struct err *e)
{
    int column = csv_column(t, name);
    if (column < 0)
        return err_set(e, ERR_SCENE,
                       "%s: there is no column '%s'; what is read here are time_s, %s%s%s, separated by commas",
                       t->file, name, columns[0], columns[1] ? ", " : "", columns[1] ? columns[1] : "");
    for (size_t i = 0; i < t->rows; i++)
        if (!csv_number(t, i, column, &out[i], e)) return false;
    return true;
}

bool series_read(const char *file, const char *const columns[2], struct arena *a, struct series *s, struct err *e)
{
    struct csv t;
    if (!csv_read(file, a, &t, e)) return false;
    *s = (struct series){.n = t.rows, .lines = t.lines, .time = ARENA_TAKE(a, double, t.rows + 1)};
    if (!series_column(&t, "time_s", columns, s->time, e)) return false;
    for (int k = 0; k < 2 && columns[k]; k++) {
        s->x[k] = ARENA_TAKE(a, double, t.rows + 1);
        if (!series_column(&t, columns[k], columns, s->x[k], e)) return false;
    }
    if (t.rows < 2)
        return err_set(e, ERR_SCENE, "%s: %zu row%s; at least 2 are needed: add some", file, t.rows,
                       t.rows == 1 ? "" : "s");
    for (size_t i = 1; i < s->n; i++)
        if (!(s->time[i] > s->time[i - 1]))
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'time_s': %.9g s comes after %.9g s; times must rise from row to row", file,
                           t.lines[i], s->time[i], s->time[i - 1]);
    return true;
}

static const double NEAREST = 1e-9; /* s */

bool series_spaced(const struct series *s, const char *file, struct err *e)
{
    for (size_t i = 1; i < s->n; i++)
        if (s->time[i] - s->time[i - 1] < NEAREST)
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'time_s': %.9g s comes %.3g s after the row before; a smooth way through the "
                           "rows needs them 1 ns apart or more: remove one of them",
                           file, s->lines[i], s->time[i], s->time[i] - s->time[i - 1]);
    return true;
}

/* Interpolation. With h_i = x_{i+1} - x_i, natural ends b_0 = b_{n-1} = 0, the second derivatives b solve the
   tridiagonal system

     h_{i-1} b_{i-1} / 6 + (h_{i-1} + h_i) b_i / 3 + h_i b_{i+1} / 6 = (y_{i+1} - y_i) / h_i - (y_i - y_{i-1}) / h_{i-1}
       R b = Q'y

   Smoothing (C. Reinsch, Numer. Math. 10 (1967) 177; P. Green, B. Silverman, Nonparametric Regression, 1994, section
   2.3): the f that minimises sum w_i (y_i - f(x_i))^2 + p integral f''^2 dx is a natural cubic spline with

     (R + p Q' W^-1 Q) b = Q'y,      f(x_i) = y_i - p (W^-1 Q b)_i

   five bands, solved by L D L'. w_i is the knot's share of the axis, (h_{i-1} + h_i) / 2, so that the cut-off does not
   follow the density of the knots. On evenly spaced knots, at distance h, a sine of theta rad per knot is multiplied by
   r / (r + p q^2 / h) with r = h (2 + cos theta) / 3 and q = 4 sin^2(theta / 2) / h; p is such that this is 1/sqrt 2 at
   the cut-off (of the mean distance, where distances differ). */

/* (Q'y)_i for i = 1 .. n - 2 */
static double bent(const double *x, const double *y, size_t i)
{
    return (y[i + 1] - y[i]) / (x[i + 1] - x[i]) - (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
}

void series_cubic_natural(struct cubic *c, size_t n, const double *at, const double *y, struct arena *a)
{
    *c = (struct cubic){.n = n, .at = at, .y = ARENA_TAKE(a, double, n), .bend = ARENA_TAKE(a, double, n)};
    double *over = ARENA_TAKE(a, double, n); /* upper band over the pivot */
    memcpy(c->y, y, n * sizeof *y);
    for (size_t i = 1; i + 1 < n; i++) {
        double low = (at[i] - at[i - 1]) / 6, high = (at[i + 1] - at[i]) / 6,
               pivot = 2 * (low + high) - low * over[i - 1];
        over[i] = high / pivot;
        c->bend[i] = (bent(at, y, i) - low * c->bend[i - 1]) / pivot;
    }
    for (size_t i = n - 1; i-- > 1;)
        c->bend[i] -= over[i] * c->bend[i + 1];
}

static double penalty(double h, double cutoff)
{
    double s = real_sinpi(cutoff * h), q = 4 * s * s / h, r = h * (3 - 2 * s * s) / 3;
    return (sqrt(2) - 1) * r * h / (q * q);
}

/* The five bands of R + p Q' W^-1 Q for knots 1 .. n - 2: main, beside it, and next but one. */
static void reinsch_bands(size_t n, const double *x, double p, double *main, double *beside, double *far)
{
    for (size_t i = 1; i + 1 < n; i++) {
        double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
        double before = i > 1 ? x[i - 1] - x[i - 2] : 0, h2 = i + 2 < n ? x[i + 2] - x[i + 1] : 0;
        double w0 = 2 / (before + h0), w1 = 2 / (h0 + h1), w2 = 2 / (h1 + h2), c0 = 1 / h0, c1 = 1 / h1, m = -(c0 + c1);
        main[i] = (h0 + h1) / 3 + p * (w0 * c0 * c0 + w1 * m * m + w2 * c1 * c1);
        beside[i] = i + 2 < n ? h1 / 6 + p * (w1 * m * c1 - w2 * c1 * (c1 + 1 / h2)) : 0;
        far[i] = i + 3 < n ? p * w2 * c1 / h2 : 0;
    }
}

void series_cubic_smooth(size_t n, const double *x, const double *y, double cutoff, double *y_smooth, struct arena *a)
{
    double p = penalty((x[n - 1] - x[0]) / (double)(n - 1), cutoff);
    double *d = ARENA_TAKE(a, double, n), *l1 = ARENA_TAKE(a, double, n), *l2 = ARENA_TAKE(a, double, n),
           *b = ARENA_TAKE(a, double, n + 1);
    reinsch_bands(n, x, p, d, l1, l2);
    for (size_t i = 1; i + 1 < n; i++) { /* L D L', and L z = Q'y */
        b[i] = bent(x, y, i);
        if (i > 1) {
            d[i] -= l1[i - 1] * l1[i - 1] * d[i - 1];
            l1[i] -= l1[i - 1] * l2[i - 1] * d[i - 1];
            b[i] -= l1[i - 1] * b[i - 1];
        }
        if (i > 2) {
            d[i] -= l2[i - 2] * l2[i - 2] * d[i - 2];
            b[i] -= l2[i - 2] * b[i - 2];
        }
        l1[i] /= d[i];
        l2[i] /= d[i];
    }
    for (size_t i = n - 1; i-- > 1;)
        b[i] = b[i] / d[i] - (i + 2 < n ? l1[i] * b[i + 1] : 0) - (i + 3 < n ? l2[i] * b[i + 2] : 0);
    b[0] = b[n - 1] = 0;
    for (size_t i = 0; i < n; i++) {
        double before = i > 0 ? x[i] - x[i - 1] : 0, after = i + 1 < n ? x[i + 1] - x[i] : 0, qb = 0;
        if (i > 0) qb += (b[i - 1] - b[i]) / before;
        if (i + 1 < n) qb += (b[i + 1] - b[i]) / after;
        y_smooth[i] = y[i] - p * 2 / (before + after) * qb;
    }
}

void series_cubic_at(const struct cubic *c, size_t i, double x, double out[4])
{
    double h = c->at[i + 1] - c->at[i], b0 = c->bend[i], b1 = c->bend[i + 1], third = (b1 - b0) / h, s = x - c->at[i];
    double first = (c->y[i + 1] - c->y[i]) / h - h * (2 * b0 + b1) / 6;
    if (s < 0 || s > h) { /* beyond the ends */
        double edge = s < 0 ? 0 : h;
        out[1] = first + edge * (b0 + edge * third / 2);
        out[0] = (s < 0 ? c->y[i] : c->y[i + 1]) + out[1] * (s - edge);
        out[2] = out[3] = 0;
        return;
    }
    out[0] = c->y[i] + s * (first + s * (b0 / 2 + s * third / 6));
    out[1] = first + s * (b0 + s * third / 2);
    out[2] = b0 + s * third;
    out[3] = third;
}

size_t series_cubic_find(size_t n, const double *at, double x)
{
    size_t low = 0, high = n - 2;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (at[middle] <= x)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

/* Extremes. Golden section: W. Press et al., Numerical Recipes, section 10.2; a triple of instants whose middle one
   is the least is narrowed to 1e-9 of a step, where y differs from its extreme by 1e-18 of what it varies by in a step.
   Two sides of a jump are two extremes: the triple closes in on its lower side. */

enum { SCAN_CHUNK = 256 };

static double scan_at(const struct scan *s, double sign, double t)
{
    double y;
    s->at(s->self, 1, &t, &y);
    return sign * y;
}

/* Least of sign y between t[0] and t[2], y(t[1]) being the least so far. */
static double golden(const struct scan *s, double sign, const double t[3], double least)
{
    static const double SHARE = 0.38196601125010515;
    double low = t[0], middle = t[1], high = t[2], width = 1e-9 * (high - low);
    while (high - low > width && low < middle && middle < high) {
        double try = high - middle > middle - low ? middle + SHARE * (high - middle) : middle - SHARE * (middle - low),
               y = scan_at(s, sign, try);
        if (y < least) {
            if (try > middle)
                low = middle;
            else
                high = middle;
            middle = try;
            least = y;
        } else if (try > middle)
            high = try;
        else
            low = try;
    }
    return least;
}

/* One side: sign +1 for the least value, -1 for the greatest. y[3]: values at instants t[3]. */
static void scan_triple(const struct scan *s, double sign, const double t[3], const double y[3], double *best)
{
    double a = sign * y[0], b = sign * y[1], c = sign * y[2];
    if (b > a || b > c || b - (fmax(a, c) - b) >= *best) return;
    *best = fmin(*best, golden(s, sign, t, b));
}

struct window {
    double t[3], y[3];
    long n;
};

static void window_add(struct window *w, double t, double y)
{
    for (int k = 0; k < 2; k++) {
        w->t[k] = w->t[k + 1];
        w->y[k] = w->y[k + 1];
    }
    w->t[2] = t;
    w->y[2] = y;
    w->n++;
}

/* An extreme between an end and the instant beside it: y then falls away from the end. */
static void scan_end(const struct scan *s, double end, double beside, double best[2])
{
    const double t[3] = {end < beside ? end : beside, end + 1e-6 * (beside - end), end < beside ? beside : end};
    double y[3];
    s->at(s->self, 3, t, y);
    for (int k = 0; k < 2; k++)
        scan_triple(s, k ? -1 : 1, t, y, &best[k]);
}

void series_range(const struct scan *s, double from, double to, long steps, double range[2])
{
    double t[SCAN_CHUNK], y[SCAN_CHUNK], best[2] = {HUGE_VAL, HUGE_VAL};
    struct window w = {.n = 0};
    for (long first = 0; first <= steps; first += SCAN_CHUNK) {
        size_t some = (size_t)(steps + 1 - first < SCAN_CHUNK ? steps + 1 - first : SCAN_CHUNK);
        for (size_t i = 0; i < some; i++)
            t[i] = from + (to - from) * ((double)(first + (long)i) / (double)steps);
        s->at(s->self, some, t, y);
        for (size_t i = 0; i < some; i++) {
            window_add(&w, t[i], y[i]);
            for (int k = 0; k < 2; k++) {
                double sign = k ? -1 : 1;
                best[k] = fmin(best[k], sign * y[i]);
                if (w.n >= 3) scan_triple(s, sign, w.t, w.y, &best[k]);
            }
        }
    }
    scan_end(s, from, from + (to - from) / (double)steps, best);
    scan_end(s, to, to - (to - from) / (double)steps, best);
    range[0] = best[0];
    range[1] = -best[1];
}

/* The interpolating cubic spline (de Boor, A Practical Guide to Splines, 2001, ch. IV), by its slopes m_k at the knots
   x_k: with h_k = x_(k+1) - x_k and the chords' slopes d_k = (f_(k+1) - f_k)/h_k its second derivative goes on through
   a knot where

       h_k m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_(k-1) m_(k+1) = 3 (h_k d_(k-1) + h_(k-1) d_k),

   and at both ends the third goes on through the knot next to the end ("not a knot": polynomials of degree 3 come out
   as they are),

       h_1 m_0 + (h_0 + h_1) m_1 = ((3 h_0 + 2 h_1) h_1 d_0 + h_0^2 d_1)/(h_0 + h_1).

   Three knots give their parabola. Slopes follow by elimination without pivots: after the first step every pivot is
   larger than what stands beside it.

   Growth: the largest sum of the cardinal splines' absolute values (Lebesgue's constant), at eighths of each interval.
   A cardinal spline falls at least by half from knot to knot, so those of knots 32 apart are computed as one. */
#include "response/places_spline.h"

#include <math.h>

/* Row k of the equations: m[k - 1], m[k], m[k + 1], and of the right side d[k - 1], d[k] (at the ends the two chords
 * next to it). */
struct row {
    double before, at, after, left, right;
};

static struct row row_of(int n, const double *h, int k)
{
    if (n == 3) { /* the parabola */
        double sum = h[0] + h[1];
        if (k == 1) return (struct row){0, 1, 0, h[1] / sum, h[0] / sum};
        return k == 0 ? (struct row){0, 1, 0, 1 + h[0] / sum, -h[0] / sum}
                      : (struct row){0, 1, 0, -h[1] / sum, 1 + h[1] / sum};
    }
    if (k == 0)
        return (struct row){0, h[1], h[0] + h[1], (3 * h[0] + 2 * h[1]) * h[1] / (h[0] + h[1]),
                            h[0] * h[0] / (h[0] + h[1])};
    if (k == n - 1) {
        double last = h[n - 2], next = h[n - 3];
        return (struct row){last + next, next, 0, last * last / (last + next),
                            (3 * last + 2 * next) * next / (last + next)};
    }
    return (struct row){h[k], 2 * (h[k - 1] + h[k]), h[k - 1], 3 * h[k], 3 * h[k - 1]};
}

/* The chord on whose left side row k's right side begins. */
static int chord(int n, int k) { return k == 0 ? 0 : k == n - 1 ? n - 3 : k - 1; }

struct places_spline places_spline_make(struct arena *a, int n, const double *at)
{
    struct places_spline s = {n, ARENA_TAKE(a, double, n - 1), ARENA_TAKE(a, double, n), ARENA_TAKE(a, double, n),
                              ARENA_TAKE(a, double, n)};
    for (int k = 0; k + 1 < n; k++)
        s.step[k] = at[k + 1] - at[k];
    for (int k = 0; k < n; k++) {
        struct row r = row_of(n, s.step, k);
        s.below[k] = k > 0 ? r.before / s.pivot[k - 1] : 0;
        s.pivot[k] = r.at - (k > 0 ? s.below[k] * s.above[k - 1] : 0);
        s.above[k] = r.after;
    }
    return s;
}

/* m = left (f_(c+1) - f_c) + right (f_(c+2) - f_(c+1)), less `below` of the row before. */
static void begin(int count, double left, double right, double below, const double *const *f, const double *before,
                  double *m)
{
    const double *x = f[0], *y = f[1], *z = f[2];
    for (int i = 0; i < count; i++)
        m[i] = left * (y[i] - x[i]) + right * (z[i] - y[i]) - below * before[i];
}

void places_spline_slopes(const struct places_spline *s, int count, const double *const *f, double *const *m)
{
    for (int k = 0; k < s->n; k++) {
        struct row r = row_of(s->n, s->step, k);
        int c = chord(s->n, k);
        begin(count, r.left / s->step[c], r.right / s->step[c + 1], s->below[k], f + c, k > 0 ? m[k - 1] : f[0], m[k]);
    }
    for (int k = s->n - 1; k >= 0; k--) {
        const double *after = k + 1 < s->n ? m[k + 1] : m[k];
        double above = k + 1 < s->n ? s->above[k] : 0, pivot = s->pivot[k];
        for (int i = 0; i < count; i++)
            m[k][i] = (m[k][i] - above * after[i]) / pivot;
    }
}

enum { APART = 32, PARTS = 8 };

double places_spline_grows(const struct places_spline *s, struct arena *a)
{
    int count = s->n < APART ? s->n : APART;
    double *f = ARENA_TAKE(a, double, (size_t)s->n *(size_t)count),
           *m = ARENA_TAKE(a, double, (size_t)s->n *(size_t)count), most = 1;
    const double **from = ARENA_TAKE(a, const double *, s->n);
    double **to = ARENA_TAKE(a, double *, s->n);
    for (int k = 0; k < s->n; k++) {
        from[k] = f + (size_t)k * (size_t)count;
        to[k] = m + (size_t)k * (size_t)count;
        f[(size_t)k * (size_t)count + (size_t)(k % count)] = 1;
    }
    places_spline_slopes(s, count, from, to);
    for (int part = 1; part < PARTS; part++) {
        double u = (double)part / PARTS, v = 1 - u;
        for (int k = 0; k + 1 < s->n; k++) {
            double sum = 0;
            for (int i = 0; i < count; i++)
                sum += fabs(v * v * (v + 3 * u) * from[k][i] + u * u * (u + 3 * v) * from[k + 1][i] +
                            s->step[k] * u * v * (v * to[k][i] - u * to[k + 1][i]));
            most = fmax(most, sum);
        }
    }
    return most;
}

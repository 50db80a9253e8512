/* Limited curvature (papers/000 equations 4, 5): T(c) = tanh(alpha c) / alpha, c = z''.

   On a cubic spline c is linear between knots, so the mean of T over a piece from c0 to c1 is closed form (x = alpha c):

     mean T = [log cosh x1 - log cosh x0] / (alpha (x1 - x0)),   log cosh x = |x| + log(1 + e^(-2|x|)) - log 2

   The two parts of log cosh are subtracted separately: |x1| - |x0| is exact for large x, where the other vanishes. For |x1 - x0| < 1e-3 the
   corrected trapezoid (T0 + T1)/2 - (x1 - x0)^2/12 T'' is used; its error is (x1 - x0)^4 |T''''| / 720 < 3e-14. Absolute error of
   alpha mean T in all below 2e-12.

   The first moment about the piece's middle needs J(x) = integral of t tanh t from 0 to x = sgn(x) (x^2/2 - G(|x|)),

     G(x) = pi^2/24 - x w + Li2(-e^(-2x))/2,   w = log(1 + e^(-2x)),   Li2(-e^(-2x)) = sum_k B_k (-w)^(k+1)/(k+1)!   (Bernoulli numbers)

   again with the parts that cancel taken apart: for x0, x1 of one sign the squares drop out. Below |x1 - x0| = 0.05 the moment of the
   straight line through T0 and T1 is used, (T1 - T0)/12, off by at most 4e-7 / alpha. */
#include "surface/curvature.h"

#include <limits.h>
#include <math.h>

#include "num/lanes.h"
#include "num/vecmath.h"

struct curvature_way curvature_way_make(struct arena *a, struct profile *p, double offset, double scale, double longest)
{
    return (struct curvature_way){.profile = p, .offset = offset, .scale = scale, .longest = longest, .first = LONG_MIN,
                                  .slope = ARENA_TAKE(a, double, CURVATURE_KNOTS), .bend = ARENA_TAKE(a, double, CURVATURE_KNOTS),
                                  .work = ARENA_TAKE(a, double, CURVATURE_KNOTS + 2)};
}

/* Makes sure that knots cell and cell + 1 are held; more of them lie ahead than behind. */
static long held(struct curvature_way *w, long cell, bool forwards)
{
    if (w->first == LONG_MIN || cell < w->first || cell + 1 >= w->first + CURVATURE_KNOTS) {
        w->first = forwards ? cell - 8 : cell + 10 - CURVATURE_KNOTS;
        profile_knots(w->profile, w->first, CURVATURE_KNOTS, w->work, (struct profile_knots){.slope = w->slope, .curvature = w->bend});
    }
    return cell - w->first;
}

/* A knot has its own numbers whether it is reached from the cell before it or from the one after: where the buffer was full, or which way
   the stroke went, does not show in the last bits. */
static void add_point(struct curvature_way *w, struct curvature_pieces *p, long knot, double share, double alpha)
{
    double b0 = w->bend[knot], b1 = w->bend[knot + 1], rise = b1 - b0;
    int k = p->points++;
    p->alpha[k] = alpha;
    p->bend[k] = share == 1 ? b1 : b0 + share * rise;
    p->slope[k] = share == 1 ? w->slope[knot + 1] : w->slope[knot] + w->profile->pitch * share * (b0 + share / 2 * rise);
}

bool curvature_cut(struct curvature_way *w, struct curvature_stretch *s, struct curvature_pieces *p)
{
    double h = w->profile->pitch, q = s->cut ? s->q : (w->offset + w->scale * s->u) / h;
    double end = (w->offset + w->scale * s->end) / h;
    double longest = fmax(w->longest * fabs(w->scale) / h, 1e-15 * (fabs(q) + fabs(end))); /* at least: q + longest is not q */
    bool forwards = end > q;
    long cell = (long)(forwards ? floor(q) : ceil(q) - 1);
    bool chained = false;
    while (q != end) {
        if (p->n == CURVATURE_PIECES) {
            s->q = q;
            s->cut = true;
            return false;
        }
        double edge = (double)(forwards ? cell + 1 : cell), next = forwards ? fmin(edge, end) : fmax(edge, end);
        if (fabs(next - q) > longest)
            next = forwards ? q + longest : q - longest;
        long knot = held(w, cell, forwards);
        if (!chained)
            add_point(w, p, knot, q - (double)cell, s->alpha);
        chained = true;
        int i = p->n++;
        p->at[i] = p->points - 1;
        p->interval[i] = s->interval;
        p->heading[i] = s->end > s->u ? 1 : -1;
        p->length[i] = fabs(next - q) * h / fabs(w->scale);
        add_point(w, p, knot, next - (double)cell, s->alpha);
        q = next;
        if (q == edge)
            cell += forwards ? 1 : -1;
    }
    return true;
}

/* rest[k] = G(|x[k]|) above; w <= log 2, so that the first term left out is below 5e-16. */
LANES_CLONES
static void points_rest(const double *x, const double *soft, double *rest, int n)
{
    for (int k = 0; k < n; k++) {
        double w = soft[k], v = w * w;
        double odd = 1 + v * (1.0 / 36 + v * (-1.0 / 3600 + v * (1.0 / 211680 + v * (-1.0 / 10886400 + v * (1.0 / 526901760 +
                     v * (-691.0 / 16999766784000.0 + v * (1.0 / 1120863744000.0)))))));
        rest[k] = 0.41123351671205660911810 - fabs(x[k]) * w - 0.5 * w * odd - 0.125 * v;
    }
}

LANES_CLONES
static void pieces_mean(struct curvature_pieces *p, const double *x, const double *soft)
{
    const double *t = p->limited;
    for (int i = 0; i < p->n; i++) {
        int a = p->at[i], b = a + 1;
        double alpha = p->alpha[a], dx = x[b] - x[a], tm = 0.5 * alpha * (t[a] + t[b]);
        double near = tm + dx * dx / 6 * tm * (1 - tm * tm);
        double far = ((fabs(x[b]) - fabs(x[a])) + (soft[b] - soft[a])) / (fabs(dx) < 1e-3 ? 1 : dx);
        p->mean[i] = (fabs(dx) < 1e-3 ? near : far) / alpha;
    }
}

LANES_CLONES
static void pieces_moment(struct curvature_pieces *p, const double *x, const double *soft, const double *rest)
{
    const double *t = p->limited;
    for (int i = 0; i < p->n; i++) {
        int a = p->at[i], b = a + 1;
        double dx = x[b] - x[a], across = x[a] * x[b], sign_a = x[a] < 0 ? -1 : 1, sign_b = x[b] < 0 ? -1 : 1;
        double squares = across < 0 ? (dx < 0 ? across : -across) : 0;
        double whole = squares - (sign_b * rest[b] - sign_a * rest[a]) - 0.5 * (x[a] + x[b]) * (soft[b] - soft[a]);
        double straight = (t[b] - t[a]) / 12, far = whole / (p->alpha[a] * (fabs(dx) < 0.05 ? 1 : dx * dx));
        p->moment[i] = fabs(dx) < 0.05 ? straight : far;
    }
}

static void pieces_straight(struct curvature_pieces *p, double factor)
{
    for (int k = 0; k < p->points; k++)
        p->limited[k] = factor * p->bend[k];
    for (int i = 0; i < p->n; i++) {
        double t0 = p->limited[p->at[i]], t1 = p->limited[p->at[i] + 1];
        p->mean[i] = 0.5 * (t0 + t1);
        p->moment[i] = (t1 - t0) / 12;
    }
}

void curvature_limit(struct curvature_pieces *p, double factor, bool limiter)
{
    double x[2 * CURVATURE_PIECES], soft[2 * CURVATURE_PIECES], rest[2 * CURVATURE_PIECES];
    if (!limiter) {
        pieces_straight(p, factor);
        return;
    }
    for (int k = 0; k < p->points; k++)
        x[k] = p->alpha[k] * factor * p->bend[k];
    vecmath_tanh((size_t)p->points, x, p->limited);
    vecmath_softplus2((size_t)p->points, x, soft);
    points_rest(x, soft, rest, p->points);
    for (int k = 0; k < p->points; k++)
        p->limited[k] /= p->alpha[k];
    pieces_mean(p, x, soft);
    pieces_moment(p, x, soft, rest);
}

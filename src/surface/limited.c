/* Limited curvature: T(c) = tanh(alpha c) / alpha.

   Where c is linear, the mean of T over a piece from c0 to c1 is closed form (x = alpha c):

     mean T = [log cosh x1 - log cosh x0] / (alpha (x1 - x0)),   log cosh x = |x| + log(1 + e^(-2|x|)) - log 2

   The two parts of log cosh are subtracted separately: |x1| - |x0| is exact for large x, where the other vanishes. For
   |x1 - x0| < 1e-3 the corrected trapezoid (T0 + T1)/2 - (x1 - x0)^2/12 T'' is used; its error is (x1 - x0)^4 |T''''| /
   720 < 3e-14. Absolute error of alpha mean T in all below 2e-12.

   The first moment about the piece's middle needs J(x) = integral of t tanh t from 0 to x = sgn(x) (x^2/2 - G(|x|)),

     G(x) = pi^2/24 - x w + Li2(-e^(-2x))/2,   w = log(1 + e^(-2x)),   Li2(-e^(-2x)) = sum_k B_k (-w)^(k+1)/(k+1)!
   (Bernoulli numbers)

   again with the parts that cancel taken apart: for x0, x1 of one sign the squares drop out. Below |x1 - x0| = 0.05 the
   moment of the straight line through T0 and T1 is used, (T1 - T0)/12, and the next term of the series, -(x1 -
   x0)^3/720 T''': off by at most 1e-9 / alpha.

   Where c bulges above its chord by 4 b q (1 - q) (q from 0 to 1), the mean gains, to first order in b and by one
   integration by parts, 4 b integral of T'(c) q (1 - q) dq = 8 b moment / (c1 - c0),   or 2/3 b (T' + (x1 - x0)^2/40
   T''') where |x1 - x0| < 0.05. The second order is below 0.22 alpha b^2. Cutting a piece in two quarters b: where
   alpha |b| > 1/64 and tanh is not flat, a piece is halved until neither holds, and its mean and moment are gathered
   from the parts (leaves). */
#include "surface/limited.h"

#include <math.h>
#include <stddef.h>

#include "num/lanes.h"
#include "num/vecmath.h"

#define INLINE static inline __attribute__((always_inline))

/* rest[k] = G(|x[k]|) above; w <= log 2, so that the first term left out is below 5e-16. */
LANES_CLONES
static void points_rest(const double *x, const double *soft, double *rest, int n)
{
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double w = soft[k], big = lanes_select(w < 0x1p-200, 0, w),
               v = big * big; /* no subnormal squares: they are slow */
        double odd =
            1 +
            v * (1.0 / 36 + v * (-1.0 / 3600 +
                                 v * (1.0 / 211680 + v * (-1.0 / 10886400 +
                                                          v * (1.0 / 526901760 + v * (-691.0 / 16999766784000.0 +
                                                                                      v * (1.0 / 1120863744000.0)))))));
        rest[k] = 0.41123351671205660911810 - fabs(x[k]) * w - 0.5 * w * odd - 0.125 * v;
    }
}

/* At the points: x = alpha c, log(1 + e^(-2|x|)), G(|x|) and 1/alpha. */
struct points {
    double x[LIMITED_POINTS], soft[LIMITED_POINTS], rest[LIMITED_POINTS], per[LIMITED_POINTS];
};

/* at: NULL where the pieces are chained, whose points are then loaded one after another. */
INLINE void each_mean(const struct limited *p, const int *at, const struct points *q)
{
    const double *t = p->limited, *alphas = p->alpha, *x = q->x, *soft = q->soft, *per = q->per;
    double *restrict mean = p->mean;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at ? at[i] : i, b = a + 1;
        double alpha = alphas[a], xa = x[a], xb = x[b], dx = xb - xa, tm = 0.5 * alpha * (t[a] + t[b]);
        double near = tm + dx * dx * (1.0 / 6) * tm * (1 - tm * tm), by = lanes_select(fabs(dx) < 1e-3, 1, dx);
        double far = ((fabs(xb) - fabs(xa)) + (soft[b] - soft[a])) / by;
        mean[i] = lanes_select(fabs(dx) < 1e-3, near, far) * per[a];
    }
}

INLINE void each_moment(const struct limited *p, const int *at, const struct points *q)
{
    const double *t = p->limited, *alphas = p->alpha, *x = q->x, *soft = q->soft, *rest = q->rest, *per = q->per;
    double *restrict moment = p->moment;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at ? at[i] : i, b = a + 1;
        double alpha = alphas[a], xa = x[a], xb = x[b], dx = xb - xa, across = xa * xb,
               sign_a = lanes_select(xa < 0, -1, 1), sign_b = lanes_select(xb < 0, -1, 1);
        double squares = lanes_select(across < 0, lanes_select(dx < 0, across, -across), 0);
        double whole = squares - (sign_b * rest[b] - sign_a * rest[a]) - 0.5 * (xa + xb) * (soft[b] - soft[a]);
        double tm = 0.5 * alpha * (t[a] + t[b]),
               curved = dx * dx * dx * (1.0 / 360) * (1 - tm * tm) * (1 - 3 * tm * tm) * per[a];
        double by = lanes_select(fabs(dx) < 0.05, 1, dx * dx), straight = (t[b] - t[a]) * (1.0 / 12) + curved,
               far = whole * per[a] / by;
        moment[i] = lanes_select(fabs(dx) < 0.05, straight, far);
    }
}

LANES_CLONES
static void pieces_apart(const struct limited *p, const struct points *q)
{
    each_mean(p, p->at, q);
    each_moment(p, p->at, q);
}

LANES_CLONES
static void pieces_in_chain(const struct limited *p, const struct points *q)
{
    each_mean(p, NULL, q);
    each_moment(p, NULL, q);
}

INLINE void each_bulge(const struct limited *p, const int *at)
{
    const double *alphas = p->alpha, *c = p->curvature, *limited = p->limited, *moment = p->moment, *bulge = p->bulge;
    double *restrict mean = p->mean;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at ? at[i] : i, b = a + 1;
        double alpha = alphas[a], dc = c[b] - c[a], dx = alpha * dc, tm = 0.5 * alpha * (limited[a] + limited[b]);
        double t = tm + dx * dx / 4 * tm * (1 - tm * tm), rate = (1 - t * t) * (1 - dx * dx / 20 * (1 - 3 * t * t));
        int small = fabs(dx) < 0.05;
        mean[i] += bulge[i] * lanes_select(small, 2.0 / 3 * rate, 8 * moment[i] / lanes_select(small, 1, dc));
    }
}

/* With the question which pieces are flat, both piece by piece before, and the map's edge: a render in draft over a map
 * from 618 to 585 cycles a sample. */
LANES_CLONES
static void bulges_apart(const struct limited *p) { each_bulge(p, p->at); }

LANES_CLONES
static void bulges_in_chain(const struct limited *p) { each_bulge(p, NULL); }

static void pieces_straight(const struct limited *p)
{
    for (int k = 0; k < p->points; k++)
        p->limited[k] = p->curvature[k];
    for (int i = 0; i < p->n; i++) {
        double t0 = p->limited[p->at[i]], t1 = p->limited[p->at[i] + 1];
        p->mean[i] = 0.5 * (t0 + t1) + (p->bulge ? 2.0 / 3 * p->bulge[i] : 0);
        p->moment[i] = (t1 - t0) / 12;
    }
}

LANES_CLONES
static void points_times(int n, const double *alpha, const double *curvature, double *x)
{
#pragma omp simd
    for (int k = 0; k < n; k++)
        x[k] = alpha[k] * curvature[k];
}

LANES_CLONES
static void points_over(int n, const double *alpha, double *per, double *limited)
{
#pragma omp simd
    for (int k = 0; k < n; k++) {
        per[k] = 1 / alpha[k];
        limited[k] *= per[k];
    }
}

static void pieces_limited(const struct limited *p)
{
    struct points q;
    points_times(p->points, p->alpha, p->curvature, q.x);
    vecmath_tanh_softplus2((size_t)p->points, q.x, p->limited, q.soft);
    points_rest(q.x, q.soft, q.rest, p->points);
    points_over(p->points, p->alpha, q.per, p->limited);
    bool chained = limited_chained(p->n, p->points, p->at);
    (chained ? pieces_in_chain : pieces_apart)(p, &q);
    if (p->bulge) (chained ? bulges_in_chain : bulges_apart)(p);
}

/* ------------------------------------------------------------------ leaves */

enum { LEAVES = LIMITED_PIECES };

struct leaves {
    const struct limited *whole;
    int n, at[LEAVES], piece[LEAVES];
    double alpha[2 * LEAVES], curvature[2 * LEAVES], bulge[LEAVES], limited[2 * LEAVES], mean[LEAVES], moment[LEAVES];
    double from[LEAVES], share[LEAVES]; /* of the piece */
};

/* What is not finite is not halved for ever. */
INLINE int leaf_flat(double x0, double x1, double bulge)
{
    double b = fabs(bulge), a0 = fabs(x0), a1 = fabs(x1), least = lanes_select(a0 < a1, a0, a1);
    int much = (b > 1.0 / 64) & (b < 1e18), outside = (x0 * x1 > 0) & (least > 8 + b);
    return outside | (much == 0);
}

static void leaves_gather(struct leaves *l)
{
    const struct limited *w = l->whole;
    pieces_limited(
        &(struct limited){l->n, 2 * l->n, l->at, l->alpha, l->curvature, l->bulge, l->limited, l->mean, l->moment});
    for (int k = 0; k < l->n; k++) {
        double off = l->from[k] + 0.5 * l->share[k] - 0.5;
        w->mean[l->piece[k]] += l->share[k] * l->mean[k];
        w->moment[l->piece[k]] += l->share[k] * (off * l->mean[k] + l->share[k] * l->moment[k]);
    }
    l->n = 0;
}

/* The part of piece i from that share on, with c0 and c1 at its ends. */
static void leaves_add(struct leaves *l, int i, double from, double share, const double c[2])
{
    double alpha = l->whole->alpha[l->whole->at[i]], bulge = l->whole->bulge[i] * share * share;
    if (!leaf_flat(alpha * c[0], alpha * c[1], alpha * bulge)) {
        double middle = 0.5 * (c[0] + c[1]) + bulge;
        leaves_add(l, i, from, 0.5 * share, (double[]){c[0], middle});
        leaves_add(l, i, from + 0.5 * share, 0.5 * share, (double[]){middle, c[1]});
        return;
    }
    if (l->n == LEAVES) leaves_gather(l);
    int k = l->n++;
    l->at[k] = 2 * k;
    l->piece[k] = i;
    l->alpha[2 * k] = l->alpha[2 * k + 1] = alpha;
    l->curvature[2 * k] = c[0];
    l->curvature[2 * k + 1] = c[1];
    l->bulge[k] = bulge;
    l->from[k] = from;
    l->share[k] = share;
}

/* flat[i]: is piece i good as it is? Are all? */
LANES_CLONES
static int pieces_flat(const struct limited *p, int *flat)
{
    const double *alphas = p->alpha, *c = p->curvature, *bulge = p->bulge;
    const int *at = p->at;
    int n = p->n, all = 1;
#pragma omp simd reduction(& : all)
    for (int i = 0; i < n; i++) {
        double alpha = alphas[at[i]];
        flat[i] = leaf_flat(alpha * c[at[i]], alpha * c[at[i] + 1], alpha * bulge[i]);
        all &= flat[i];
    }
    return all;
}

/* Means and moments of the pieces that are not flat, anew from their leaves. */
static void pieces_leaves(const struct limited *p)
{
    int flat[LIMITED_PIECES];
    struct leaves l;
    if (pieces_flat(p, flat)) return;
    l.whole = p;
    l.n = 0;
    for (int i = 0; i < p->n; i++) {
        const double *c = p->curvature + p->at[i];
        if (flat[i]) continue;
        p->mean[i] = p->moment[i] = 0;
        leaves_add(&l, i, 0, 1, c);
    }
    leaves_gather(&l);
}

void limited_run(const struct limited *p, bool limiter)
{
    if (!limiter) {
        pieces_straight(p);
        return;
    }
    pieces_limited(p);
    if (p->bulge) pieces_leaves(p);
}

/* Skewness and kurtosis by the sinh-arcsinh transformation (M. Jones, A. Pewsey, Biometrika 96 (2009) 761):

     H(g) = scale sinh(e + b asinh g) - shift,   g standard normal
     H'   = scale b cosh(e + b asinh g)/sqrt(1 + g^2)
     H''  = (scale b^2 sinh(e + b asinh g) - H' g)/(1 + g^2)

   It increases, has all derivatives, and both light (b < 1) and heavy tails (b > 1); e leans it. At each b, skewness
   grows with e, so e is found by false position, and kurtosis grows with b along the curve of the skewness asked for,
   so b is found by another. Moments are sums over g at a spacing of 1/8 out to 12: the trapezoidal rule, exact to
   rounding for functions so smooth. |e| <= 5, 0.02 <= b <= 3.

   What it does to the spectrum: with c_n = E[H He_n]/sqrt(n!) the autocorrelation r of g becomes the sum of c_n^2 r^n.
   The share c_1^2 (`linear`) keeps its spectrum, the rest is spread over wider bands, up to n times as far. Coarse
   detail therefore has at least c_1^2 of the density asked for, and detail much finer than most of the height is
   steepened as H' has it: its density is multiplied by E[H'^2] = sum of n c_n^2 (`steeper`). Between them lies all;
   skewness -1 and kurtosis 5: 0.95 and 1.06 (-0.2 and 0.3 dB); 3 and 30: 0.72 and 1.49 (-1.4 and 1.7 dB). */
#include "surface/heights.h"

#include <string.h>

#include "base/stopwatch.h"
#include "num/real.h"
#include "num/vecmath.h"

#define B_LEAST 0.02
#define B_MOST 3.0
#define E_MOST 5.0

enum { CHUNK = 64, REACH = 96 }; /* 12 at a spacing of 1/8 */

static double asinh_of(double g)
{
    double a = real_log1p(fabs(g) + g * g / (1 + sqrt(1 + g * g)));
    return g < 0 ? -a : a;
}

struct moments {
    double mean, variance, skewness, kurtosis, linear, steeper;
};

struct nodes { /* of the sums over g */
    double g[2 * REACH + 1], arc[2 * REACH + 1], p[2 * REACH + 1];
};

static void nodes_make(struct nodes *n)
{
    static const double root = 0.39894228040143267794; /* 1/sqrt(2 pi) */
    for (int i = 0; i <= 2 * REACH; i++) {
        double g = n->g[i] = (i - REACH) / 8.0;
        n->arc[i] = asinh_of(g);
        n->p[i] = root * real_exp(-0.5 * g * g) / 8;
    }
}

/* Of sinh(e + b asinh g), divided by cosh(e) so that no number is large. */
static struct moments moments_of(const struct nodes *n, double e, double b)
{
    double h[2 * REACH + 1], size = 2 / (real_exp(e) + real_exp(-e)), sum[5] = {0}, first = 0, slopes = 0, mean = 0;
    for (int i = 0; i <= 2 * REACH; i++) {
        double up = real_exp(e + b * n->arc[i]), slope = size * b * 0.5 * (up + 1 / up);
        h[i] = size * 0.5 * (up - 1 / up);
        mean += n->p[i] * h[i];
        first += n->p[i] * h[i] * n->g[i];
        slopes += n->p[i] * slope * slope / (1 + n->g[i] * n->g[i]);
    }
    for (int i = 0; i <= 2 * REACH; i++) {
        double d = h[i] - mean;
        sum[2] += n->p[i] * d * d;
        sum[3] += n->p[i] * d * d * d;
        sum[4] += n->p[i] * d * d * d * d;
    }
    return (struct moments){mean / size,
                            sum[2] / (size * size),
                            sum[3] / (sum[2] * sqrt(sum[2])),
                            sum[4] / (sum[2] * sum[2]),
                            first * first / sum[2],
                            slopes / sum[2]};
}

struct aim {
    const struct nodes *nodes;
    double b, skewness, kurtosis;
};

/* Where f, rising from below 0 at lo to above at hi, is 0: false position, the end that stays counting half (Illinois).
 */
static double root_of(double (*f)(double, const struct aim *), const struct aim *aim, double lo, double hi)
{
    double at_lo = f(lo, aim), at_hi = f(hi, aim), x = lo;
    if (at_lo >= 0 || at_hi <= 0) return at_lo >= 0 ? lo : hi;
    for (int i = 0, side = 0; i < 200 && hi - lo > 1e-13 * (1 + hi); i++) {
        x = (lo * at_hi - hi * at_lo) / (at_hi - at_lo);
        double y = f(x, aim);
        if (fabs(y) < 1e-12) return x;
        if (y > 0) {
            hi = x, at_hi = y;
            at_lo *= side > 0 ? 0.5 : 1;
        } else {
            lo = x, at_lo = y;
            at_hi *= side < 0 ? 0.5 : 1;
        }
        side = y > 0 ? 1 : -1;
    }
    return x;
}

static double skewness_off(double e, const struct aim *aim)
{
    return moments_of(aim->nodes, e, aim->b).skewness - aim->skewness;
}

/* e that gives the skewness (not negative) at that b, or the most. */
static double e_for(double b, const struct aim *aim)
{
    struct aim here = *aim;
    here.b = b;
    return root_of(skewness_off, &here, 0, E_MOST);
}

static double kurtosis_off(double b, const struct aim *aim)
{
    return moments_of(aim->nodes, e_for(b, aim), b).kurtosis - aim->kurtosis;
}

static double skewness_reached(double b, const struct aim *aim)
{
    return moments_of(aim->nodes, E_MOST, b).skewness - aim->skewness;
}

static bool reach_of(const struct aim *aim, double *b_least, double range[2])
{
    *b_least = root_of(skewness_reached, aim, B_LEAST, B_MOST);
    if (skewness_reached(B_MOST, aim) <= 0) return false;
    range[0] = (kurtosis_off(*b_least, aim) + aim->kurtosis) * 1.0005;
    range[1] = (kurtosis_off(B_MOST, aim) + aim->kurtosis) * 0.9995;
    return true;
}

bool heights_range(double skewness, double range[2])
{
    struct nodes n;
    struct aim aim = {&n, 0, fabs(skewness), 0};
    double b;
    nodes_make(&n);
    return reach_of(&aim, &b, range);
}

bool heights_make(double skewness, double kurtosis, struct heights *h, struct err *err)
{
    struct nodes n;
    nodes_make(&n);
    stopwatch_spend(4e6); /* predicted cycles: two searches, one in the other */
    struct aim aim = {&n, 0, fabs(skewness), kurtosis};
    double lo, range[2];
    if (!reach_of(&aim, &lo, range))
        return err_set(err, ERR_SCENE,
                       "no height distribution with skewness %g is known to this program: choose one nearer to 0",
                       skewness);
    if (kurtosis < range[0] || kurtosis > range[1])
        return err_set(
            err, ERR_SCENE,
            "no height distribution with skewness %g and kurtosis %g is known to this program: with that skewness, "
            "kurtosis can be from %.4g to %.4g",
            skewness, kurtosis, range[0] * 1.0001, range[1] * 0.9999);
    double b = root_of(kurtosis_off, &aim, lo, B_MOST), e = e_for(b, &aim), sign = skewness < 0 ? -1 : 1;
    struct moments m = moments_of(&n, e, b);
    double scale = 1 / sqrt(m.variance);
    *h = (struct heights){.e = sign * e,
                          .b = b,
                          .scale = scale,
                          .shift = sign * scale * m.mean,
                          .linear = m.linear,
                          .steeper = m.steeper};
    return true;
}

void heights_at(const struct heights *h, size_t n, const double *g, double *z, double *slope, double *bend)
{
    double up[CHUNK];
    for (size_t at = 0; at < n; at += CHUNK) {
        size_t m = n - at < CHUNK ? n - at : CHUNK;
        for (size_t i = 0; i < m; i++) {
            double x = fabs(g[at + i]);
            up[i] = x + sqrt(1 + x * x);
        }
        vecmath_log(m, up, up);
        for (size_t i = 0; i < m; i++)
            up[i] = h->e + (g[at + i] < 0 ? -h->b : h->b) * up[i];
        vecmath_exp(m, up, up);
        for (size_t i = 0; i < m; i++) {
            double x = g[at + i], root2 = 1 + x * x, s = 0.5 * h->scale * (up[i] - 1 / up[i]),
                   c = 0.5 * h->scale * (up[i] + 1 / up[i]);
            z[at + i] = s - h->shift;
            slope[at + i] = h->b * c / sqrt(root2);
            bend[at + i] = (h->b * h->b * s - slope[at + i] * x) / root2;
        }
    }
}

/* ------------------------------------------------------------------ as a part */

struct shaped {
    struct relief_part *inner;
    struct heights heights;
    double rms;
};

/* z'' = H' g'' + H'' g' g' in each pair of directions. */
static void shaped_chain(const struct shaped *s, size_t n, double g[6][CHUNK], const struct relief_values *v, size_t at)
{
    double z[CHUNK], slope[CHUNK], bend[CHUNK], *out[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    static const int pair[6][2] = {{0, 0}, {0, 0}, {0, 0}, {1, 1}, {1, 2}, {2, 2}};
    heights_at(&s->heights, n, g[0], z, slope, bend);
    for (int k = 0; k < 6; k++)
        if (out[k])
            for (size_t i = 0; i < n; i++) {
                double d =
                    k == 0 ? z[i] : slope[i] * g[k][i] + (k > 2 ? bend[i] * g[pair[k][0]][i] * g[pair[k][1]][i] : 0);
                out[k][at + i] += s->rms * d;
            }
}

static void shaped_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct shaped *s = part->state;
    for (size_t at = 0; at < p->n; at += CHUNK) {
        size_t n = p->n - at < CHUNK ? p->n - at : CHUNK;
        double g[6][CHUNK];
        bool plane = v->y || v->xy || v->yy;
        memset(g, 0, sizeof g);
        struct relief_points some = {n, p->x + at, p->y ? p->y + at : NULL};
        struct relief_values all = {.z = g[0],
                                    .x = g[1],
                                    .y = plane ? g[2] : NULL,
                                    .xx = g[3],
                                    .xy = plane ? g[4] : NULL,
                                    .yy = plane ? g[5] : NULL};
        s->inner->add(s->inner, &some, &all);
        shaped_chain(s, n, g, v, at);
    }
}

static void shaped_close(struct relief_part *part)
{
    const struct shaped *s = part->state;
    if (s->inner->close) s->inner->close(s->inner);
}

struct relief_part *heights_part(struct arena *a, struct relief_part *g, const struct heights *h, double rms)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct shaped *s = ARENA_TAKE(a, struct shaped, 1);
    *s = (struct shaped){g, *h, rms};
    *part = *g;
    part->linear = false;
    part->add = shaped_add;
    part->reading += 60;
    part->close = shaped_close;
    part->state = s;
    return part;
}

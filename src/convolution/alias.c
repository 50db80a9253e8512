/* A mode h(t) = Im(A e^(s t)) does not end at half the sample rate: beyond its resonance its transfer function falls as
   1/omega where it begins with a jump, and what lies beyond half the rate is folded back by sampling. Below the first
   mode, where a velocity or acceleration is the small difference of what many modes say, that is most of what is heard:
   an acceleration's modes and its direct term, which cancel at 0 Hz in continuous time, no longer do.

   With T = 1/rate the trapezium rule's sum T sum' A e^(s n T) e^(-j theta n), half of n = 0 (theta = omega T), is in
   closed form

       A (T/2) coth((j theta - s T)/2),      in continuous time it is A T / (j theta - s T),

   so that what is folded in is exactly A T phi(j theta - s T),

       phi(v) = coth(v/2)/2 - 1/v = sum over k of b_k v^(2k-1), b_k = B_2k/(2k)!  (Bernoulli's numbers; |v| < 2 pi),

   a smooth function of theta in the band, whose nearest poles are the mode's images a whole rate away. A gammatone,
   t^(gamma-1) e^(s t), is the derivative of that by s, gamma - 1 times: T^gamma phi_gamma(v), phi_gamma =
   (-1)^(gamma-1) d^(gamma-1) phi / dv^(gamma-1).

   A filter on the force with taps m = -M .. M, M = ALIAS_REACH, takes it out: sum_m kappa_m e^(-j m theta) = phi(j
   theta - s T) at nodes in |theta| <= 0.8 pi, 0.4 of the rate. The even part in theta is a polynomial of degree M in
   cos theta, the odd one sin theta times one of degree M - 1; nodes in cos theta are those of Chebyshev's polynomial of
   degree M + 1 between cos 0.8 pi and 1, but the two nearest 1 are put at 1: there value, slope and curvature hold,
   whence every zero at 0 Hz, single or double, that the response has in continuous time. Between the nodes the error is
   at most 1e-4 of |A| T (a mode at 0.45 of the rate; 2e-5 at 0.05), and falls by 1.8 for each further pair of taps.
   Taps that look ahead are needed: of a filter that does not look ahead the error hardly falls with its length, by some
   5 % a tap, as phi has a branch at z = 0.

   Where poles move, taps are interpolated: kappa is an analytic function of s, known at s T = 0, j STEP, 2 j STEP, ...,
   and the cubic through the four nearest is taken at the complex s T. Rows of such places lie 2 STEP nepers a sample
   apart, each computed when it is first asked for; a mode that decays by more than the last of them reaches, 31 STEP,
   gets taps of its own.

   The taps are linear in A: those of all modes are added up before they meet the force. A mode that is left out leaves
   out its direct term and these taps, too. */
#include "convolution/alias.h"

#include <math.h>

#include "num/lanes.h"
#include "num/real.h"

enum {
    M = ALIAS_REACH,
    NODES = M - 1,
    SERIES = 20,
    ORDERS = 3,
    MOST = 6,
    PLACES = 128,
    ROWS = 16
}; /* nodes beside 0 Hz; orders: value, slope, curvature; derivatives of phi */

#define TOP 0.8 /* of pi */
#define STEP (REAL_PI / PLACES)
#define NEAR                                                                                                           \
    1.5 /* |v| up to which the series is summed: 20 terms leave (1.5 / 2 pi)^40 = 1e-25, fifth derivatives 1e-17 */

struct z {
    double re, im;
};

struct alias {
    int gamma;
    double rate;
    double turn[NODES];                   /* theta of the nodes            */
    struct z circle[NODES];               /* e^(-j theta)                  */
    double even[M + 1][M + 1], odd[M][M]; /* values at the nodes to taps   */
    double series[ORDERS][SERIES];        /* of derivatives gamma - 1, ... */
    struct arena *arena;
    double (*re[ROWS])[ALIAS_TAPS], (*im[ROWS])[ALIAS_TAPS]; /* of row r [PLACES + 4] taps of s T = -2 r STEP + j STEP
                                                                (-1, 0, 1, ...); NULL: not yet asked for */
};

static struct z times(struct z a, struct z b)
{
    return (struct z){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static struct z over(struct z a, struct z b)
{
    double power = b.re * b.re + b.im * b.im;
    return (struct z){(a.re * b.re + a.im * b.im) / power, (a.im * b.re - a.re * b.im) / power};
}

/* ------------------------------------------------------------------ phi and its derivatives */

/* By the series; term k has the power 2k - 1 - order. */
static struct z near(const struct alias *f, int which, struct z v)
{
    struct z square = times(v, v), sum = {0, 0};
    int order = f->gamma - 1 + which,
        first = order / 2; /* of the terms from 0 on, the first whose power is not negative */
    for (int k = SERIES - 1; k >= first; k--) {
        sum = times(sum, square);
        sum.re += f->series[which][k];
    }
    return order % 2 ? sum : times(sum, v);
}

/* By closed form: derivatives of C = coth(v/2) are polynomials in C, as dC/dv = (1 - C^2)/2. q = e^(-v). */
static struct z far(int order, struct z v, struct z q)
{
    static const double poly[MOST][MOST + 1] = {
        {0, 1}, {1, 0, -1}, {0, -2, 0, 2}, {-2, 0, 8, 0, -6}, {0, 16, 0, -40, 0, 24}, {16, 0, -136, 0, 240, 0, -120}};
    struct z c = over((struct z){1 + q.re, q.im}, (struct z){1 - q.re, -q.im}), one = {1, 0}, inverse = over(one, v),
             power = inverse, sum = {0, 0};
    double scale = 0.5;
    for (int k = MOST; k >= 0; k--) {
        sum = times(sum, c);
        sum.re += poly[order][k];
    }
    for (int k = 1; k <= order; k++) {
        power = times(power, (struct z){-k * inverse.re, -k * inverse.im});
        scale *= 0.5;
    }
    return (struct z){scale * sum.re - power.re, scale * sum.im - power.im};
}

/* Derivative gamma - 1 + which of phi, with phi_gamma's sign. */
static struct z phi(const struct alias *f, int which, struct z v, struct z q)
{
    struct z value = v.re * v.re + v.im * v.im < NEAR * NEAR ? near(f, which, v) : far(f->gamma - 1 + which, v, q);
    return f->gamma % 2 ? value : (struct z){-value.re, -value.im};
}

/* ------------------------------------------------------------------ the fit */

/* a becomes its inverse: Gauss and Jordan, the largest pivot of each column. */
static void invert(int n, double *a, double *inverse)
{
    for (int i = 0; i < n * n; i++)
        inverse[i] = i % (n + 1) == 0;
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            best = fabs(a[i * n + k]) > fabs(a[best * n + k]) ? i : best;
        for (int j = 0; j < n; j++) {
            double x = a[best * n + j], y = inverse[best * n + j];
            a[best * n + j] = a[k * n + j], inverse[best * n + j] = inverse[k * n + j];
            a[k * n + j] = x, inverse[k * n + j] = y;
        }
        double per = 1 / a[k * n + k];
        for (int j = 0; j < n; j++)
            a[k * n + j] *= per, inverse[k * n + j] *= per;
        for (int i = 0; i < n; i++) {
            double share = i == k ? 0 : a[i * n + k];
            for (int j = 0; j < n && share != 0; j++)
                a[i * n + j] -= share * a[k * n + j], inverse[i * n + j] -= share * inverse[k * n + j];
        }
    }
}

/* Rows: value and curvature at 0, or the slope there; then the nodes. Columns: cos m theta, m = 0 .. M, or sin m theta,
 * m = 1 .. M. */
static void set_fit(struct alias *f)
{
    double even[(M + 1) * (M + 1)], odd[M * M];
    for (int m = 0; m <= M; m++) {
        even[m] = 1;
        even[M + 1 + m] = -(double)m * m;
        for (int k = 0; k < NODES; k++)
            even[(k + 2) * (M + 1) + m] = real_cos(m * f->turn[k]);
    }
    for (int m = 1; m <= M; m++) {
        odd[m - 1] = m;
        for (int k = 0; k < NODES; k++)
            odd[(k + 1) * M + m - 1] = real_sin(m * f->turn[k]);
    }
    invert(M + 1, even, f->even[0]);
    invert(M, odd, f->odd[0]);
}

static void set_series(struct alias *f)
{
    static const double b[SERIES] = {
        0.08333333333333333,   -0.001388888888888889,   3.306878306878307e-05,  -8.267195767195768e-07,
        2.08767569878681e-08,  -5.284190138687493e-10,  1.3382536530684679e-11, -3.3896802963225827e-13,
        8.586062056277845e-15, -2.174868698558062e-16,  5.5090028283602295e-18, -1.3954464685812522e-19,
        3.534707039629467e-21, -8.953517427037546e-23,  2.267952452337683e-24,  -5.744790668872202e-26,
        1.455172475614865e-27, -3.6859949406653103e-29, 9.336734257095045e-31,  -2.36502241570063e-32};
    for (int which = 0; which < ORDERS; which++)
        for (int k = 0; k < SERIES; k++) {
            f->series[which][k] = b[k];
            for (int j = 0; j < f->gamma - 1 + which; j++)
                f->series[which][k] *= 2 * k + 1 - j; /* 0 where the power is less than the order */
        }
}

/* ------------------------------------------------------------------ a mode's taps */

struct parts { /* of phi as a function of theta: even, and j times the odd one */
    struct z even[M + 1], odd[M];
};

/* d phi/d theta = j phi', the second -phi''. */
static void look(const struct alias *f, struct z v, struct z q, struct parts *p)
{
    struct z slope = phi(f, 1, v, q), bend = phi(f, 2, v, q);
    p->even[0] = phi(f, 0, v, q);
    p->even[1] = (struct z){-bend.re, -bend.im};
    p->odd[0] = (struct z){-slope.re, -slope.im};
    for (int k = 0; k < NODES; k++) {
        struct z mirrored = {f->circle[k].re, -f->circle[k].im};
        struct z up = phi(f, 0, (struct z){v.re, v.im + f->turn[k]}, times(q, f->circle[k]));
        struct z down = phi(f, 0, (struct z){v.re, v.im - f->turn[k]}, times(q, mirrored));
        p->even[k + 2] = (struct z){0.5 * (up.re + down.re), 0.5 * (up.im + down.im)};
        p->odd[k + 1] = (struct z){-0.5 * (up.im - down.im), 0.5 * (up.re - down.re)};
    }
}

static struct z row(const double *weight, const struct z *x, int n)
{
    struct z sum = {0, 0};
    for (int k = 0; k < n; k++) {
        sum.re += weight[k] * x[k].re;
        sum.im += weight[k] * x[k].im;
    }
    return sum;
}

void alias_taps(const struct alias *f, double frequency, double decay, double re[ALIAS_TAPS], double im[ALIAS_TAPS])
{
    struct parts p;
    double size = real_exp(-decay / f->rate), turn = 2 * frequency / f->rate, scale = -1 / f->rate;
    struct z v = {decay / f->rate, -REAL_PI * turn}, q = {size * real_cospi(turn), size * real_sinpi(turn)};
    for (int k = 1; k < f->gamma; k++)
        scale /= f->rate;
    look(f, v, q, &p);
    for (int m = 0; m <= M; m++) {
        struct z even = row(f->even[m], p.even, M + 1), odd = m ? row(f->odd[m - 1], p.odd, M) : (struct z){0, 0};
        double half = m ? 0.5 * scale : scale;
        re[M + m] = half * (even.re + odd.re);
        im[M + m] = half * (even.im + odd.im);
        re[M - m] = half * (even.re - odd.re);
        im[M - m] = half * (even.im - odd.im);
    }
}

struct alias *alias_make(struct arena *a, int gamma, double rate)
{
    struct alias *f = ARENA_TAKE(a, struct alias, 1);
    f->gamma = gamma;
    f->rate = rate;
    double low = real_cospi(TOP);
    for (int k = 0; k < NODES; k++) {
        double c = low + 0.5 * (1 - low) * (1 + real_cospi((k + 2.5) / (M + 1))), s = sqrt((1 - c) * (1 + c));
        f->turn[k] = real_atan2(s, c);
        f->circle[k] = (struct z){c, -s};
    }
    set_fit(f);
    set_series(f);
    f->arena = a;
    return f;
}

/* ------------------------------------------------------------------ taps by interpolation */

LANES_CLONES
static void mix(const double *restrict re, const double *restrict im, const double a[4], const double b[4],
                double *restrict to)
{
#pragma omp simd
    for (int k = 0; k < ALIAS_TAPS; k++) {
        double inner = (a[1] * im[ALIAS_TAPS + k] + b[1] * re[ALIAS_TAPS + k]) +
                       (a[2] * im[2 * ALIAS_TAPS + k] + b[2] * re[2 * ALIAS_TAPS + k]);
        double outer = (a[0] * im[k] + b[0] * re[k]) + (a[3] * im[3 * ALIAS_TAPS + k] + b[3] * re[3 * ALIAS_TAPS + k]);
        to[k] += inner + outer;
    }
}

void alias_add(struct alias *f, double frequency, double decay, const double gain[2], double to[ALIAS_TAPS])
{
    double x = 2 * PLACES * frequency / f->rate, y = decay / f->rate / STEP, own_re[ALIAS_TAPS], own_im[ALIAS_TAPS],
           a[4], b[4];
    int i = x < PLACES ? (int)x : PLACES;
    if (!(y > -1 && y < 2 * ROWS - 1)) {
        alias_taps(f, frequency, decay, own_re, own_im);
        for (int k = 0; k < ALIAS_TAPS; k++)
            to[k] += gain[0] * own_im[k] + gain[1] * own_re[k];
        return;
    }
    int r = (int)(0.5 * (y + 1));
    if (!f->re[r]) {
        f->re[r] = arena_take(f->arena, PLACES + 4, sizeof *f->re[r]);
        f->im[r] = arena_take(f->arena, PLACES + 4, sizeof *f->im[r]);
        for (int q = 0; q < PLACES + 4; q++)
            alias_taps(f, (q - 1) * f->rate / (2 * PLACES), 2 * r * STEP * f->rate, f->re[r][q], f->im[r][q]);
    }
    /* s T = j STEP (x + j y): Lagrange's polynomials of -1, 0, 1, 2 at u = x - i + j (y - 2 r), times A */
    y -= 2 * r;
    struct z u = {x - i, y}, up = {u.re + 1, y}, down = {u.re - 1, y}, two = {u.re - 2, y}, A = {gain[0], gain[1]},
             inner = times(up, two), outer = times(u, down);
    const struct z l[4] = {times(outer, two), times(inner, down), times(inner, u), times(outer, up)};
    static const double by[4] = {-1.0 / 6, 0.5, -0.5, 1.0 / 6};
    for (int q = 0; q < 4; q++) {
        struct z w = times(A, l[q]);
        a[q] = by[q] * w.re;
        b[q] = by[q] * w.im;
    }
    mix(f->re[r][i], f->im[r][i], a, b, to);
}

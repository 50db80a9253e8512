/* Kernels. A decimator is a Kaiser-windowed ideal low-pass g, made to undo the droop of the interval means by a short
   symmetric polynomial filter. With T = 1/(over fs), times in T, f in 1/T:

       g(t) = sin(2 pi fc t)/(pi t) I0(beta sqrt(1 - (t/R)^2))/I0(beta),   t = j + 1/2 (hats: j),  fc = 0.5/over
       droop of a mean: sinc f = sin(phi)/phi, phi = pi f;  y = sin^2 phi is the response of the taps (-1, 2, -1)/4
       1/sinc f = asin(sqrt y)/sqrt y = sum over k of c[k] T_k(2 y/y_top - 1),  0 <= y <= y_top = sin^2(pi 0.4535/over)
       of a hat: sinc^2 f, and the square of the last line

   Every step of T_k lengthens the kernel by one tap at either end. beta and R are Kaiser's (J. F. Kaiser, "Nonrecursive
   digital filter design using the I0-sinh window function", ISCAS 1974) for ATTENUATION dB: beta = 0.1102 (A - 8.7), 2
   R = (A - 7.95)/(2.285 dw), dw = 2 pi (0.5465 - 0.4535)/over, R rounded up to whole samples at fs: so g is the same
   function of time whatever over is. (Rounded up to whole T, g's edge moved from one over to another, and with it a
   force's part near fs/2 by 7e-6 of its peak.)

   Why not the window on the inverse Fourier transform of the whole wanted response: a window smooths what it
   multiplies, and 1/sinc is curved; for over = 1 that would be wrong by 3e-4. Here the window acts on a flat pass band,
   which smoothing leaves flat. */
#include "num/filter.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/special.h"

#define PASS 0.4535 /* in units of fs */
#define STOP 0.5465
#define ATTENUATION 122.0 /* dB; 120 are promised */
#define JOINED_LEFT 1e-7  /* of a sum of 1: a twentieth of what the gain is allowed to be off by */
#define DROOP_LEFT 5e-7   /* largest relative error of the polynomial in the pass band */

enum {
    NODES = 64
}; /* of the Chebyshev interpolation; over = 1, where c[k] falls slowest (as 1.34^-k), uses 31, of hats 35 */

struct droop {
    double y_top, c[NODES];
    int order; /* c[0..order] are used */
};

/* Modified Bessel function of the first kind, order 0: sum of ((x/2)^k/k!)^2, all terms positive. */
static double bessel_i0(double x)
{
    double sum = 1, term = 1, q = 0.25 * x * x;
    for (int k = 1; term > 1e-17 * sum; k++) {
        term *= q / ((double)k * k);
        sum += term;
    }
    return sum;
}

/* g[i], i = 0..2 reach-1 at t = i - reach + 1/2; odd: i = 0..2 reach at t = i - reach. */
static void low_pass(double *g, int reach, int over, bool odd)
{
    double beta = 0.1102 * (ATTENUATION - 8.7), shift = odd ? 0 : 0.5;
    for (int j = 0; j < reach + odd; j++) {
        double t = j + shift, u = t > 0 ? t / reach : 0;
        double ideal = t > 0 ? real_sinpi(t / over) / (REAL_PI * t) : 1.0 / over;
        g[reach + j] = g[reach - !odd - j] = ideal * bessel_i0(beta * sqrt((1 - u) * (1 + u)));
    }
}

/* Interpolation of 1/sinc, or its square, at the zeros of T_NODES, cut where the sum of what is left out is DROOP_LEFT.
 */
static struct droop droop_make(int over, bool squared)
{
    double edge = real_sinpi(PASS / over), left = 0, cosine[4 * NODES]; /* cos(pi m / (2 NODES)) */
    for (int m = 0; m < 4 * NODES; m++)
        cosine[m] = real_cospi(0.5 * m / NODES);
    struct droop d = {.y_top = edge * edge, .order = NODES - 1};
    for (int i = 0; i < NODES; i++) {
        double y = 0.5 * d.y_top * (1 + cosine[2 * i + 1]);
        double once = real_atan2(sqrt(y), sqrt(1 - y)) / sqrt(y), wanted = squared ? once * once : once;
        for (int k = 0; k < NODES; k++)
            d.c[k] += (k ? 2.0 : 1.0) / NODES * wanted * cosine[k * (2 * i + 1) % (4 * NODES)];
    }
    while (d.order > 0 && left + fabs(d.c[d.order]) < DROOP_LEFT)
        left += fabs(d.c[d.order--]);
    return d;
}

/* (2 y/y_top - 1) applied to b, at i; b is zero outside 0..n-1. */
static double step(const double *b, int i, int n, double y_top)
{
    double before = i > 0 ? b[i - 1] : 0, after = i + 1 < n ? b[i + 1] : 0;
    return (2 * b[i] - (before + after)) / (2 * y_top) - b[i];
}

/* Clenshaw's sum of c[k] T_k applied to g: b_k = c_k g + 2 Z b_{k+1} - b_{k+2}; the last step has Z in place of 2 Z. */
static double *droop_undone(struct arena *a, const struct droop *d, const double *g, int n)
{
    double *b = ARENA_TAKE(a, double, n), *b1 = ARENA_TAKE(a, double, n), *b2 = ARENA_TAKE(a, double, n);
    for (int k = d->order; k >= 0; k--) {
        for (int i = 0; i < n; i++)
            b[i] = d->c[k] * g[i] + (k ? 2 : 1) * step(b1, i, n, d->y_top) - b2[i];
        double *oldest = b2;
        b2 = b1, b1 = b, b = oldest;
    }
    return b1;
}

/* Sum 1; added from the ends, where the taps are small, to the middle. */
static void normalise(double *tap, int n)
{
    double sum = 0;
    for (int i = 0; i < n / 2; i++)
        sum += tap[i] + tap[n - 1 - i];
    sum += n % 2 ? tap[n / 2] : 0;
    for (int i = 0; i < n; i++)
        tap[i] /= sum;
}

/* At over = 1 the ideal low-pass of hats is a single tap. */
static struct filter decimator(struct arena *a, int over, bool bspline)
{
    struct droop d = droop_make(over, bspline);
    double width = 2 * REAL_PI * (STOP - PASS);
    int inner = bspline && over == 1 ? 0 : over * (int)ceil((ATTENUATION - 7.95) / (2.285 * width) / 2),
        reach = inner + d.order, taps = 2 * reach + bspline;
    double *g = ARENA_TAKE(a, double, taps);
    low_pass(g + d.order, inner, over, bspline);
    double *tap = droop_undone(a, &d, g, taps);
    normalise(tap, taps);
    return (struct filter){reach, taps, tap};
}

struct filter filter_decimator(struct arena *a, int over) { return decimator(a, over, false); }

struct filter filter_decimator_bspline(struct arena *a, int over) { return decimator(a, over, true); }

enum { NARROW_TAPS = 5 };

/* Taps 0 to 4 to each side of a Gaussian narrower than FILTER_NARROW samples, sum 1:

     exp(-sigma^2 omega^2 / 2) to order omega^8, by omega^2 = x + x^2/12 + x^3/90 + x^4/560 ..., x = 4 sin^2(omega/2) */
static void narrow_taps(double sigma, double tap[NARROW_TAPS])
{
    double v = -0.5 * sigma * sigma, u[4] = {v, v / 12, v / 90, v / 560},
           p[4] = {u[0], u[1] + u[0] * u[0] / 2, u[2] + u[0] * u[1] + u[0] * u[0] * u[0] / 6, /* exp of the series */
                   u[3] + u[0] * u[2] + u[1] * u[1] / 2 + u[0] * u[0] * u[1] / 2 + u[0] * u[0] * u[0] * u[0] / 24};
    tap[0] = 1 + 2 * p[0] + 6 * p[1] + 20 * p[2] + 70 * p[3];
    tap[1] = -(p[0] + 4 * p[1] + 15 * p[2] + 56 * p[3]);
    tap[2] = p[1] + 6 * p[2] + 28 * p[3];
    tap[3] = -(p[2] + 8 * p[3]);
    tap[4] = p[3];
}

int filter_gaussian_reach(double sigma)
{
    return sigma > 0 && sigma < FILTER_NARROW ? NARROW_TAPS - 1 : (int)ceil(6.5 * sigma);
}

struct filter filter_gaussian(struct arena *a, double sigma)
{
    bool narrow = sigma > 0 && sigma < FILTER_NARROW;
    int reach = filter_gaussian_reach(sigma);
    double *tap = ARENA_TAKE(a, double, 2 * reach + 1);
    if (narrow) {
        narrow_taps(sigma, tap + reach);
        for (int j = 1; j <= reach; j++)
            tap[reach - j] = tap[reach + j];
        return (struct filter){reach, 2 * reach + 1, tap};
    }
    tap[reach] = 1;
    for (int j = 1; j <= reach; j++)
        tap[reach + j] = tap[reach - j] = real_exp(-0.5 * (j / sigma) * (j / sigma));
    normalise(tap, 2 * reach + 1);
    return (struct filter){reach, 2 * reach + 1, tap};
}

LANES_CLONES
struct filter filter_joined(struct arena *a, const struct filter *b, const struct filter *c)
{
    int n = b->taps + c->taps - 1, cut = 0;
    double *tap = ARENA_TAKE(a, double, n), ends = 0;
    for (int i = 0; i < b->taps; i++)
#pragma omp simd
        for (int k = 0; k < c->taps; k++)
            tap[i + k] += b->tap[i] * c->tap[k];
    while (cut < n / 2 && (ends += fabs(tap[cut]) + fabs(tap[n - 1 - cut])) <= JOINED_LEFT)
        cut++;
    normalise(tap + cut, n - 2 * cut);
    return (struct filter){b->reach + c->reach - cut, n - 2 * cut, tap + cut};
}

void filter_fold_lead(double *lead, long n, long distance)
{
    double late = 0;
    assert(2 * distance <= n);
    for (long m = n; m >= 1; m--) /* from the end, where it is small */
        late += (double)(2 * m - 1) * lead[m - 1];
    for (long i = 0; i < distance; i++) {
        lead[i] += late / ((double)distance * (double)distance);
        lead[distance + i] -= late / ((double)distance * (double)distance);
    }
}

/* A sinc under Kaiser's window, in steps of 1/BETWEEN_PHASES of a sample:

     x(i + p) = sum over j = 1 - R..R of x[i + j] sinc(p - j) I0(beta sqrt(1 - ((p - j)/R)^2)) / I0(beta),   R =
       BETWEEN_REACH, beta = 9 */

static const double beta = 9;

static double kaiser(double u)
{
    double inside[2], whole[2], x = beta * sqrt((1 - u) * (1 + u));
    if (fabs(u) >= 1) return 0;
    special_bessel_i(0, x, inside);
    special_bessel_i(0, beta, whole);
    return inside[0] / whole[0] * real_exp(x - beta);
}

struct filter_between filter_between_make(struct arena *a)
{
    struct filter_between b = {ARENA_TAKE(a, double, 2 * BETWEEN_PHASES * BETWEEN_REACH)};
    for (int p = 0; p < BETWEEN_PHASES; p++)
        for (int j = 1 - BETWEEN_REACH; j <= BETWEEN_REACH; j++) {
            double t = (double)p / BETWEEN_PHASES - j;
            b.tap[2 * BETWEEN_REACH * p + BETWEEN_REACH - 1 + j] =
                t == 0   ? 1
                : p == 0 ? 0
                         : real_sinpi(t) / (REAL_PI * t) * kaiser(t / BETWEEN_REACH);
        }
    return b;
}

double filter_between_at(const struct filter_between *b, const double *x, long n, long k)
{
    long i = k >= 0 ? k / BETWEEN_PHASES : -((-k + BETWEEN_PHASES - 1) / BETWEEN_PHASES), first = i + 1 - BETWEEN_REACH;
    const double *tap = b->tap + 2 * BETWEEN_REACH * (k - i * BETWEEN_PHASES);
    double sum = 0;
    if (k == i * BETWEEN_PHASES) return i >= 0 && i < n ? x[i] : 0;
    for (long j = first < 0 ? -first : 0; j < 2 * BETWEEN_REACH && first + j < n; j++)
        sum += tap[j] * x[first + j];
    return sum;
}

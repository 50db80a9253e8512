#include "num/special.h"

#include <math.h>

#include "num/real.h"

/* Bessel functions J_n and e^-x I_n by Miller's algorithm (J. C. P. Miller, British Association Mathematical Tables X,
   1952; DLMF 3.6): the recurrences

       J_{k-1} = (2k/x) J_k - J_{k+1},      I_{k-1} = (2k/x) I_k + I_{k+1}

   are run down from an order far above n and x, where both functions are as good as zero, and what comes out is scaled
   by

       J_0 + 2 (J_2 + J_4 + ...) = 1,       e^-x (I_0 + 2 (I_1 + I_2 + ...)) = 1,

   so that no exponential is needed. x = 0: J_0 = I_0 = 1, all others 0. */

/* sign -1: J, +1: I. */
static void miller(int n, double x, double sign, double out[2])
{
    double above = 0.0, here = 1e-290, sum = 0.0, top = fmax(n + 1.0, x);
    /* even order above which nothing counts: J and I have fallen below 1e-20 of their size at max(n, x) */
    int start = 2 * (int)((top + 24.0 + 5.0 * sqrt(top)) / 2.0);
    out[0] = out[1] = 0.0;
    for (int k = start; k >= 0; k--) { /* here = order k */
        if (k == n + 1) out[1] = here;
        if (k == n) out[0] = here;
        if (sign > 0.0 || k % 2 == 0) sum += k > 0 ? 2.0 * here : here;
        double below = 2.0 * k / x * here + sign * above;
        above = here;
        here = below;
        if (fabs(here) > 1e250) {
            here *= 1e-250, above *= 1e-250, sum *= 1e-250;
            out[0] *= 1e-250, out[1] *= 1e-250;
        }
    }
    out[0] /= sum;
    out[1] /= sum;
}

/* Below 1e-8 two terms of the series are all there is, and 2k/x would overflow further down. */
static void small(int n, double x, double sign, double out[2])
{
    double term = 1.0;
    for (int k = 1; k <= n + 1; k++) {
        if (k == n + 1) out[0] = term;
        term *= 0.5 * x / k;
    }
    out[1] = term;
    if (sign > 0.0) out[0] *= 1.0 - x, out[1] *= 1.0 - x;
}

static void both(int n, double x, double sign, double out[2])
{
    if (x < 1e-8)
        small(n, x, sign, out);
    else
        miller(n, x, sign, out);
}

void special_bessel_j(int n, double x, double j[2]) { both(n, x, -1.0, j); }

void special_bessel_i(int n, double x, double i[2]) { both(n, x, 1.0, i); }

/* Gauss-Legendre nodes: zeros of P_n by Newton from cos(pi (i + 3/4)/(n + 1/2)), weights 2/((1 - x^2) P_n'(x)^2)
 * (DLMF 3.5(v)). */

/* P_n(x); its derivative in *slope. */
static double legendre(int n, double x, double *slope)
{
    double p = 1.0, below = 0.0;
    for (int k = 0; k < n; k++) {
        double next = ((2 * k + 1) * x * p - k * below) / (k + 1);
        below = p;
        p = next;
    }
    *slope = n * (below - x * p) / (1.0 - x * x);
    return p;
}

void special_gauss_legendre(int n, double *node, double *weight)
{
    for (int i = 0; i < (n + 1) / 2; i++) {
        double x = 2 * i + 1 == n ? 0.0 : real_cospi((i + 0.75) / (n + 0.5)), slope;
        for (int pass = 0; pass < 6; pass++) {
            double p = legendre(n, x, &slope);
            x -= p / slope;
        }
        legendre(n, x, &slope);
        node[i] = -x;
        node[n - 1 - i] = x;
        weight[i] = weight[n - 1 - i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* f_k(x) = (1 - x)^a (1 + x)^b p_k(x), p_k orthonormal under the weight (1 - x)^(2a) (1 + x)^(2b), so that the f_k are
   orthonormal under 1. p_k by its three-term recurrence (DLMF 18.9(i), Gautschi's normalisation), with alpha = 2a, beta
   = 2b, s = 2k + alpha + beta:

       center_k = (beta^2 - alpha^2)/(s (s + 2)),
       step_k^2 = 4 k (k + alpha)(k + beta)(k + alpha + beta)/(s^2 (s + 1)(s - 1)),
       p_0^-2 = 2^(alpha+beta+1) alpha! beta!/(alpha + beta + 1)!

   and its derivatives by the recurrence differentiated. */

static double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

struct jacobi special_jacobi_make(int a, int b)
{
    struct jacobi j = {.a = a, .b = b};
    double alpha = 2.0 * a, beta = 2.0 * b, sum = alpha + beta;
    for (int k = 0; k < JACOBI_MOST; k++) {
        double s = 2.0 * k + sum;
        j.center[k] = a == b ? 0.0 : (beta * beta - alpha * alpha) / (s * (s + 2.0));
        j.step[k] =
            k == 0 ? 0.0 : sqrt(4.0 * k * (k + alpha) * (k + beta) * (k + sum) / (s * s * (s + 1.0) * (s - 1.0)));
    }
    double weight = ldexp(factorial(2 * a) * factorial(2 * b) / factorial(2 * a + 2 * b + 1), 2 * a + 2 * b + 1);
    j.first = 1.0 / sqrt(weight);
    return j;
}

static double power(double x, int n) { return n <= 0 ? 1.0 : x * power(x, n - 1); }

void special_jacobi_values(const struct jacobi *j, int n, double x, double *f)
{
    double below = 0.0, p = j->first * power(1.0 - x, j->a) * power(1.0 + x, j->b);
    for (int k = 0; k < n; k++) {
        f[k] = p;
        if (k + 1 == n) break;
        p = ((x - j->center[k]) * p - j->step[k] * below) / j->step[k + 1];
        below = f[k];
    }
}

void special_jacobi_slopes(const struct jacobi *j, int n, double x, double *f, double *f1, double *f2)
{
    double a = j->a, b = j->b, u = 1.0 - x, v = 1.0 + x;
    double g = power(u, j->a) * power(v, j->b), slope = b / v - a / u; /* g'/g */
    double g1 = g * slope, g2 = g * (slope * slope - b / (v * v) - a / (u * u));
    double p[3] = {j->first, 0.0, 0.0}, below[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < n; k++) {
        f[k] = g * p[0];
        f1[k] = g * p[1] + g1 * p[0];
        f2[k] = g * p[2] + 2.0 * g1 * p[1] + g2 * p[0];
        if (k + 1 == n) break;
        double y = x - j->center[k];
        double next[3] = {(y * p[0] - j->step[k] * below[0]) / j->step[k + 1],
                          (y * p[1] + p[0] - j->step[k] * below[1]) / j->step[k + 1],
                          (y * p[2] + 2.0 * p[1] - j->step[k] * below[2]) / j->step[k + 1]};
        for (int d = 0; d < 3; d++) {
            below[d] = p[d];
            p[d] = next[d];
        }
    }
}

/* The normal distribution function after W. J. Cody, Rational Chebyshev approximations for the error function, Math.
   Comp. 23 (1969) 631, and its inverse after M. J. Wichura, Algorithm AS 241: The percentage points of the normal
   distribution, Applied Statistics 37 (1988) 477 (PPND16). Both are ratios of polynomials on three ranges; the
   coefficients are the published ones.

     |x| <= 0.66291       P = 1/2 + x R(x^2)
     |x| <= sqrt(32)      P = exp(-x^2/2) R(|x|), of the lower tail
     beyond               P = exp(-x^2/2) (1/sqrt(2 pi) - R(1/x^2)/x^2) / |x|
     |w - 1/2| <= 0.425   x = q R(0.425^2 - q^2),  q = w - 1/2
     else                 x = +-R(r - 1.6) for r = sqrt(-ln min(w, 1 - w)) <= 5, +-R(r - 5) beyond

   exp(-x^2/2) is taken in two factors, of s = x rounded to 1/16 and the rest (x - s)(x + s), since the rounding of x^2
   alone would cost up to x^2/2 ulp. */

#define ROOT_TWO_PI_INVERSE 0.39894228040143267794

/* c[0] + c[1] x + ... + c[n - 1] x^(n - 1) */
static double polynomial(const double *c, int n, double x)
{
    double sum = c[n - 1];
    for (int i = n - 2; i >= 0; i--)
        sum = sum * x + c[i];
    return sum;
}

static double bell(double x)
{
    double s = floor(fabs(x) * 16) / 16, rest = (fabs(x) - s) * (fabs(x) + s);
    return real_exp(-0.5 * s * s) * real_exp(-0.5 * rest);
}

double special_normal_density(double x) { return ROOT_TWO_PI_INVERSE * bell(x); }

static double cdf_middle(double x)
{
    static const double up[] = {18154.981253343561249, 1067.6894854603709582, 161.02823106855587881,
                                2.2352520354606839287, 0.065682337918207449113};
    static const double down[] = {45507.789335026729956, 10260.932208618978205, 976.09855173777669322,
                                  47.20258190468824187, 1};
    return 0.5 + x * (polynomial(up, 5, x * x) / polynomial(down, 5, x * x));
}

/* P(Z > y) / exp(-y^2/2), y > 0 */
static double tail_near(double y)
{
    static const double up[] = {9842.7148383839780218, 11602.651437647350124,  6848.1904505362823326,
                                2494.5375852903726711, 597.27027639480026226,  93.506656132177855979,
                                8.8831497943883759412, 0.39894151208813466764, 1.0765576773720192317e-8};
    static const double down[] = {19685.429676859990727, 38912.003286093271411, 34900.952721145977266,
                                  18615.571640885098091, 6485.558298266760755,  1519.377599407554805,
                                  235.38790178262499861, 22.266688044328115691, 1};
    return polynomial(up, 9, y) / polynomial(down, 9, y);
}

static double tail_far(double y)
{
    static const double up[] = {2.9112874951168792e-5, 0.001421619193227893466, 0.022235277870649807,
                                0.1274011611602473639, 0.21589853405795699,     0.02307344176494017303};
    static const double down[] = {7.29751555083966205e-5, 0.00378239633202758244, 0.0659881378689285515,
                                  0.468238212480865118,   1.28426009614491121,    1};
    double z = 1 / (y * y);
    return (ROOT_TWO_PI_INVERSE - z * (polynomial(up, 6, z) / polynomial(down, 6, z))) / y;
}

/* `height`: bell(x), which is not read in the middle */
static double cdf_of(double x, double height)
{
    double y = fabs(x);
    if (y <= 0.66291) return cdf_middle(x);
    double tail = y < 40 ? height * (y <= 5.656854249492380195 ? tail_near(y) : tail_far(y)) : 0;
    return x < 0 ? tail : 1 - tail;
}

double special_normal_cdf(double x) { return cdf_of(x, fabs(x) <= 0.66291 ? 1 : bell(x)); }

double special_normal_cdf_density(double x, double *density)
{
    double height = bell(x);
    *density = ROOT_TWO_PI_INVERSE * height;
    return cdf_of(x, height);
}

/* r = sqrt(-ln tail) > 1.2 */
static double quantile_tail(double r)
{
    static const double near_up[] = {1.42343711074968357734,   4.63033784615654529590,   5.76949722146069140550,
                                     3.64784832476320460504,   1.27045825245236838258,   0.241780725177450611770,
                                     0.0227238449892691845833, 7.74545014278341407640e-4};
    static const double near_down[] = {1,
                                       2.05319162663775882187,
                                       1.67638483018380384940,
                                       0.689767334985100004550,
                                       0.148103976427480074590,
                                       0.0151986665636164571966,
                                       5.47593808499534494600e-4,
                                       1.05075007164441684324e-9};
    static const double far_up[] = {6.65790464350110377720,    5.46378491116411436990,   1.78482653991729133580,
                                    0.296560571828504891230,   0.0265321895265761230930, 0.00124266094738807843860,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7};
    static const double far_down[] = {1,
                                      0.599832206555887937690,
                                      0.136929880922735805310,
                                      0.0148753612908506148525,
                                      7.86869131145613259100e-4,
                                      1.84631831751005468180e-5,
                                      1.42151175831644588870e-7,
                                      2.04426310338993978564e-15};
    return r <= 5 ? polynomial(near_up, 8, r - 1.6) / polynomial(near_down, 8, r - 1.6)
                  : polynomial(far_up, 8, r - 5) / polynomial(far_down, 8, r - 5);
}

double special_normal_quantile(double w)
{
    static const double up[] = {3.38713287279636660800, 133.141667891784377450, 1971.59095030655144270,
                                13731.6937655094611250, 45921.9539315498714570, 67265.7709270087008530,
                                33430.5755835881281050, 2509.08092873012267270};
    static const double down[] = {1,
                                  42.3133307016009112520,
                                  687.187007492057908300,
                                  5394.19602142475110770,
                                  21213.7943015865958670,
                                  39307.8958000927106100,
                                  28729.0857357219426740,
                                  5226.49527885285456100};
    double q = w - 0.5;
    if (fabs(q) <= 0.425) {
        double r = 0.180625 - q * q;
        return q * (polynomial(up, 8, r) / polynomial(down, 8, r));
    }
    double tail = q < 0 ? w : 1 - w;
    if (tail <= 0) return q < 0 ? -HUGE_VAL : HUGE_VAL;
    double x = quantile_tail(sqrt(-real_log(tail)));
    return q < 0 ? -x : x;
}

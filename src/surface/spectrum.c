/* See spectrum.h. A segment's integral, k0 and p0 at its lower end, a its exponent, L = log(k1/k0):

     integral of p0 (k/k0)^a dk = p0 k0 L phi((a + 1) L),  phi(y) = (exp(y) - 1)/y

   which stays exact where a passes -1. */
#include "surface/spectrum.h"

#include "num/real.h"

/* Gauss-Legendre nodes and weights of 12 points on [-1, 1], the positive half (Abramowitz and Stegun, table 25.4). */
enum { GAUSS = 6 };
static const double gauss_x[GAUSS] = {0.125233408511468915, 0.367831498998180194, 0.587317954286617447,
                                      0.769902674194304687, 0.904117256370474857, 0.981560634246719251};
static const double gauss_w[GAUSS] = {0.249147045813402785, 0.233492536538354809, 0.203167426723065922,
                                      0.160078328543346226, 0.106939325995318431, 0.047175336386511827};

struct spectrum spectrum_power_law(struct arena *a, double exponent, double longest, double shortest, double rms)
{
    struct spectrum s = {.n = 2, .k = ARENA_TAKE(a, double, 2), .p = ARENA_TAKE(a, double, 2), .flat = true};
    s.k[0] = 1 / longest;
    s.k[1] = 1 / shortest;
    s.p[0] = 1;
    s.p[1] = real_pow(s.k[1] / s.k[0], exponent);
    spectrum_scale(&s, rms);
    return s;
}

static double spectrum_exponent(const struct spectrum *s, int i)
{
    return real_log(s->p[i + 1] / s->p[i]) / real_log(s->k[i + 1] / s->k[i]);
}

/* The table alone. */
static double table_at(const struct spectrum *s, double k)
{
    int lo = 0, hi = s->n - 1;
    if (k < s->k[0]) return s->flat ? s->p[0] : 0;
    if (k >= s->k[hi]) return 0;
    while (hi - lo > 1) {
        int mid = (lo + hi) / 2;
        if (k < s->k[mid])
            hi = mid;
        else
            lo = mid;
    }
    return k == s->k[lo] ? s->p[lo] : s->p[lo] * real_pow(k / s->k[lo], spectrum_exponent(s, lo));
}

double spectrum_takeover(const struct spectrum *s, double k)
{
    if (s->takeover <= 0 || k >= s->takeover * sqrt(2)) return 1;
    if (k <= s->takeover * sqrt(0.5)) return 0;
    double across = real_sinpi(0.25 + 0.5 * real_log(k / s->takeover) / real_log(2)),
           all = real_sinpi(0.5 * across * across);
    return all * all;
}

double spectrum_at(const struct spectrum *s, double k) { return table_at(s, k) * spectrum_takeover(s, k); }

static double phi(double y)
{
    double sum = 1, term = 1;
    if (fabs(y) > 0.5) return (real_exp(y) - 1) / y;
    for (int j = 2; j < 16; j++)
        sum += term *= y / j;
    return sum;
}

static double table_power(const struct spectrum *s, double from, double to)
{
    double sum = s->flat && from < s->k[0] ? s->p[0] * (fmin(to, s->k[0]) - from) : 0;
    for (int i = 0; i + 1 < s->n; i++) {
        double k0 = fmax(from, s->k[i]), k1 = fmin(to, s->k[i + 1]);
        if (k0 >= k1) continue;
        double a = spectrum_exponent(s, i), width = real_log(k1 / k0), p0 = s->p[i] * real_pow(k0 / s->k[i], a);
        sum += p0 * k0 * width * phi((a + 1) * width);
    }
    return sum;
}

/* Where X varies: 64 steps of half a pi/64 each in log k. */
static double path_integral_power(const struct spectrum *s, double from, double to)
{
    enum { STEPS = 64 };
    double span = real_log(to / from), sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double lo = from * real_exp(span * i / STEPS), hi = from * real_exp(span * (i + 1) / STEPS),
               mid = sqrt(lo * hi);
        double x[3] = {spectrum_takeover(s, lo), spectrum_takeover(s, mid), spectrum_takeover(s, hi)};
        double weight[2] = {table_power(s, lo, mid), table_power(s, mid, hi)}, all = weight[0] + weight[1];
        double tilt = all > 0 ? (weight[1] - weight[0]) / all : 0;
        sum += all * ((x[0] + 4 * x[1] + x[2]) / 6 + tilt * (x[2] - x[0]) / 3);
    }
    return sum;
}

double spectrum_power(const struct spectrum *s, double from, double to)
{
    from = fmax(from, 0);
    if (from >= to) return 0;
    if (s->takeover <= 0) return table_power(s, from, to);
    double lo = s->takeover * sqrt(0.5), hi = s->takeover * sqrt(2), c0 = fmax(from, lo), c1 = fmin(to, hi);
    return (c0 < c1 ? path_integral_power(s, c0, c1) : 0) + (to > hi ? table_power(s, fmax(from, hi), to) : 0);
}

double spectrum_top(const struct spectrum *s) { return s->k[s->n - 1]; }

double spectrum_bottom(const struct spectrum *s) { return fmax(s->flat ? 0 : s->k[0], s->takeover * sqrt(0.5)); }

double spectrum_rms(const struct spectrum *s) { return sqrt(spectrum_power(s, 0, spectrum_top(s))); }

void spectrum_scale(struct spectrum *s, double rms)
{
    double factor = rms / spectrum_rms(s);
    for (int i = 0; i < s->n; i++)
        s->p[i] *= factor * factor;
}

/* Integral of (sqrt(kappa^2 + s^2)/k0)^a ds over radii from k0 to k1 <= 1.5 k0. */
static double beyond_piece(double kappa, double k0, double k1, double a)
{
    double s0 = sqrt((k0 - kappa) * (k0 + kappa)), s1 = sqrt((k1 - kappa) * (k1 + kappa)), sum = 0;
    for (int i = 0; i < GAUSS; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double at = 0.5 * ((s0 + s1) + sign * gauss_x[i] * (s1 - s0));
            sum += gauss_w[i] * real_pow((kappa * kappa + at * at) / (k0 * k0), 0.5 * a);
        }
    return 0.5 * (s1 - s0) * sum;
}

double spectrum_beyond(const struct spectrum *s, double kappa)
{
    double first = s->k[0], sum = 0;
    if (kappa < first && s->flat) sum = s->p[0] * sqrt((first - kappa) * (first + kappa));
    for (int i = 0; i + 1 < s->n; i++) {
        if (s->k[i + 1] <= kappa) continue;
        double a = spectrum_exponent(s, i);
        for (double k0 = fmax(kappa, s->k[i]), k1; k0 < s->k[i + 1]; k0 = k1) {
            k1 = fmin(1.5 * k0, s->k[i + 1]);
            sum += s->p[i] * real_pow(k0 / s->k[i], a) * beyond_piece(kappa, k0, k1, a);
        }
    }
    return sum;
}

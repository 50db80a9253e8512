/* See spectrum.h. A segment's integral, k0 and p0 at its lower end, a its exponent, L = log(k1/k0):

     integral of p0 (k/k0)^a dk = p0 k0 L phi((a + 1) L),  phi(y) = (exp(y) - 1)/y

   which stays exact where a passes -1. */
#include "surface/spectrum.h"

#include <string.h>

#include "num/fft.h"
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

/* ------------------------------------------------------------------ of a measured map */

enum { ROWS_MOST = 256, SEGMENT_LEAST = 1024 };

static long segment_of(size_t columns)
{
    size_t n = columns / 8 > SEGMENT_LEAST ? columns / 8 : columns < SEGMENT_LEAST ? columns : SEGMENT_LEAST;
    n -= n % 2;
    while (fft_good_size(n) != n)
        n -= 2;
    return (long)n;
}

/* z less its least-squares line. */
static void levelled(const double *z, size_t n, double *out)
{
    double middle = 0.5 * (double)(n - 1), mean = 0, tilt = 0, square = 0;
    for (size_t i = 0; i < n; i++)
        mean += z[i] / (double)n;
    for (size_t i = 0; i < n; i++) {
        double at = (double)i - middle;
        tilt += at * (z[i] - mean);
        square += at * at;
    }
    for (size_t i = 0; i < n; i++)
        out[i] = z[i] - mean - tilt / square * ((double)i - middle);
}

struct welch {
    long n; /* samples of a segment */
    struct fft *fft;
    double *hann, *x, *re, *im, *power; /* power: [n/2] sums of squared moduli */
    long segments;
};

static void welch_add(struct welch *w, const double *z)
{
    for (long i = 0; i < w->n; i++)
        w->x[i] = z[i] * w->hann[i];
    fft_forward(w->fft, w->x, w->re, w->im);
    for (long k = 0; k < w->n / 2; k++)
        w->power[k] += w->re[k] * w->re[k] + w->im[k] * w->im[k];
    w->segments++;
}

static struct welch welch_of(struct arena *a, const struct spectrum_rows *g)
{
    long n = segment_of(g->columns);
    struct welch w = {.n = n,
                      .fft = fft_open((size_t)n),
                      .hann = ARENA_TAKE(a, double, n),
                      .x = ARENA_TAKE(a, double, n),
                      .re = ARENA_TAKE(a, double, n / 2 + 1),
                      .im = ARENA_TAKE(a, double, n / 2 + 1),
                      .power = ARENA_TAKE(a, double, n / 2)};
    double *row = ARENA_TAKE(a, double, g->columns);
    size_t rows = g->rows < ROWS_MOST ? g->rows : ROWS_MOST;
    for (long i = 0; i < n; i++)
        w.hann[i] = 0.5 - 0.5 * real_cospi(2 * ((double)i + 0.5) / (double)n);
    for (size_t r = 0; r < rows; r++) {
        levelled(g->z + r * g->rows / rows * g->columns, g->columns, row);
        for (long at = 0; at + n <= (long)g->columns; at += n / 2)
            welch_add(&w, row + at);
    }
    fft_close(w.fft);
    return w;
}

struct spectrum spectrum_measured(struct arena *a, const struct spectrum_rows *g)
{
    struct welch w = welch_of(a, g);
    double dk = 1 / ((double)w.n * g->pitch), unit = 2 * g->pitch / ((double)w.n * 0.375 * (double)w.segments),
           step = real_exp(real_log(2) / 3);
    struct spectrum s = {.k = ARENA_TAKE(a, double, w.n / 2), .p = ARENA_TAKE(a, double, w.n / 2), .flat = true};
    for (long from = 2, to; from < w.n / 2; from = to) {
        to = (long)((double)from * step + 0.5);
        to = to < from + 3 ? from + 3 : to;
        if (to > w.n / 2) break;
        double sum = 0;
        for (long k = from; k < to; k++)
            sum += w.power[k];
        if (!(sum > 0)) break;
        s.k[s.n] = dk * sqrt(((double)from - 0.5) * ((double)to - 0.5));
        s.p[s.n++] = unit * sum / (double)(to - from);
    }
    return s;
}

enum { OCTAVE = 3 }; /* nodes */

double spectrum_knee(const struct spectrum *s)
{
    int i = 0;
    while (i + OCTAVE < s->n && (s->k[i + OCTAVE] > 2.2 * s->k[i] || s->p[i + OCTAVE] > 1e-3 * s->p[i]))
        i++;
    if (i + OCTAVE >= s->n) return spectrum_top(s);
    while (s->p[i + 1] > 0.3 * s->p[i])
        i++;
    return s->k[i];
}

double spectrum_limit(const struct spectrum *s)
{
    double knee = spectrum_knee(s);
    for (int i = 0; i + 1 < s->n; i++) {
        double least = 1e-3 * spectrum_at(s, knee);
        if (s->k[i] >= knee && s->p[i] >= least && s->p[i + 1] < least)
            return s->k[i] * real_exp(real_log(s->k[i + 1] / s->k[i]) * real_log(least / s->p[i]) /
                                      real_log(s->p[i + 1] / s->p[i]));
    }
    return spectrum_top(s);
}

double spectrum_fit(const struct spectrum *s, double k, double *density)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, slope;
    for (int i = 0; i < s->n; i++)
        if (s->k[i] > 0.24 * k && s->k[i] < 1.01 * k) {
            double u = real_log(s->k[i] / k), v = real_log(s->p[i]);
            n++, x += u, y += v, xx += u * u, xy += u * v;
        }
    if (n < 3) return NAN;
    slope = (n * xy - x * y) / (n * xx - x * x);
    *density = real_exp((y - slope * x) / n);
    return slope;
}

/* ------------------------------------------------------------------ moments */

/* Sums over x and y counted from the middle are independent, so that the least-squares plane has each slope by itself.
 */
static void plane_of(const struct spectrum_rows *g, double *mean, double tilt[2])
{
    double middle[2] = {0.5 * (double)(g->columns - 1), 0.5 * (double)(g->rows - 1)}, square[2] = {0}, all = 0;
    tilt[0] = tilt[1] = 0;
    for (size_t j = 0; j < g->rows; j++)
        for (size_t i = 0; i < g->columns; i++) {
            double z = g->z[j * g->columns + i], x = (double)i - middle[0], y = (double)j - middle[1];
            all += z;
            tilt[0] += x * z, tilt[1] += y * z;
            square[0] += x * x, square[1] += y * y;
        }
    *mean = all / (double)(g->rows * g->columns);
    for (int k = 0; k < 2; k++)
        tilt[k] = square[k] > 0 ? tilt[k] / square[k] : 0;
}

struct spectrum_moments spectrum_moments(const struct spectrum_rows *g)
{
    double mean, tilt[2], sum[5] = {0}, n = (double)(g->rows * g->columns);
    plane_of(g, &mean, tilt);
    for (size_t j = 0; j < g->rows; j++)
        for (size_t i = 0; i < g->columns; i++) {
            double x = (double)i - 0.5 * (double)(g->columns - 1), y = (double)j - 0.5 * (double)(g->rows - 1);
            double z = g->z[j * g->columns + i] - mean - tilt[0] * x - tilt[1] * y;
            sum[2] += z * z / n, sum[3] += z * z * z / n, sum[4] += z * z * z * z / n;
        }
    return (struct spectrum_moments){sqrt(sum[2]), sum[3] / (sum[2] * sqrt(sum[2])), sum[4] / (sum[2] * sum[2])};
}

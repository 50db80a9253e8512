/* Everything is done on values whitened by their ARMA(1,1) filter (arma.c; generalised least squares): with W the
   whitening, energy left without and with a sinusoid Q0 = min |W (A - m)|^2, Q1 = min |W (A - m - c cos - s sin)|^2,
   its strength is z = (n - 5)/2 ln(Q0/Q1); of Gaussian noise exp(-z) reach z at one frequency, and somewhere below f
   (Baluev, Mon. Not. R. Astron. Soc. 385, 2008, 1279, equation 6, after Davies)

     1 - (1 - exp(-z)) exp(-f sqrt(4 pi var T) sqrt(z) exp(-z)).

   Where to look: |sum g_n exp(-2 pi i nu T_n)|^2/D(nu), g = W'W (A - m), by one FFT of the g_n spread over a regular
   grid (four-point Lagrange weights, 8 points a period of the highest frequency, 1 % off at most; a quarter of a cycle
   over the whole from one frequency to the next), D = |W cos|^2 + |W sin|^2 computed at SCALES frequencies and
   interpolated. The winner is then taken exactly, at NEAR frequencies around it. */
#include "analysis/modulation_scan.h"

#include <float.h>
#include <math.h>

#include "num/fft.h"
#include "num/real.h"
#include "num/vecmath.h"

enum { SCALES = 48, NEAR = 9, FINE = 8, PAD = 4 };

double modulation_scan_dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

void modulation_scan_project(double *x, const double *y, int n)
{
    double yy = modulation_scan_dot(y, y, n), share = (yy > 0) ? modulation_scan_dot(x, y, n) / yy : 0;
    for (int i = 0; i < n; i++)
        x[i] -= share * y[i];
}

void modulation_scan_filter(struct modulation_problem *p, const double *amplitude)
{
    arma_fit(amplitude, p->n, &p->filter);
    for (int i = 0; i < p->n; i++)
        p->ones[i] = 1;
    arma_whiten(p->ones, p->n, p->filter.a1, p->filter.b1, p->ones);
}

/* Whitened amplitudes less their mean, to out. */
static void centred(const struct modulation_problem *p, const double *amplitude, double *out)
{
    for (int i = 0; i < p->n; i++)
        out[i] = amplitude[i] - p->filter.mean;
    arma_whiten(out, p->n, p->filter.a1, p->filter.b1, out);
    modulation_scan_project(out, p->ones, p->n);
}

/* Whitened cosine and sine of f cycles per span. */
static void waves_make(const struct modulation_problem *p, double f)
{
    for (int i = 0; i < p->n; i++)
        p->cosine[i] = 2 * f * p->time[i];
    vecmath_sincospi((size_t)p->n, p->cosine, p->sine, p->cosine);
    arma_whiten(p->cosine, p->n, p->filter.a1, p->filter.b1, p->cosine);
    arma_whiten(p->sine, p->n, p->filter.a1, p->filter.b1, p->sine);
}

/* What cosine and sine take from the energy of p->value, whitened and centred; amplitude of the sinusoid to *size. */
static double taken(const struct modulation_problem *p, double f, double *size)
{
    int n = p->n;
    waves_make(p, f);
    double cs[2], cc = modulation_scan_dot(p->cosine, p->cosine, n), slope;
    modulation_scan_project(p->cosine, p->ones, n);
    modulation_scan_project(p->sine, p->ones, n);
    slope = modulation_scan_dot(p->sine, p->cosine, n) / fmax(modulation_scan_dot(p->cosine, p->cosine, n), DBL_MIN);
    modulation_scan_project(p->sine, p->cosine, n);
    double own[2] = {modulation_scan_dot(p->cosine, p->cosine, n), modulation_scan_dot(p->sine, p->sine, n)};
    double with[2] = {modulation_scan_dot(p->value, p->cosine, n), modulation_scan_dot(p->value, p->sine, n)};
    for (int i = 0; i < 2; i++)
        cs[i] = (own[i] > 1e-9 * cc) ? with[i] / own[i] : 0;
    *size = sqrt((cs[0] - slope * cs[1]) * (cs[0] - slope * cs[1]) + cs[1] * cs[1]);
    return cs[0] * with[0] + cs[1] * with[1];
}

/* ------------------------------------------------------------------ scan */

/* Spreads g over the four points of the grid around x (in steps), by Lagrange's weights. */
static void spread(double *grid, double x, double g)
{
    double at = floor(x), u = x - at, *four = grid + (int)at - 1;
    four[0] -= g * u * (u - 1) * (u - 2) / 6;
    four[1] += g * (u + 1) * (u - 1) * (u - 2) / 2;
    four[2] -= g * (u + 1) * u * (u - 2) / 2;
    four[3] += g * (u + 1) * u * (u - 1) / 6;
}

/* power[k] = |sum g exp|^2 at k/PAD cycles per span, k <= PAD top. p->value is whitened and centred. */
static void spectrum_make(const struct modulation_problem *p, double *power)
{
    int step = (int)ceil(FINE * p->top), n = (int)fft_good_size((size_t)PAD * step), last = (int)(PAD * p->top);
    struct arena *a = arena_open();
    double *grid = ARENA_TAKE(a, double, n + 8), *re = ARENA_TAKE(a, double, n / 2 + 1),
           *im = ARENA_TAKE(a, double, n / 2 + 1), g = 0, scale = (double)n / PAD;
    for (int i = p->n - 1; i >= 0; i--) {
        double ahead = (i + 1 < p->n) ? p->value[i + 1] : 0;
        g = p->value[i] + p->filter.a1 * ahead - p->filter.b1 * g;
        spread(grid + 2, (p->time[i] - p->time[0]) * scale, g);
    }
    struct fft *f = fft_open((size_t)n);
    fft_forward(f, grid + 2, re, im);
    fft_close(f);
    for (int k = 0; k <= last; k++)
        power[k] = re[k] * re[k] + im[k] * im[k];
    arena_close(a);
}

/* The scan's best frequency, in cycles per span, of 2 and more. */
static double scan(const struct modulation_problem *p, double *power)
{
    int last = (int)(PAD * p->top), best = 2 * PAD;
    double scale[SCALES], most = 0, ratio = real_log(p->top / 2) / (SCALES - 1);
    spectrum_make(p, power);
    for (int i = 0; i < SCALES; i++) {
        waves_make(p, 2 * real_exp(i * ratio));
        scale[i] =
            real_log(modulation_scan_dot(p->cosine, p->cosine, p->n) + modulation_scan_dot(p->sine, p->sine, p->n));
    }
    for (int k = 2 * PAD; k <= last; k++) {
        double at = real_log(k / (2.0 * PAD)) / ratio;
        int i = (int)fmin(at, SCALES - 2);
        double strength = power[k] / real_exp(scale[i] + (at - i) * (scale[i + 1] - scale[i]));
        if (strength > most) {
            most = strength;
            best = k;
        }
    }
    return (double)best / PAD;
}

/* Probability that white noise reaches z somewhere below p->top. */
static double false_alarm(const struct modulation_problem *p, double z)
{
    double square = modulation_scan_dot(p->time, p->time, p->n) / p->n, sum = 0;
    for (int i = 0; i < p->n; i++)
        sum += p->time[i] / p->n;
    double crossings = p->top * sqrt(4 * REAL_PI * (square - sum * sum)) * sqrt(z) * real_exp(-z);
    return 1 - (1 - real_exp(-z)) * real_exp(-crossings);
}

void modulation_scan_strongest(struct modulation_problem *p, struct modulation *m)
{
    struct arena *a = arena_open();
    double best = -1, size, *power = ARENA_TAKE(a, double, (size_t)(PAD * p->top) + 1);
    centred(p, p->amplitude, p->value);
    double energy = modulation_scan_dot(p->value, p->value, p->n), middle = scan(p, power);
    arena_close(a);
    for (int i = 0; i < NEAR; i++) {
        double f = fmax(2, fmin(middle + 0.5 * (i - NEAR / 2) / (PAD * (NEAR / 2.0)) * 2, p->top)),
               gain = taken(p, f, &size);
        if (gain > best) {
            best = gain;
            m->rate = f;
            m->depth = size / p->filter.mean;
        }
    }
    double z = 0.5 * (p->n - 5) * real_log(energy / fmax(energy - best, 1e-30 * energy));
    m->probability = false_alarm(p, z);
}

/* The strongest sinusoid in amplitudes at irregular times, against their own spectrum.

   Amplitudes of rolling are far from white (a1 about -0.97), so that a plain periodogram is greatest at the lowest
   frequencies whatever there is. So values are whitened first, and where a sinusoid is strongest, and how likely noise
   makes one as strong, is found by a scan.

   What is found is refined as what it is, a factor: m, nu, phi make n ln |W (A/(1 + m sin) - mean)|^2 + 2 sum ln(1 + m
   sin) least (W: the whitening by the ARMA filter of arma.c; the second term is the likelihood's: else a larger factor
   would always win), by GSL's damped Gauss-Newton steps on the residuals times the factor's geometric mean, in turns
   with the ARMA filter of what is left, TURNS times. Errors: from the second differences of half of it. The probability
   is that of the first search, whose filter still has the sinusoid in it: it errs to the careful side. It asks whether
   the amplitudes' mean moves, not whether their deviation does, which would be seen sooner: a deviation that comes and
   goes is no sinusoid, and rough ground has one. */
#include "analysis/modulation.h"

#include <float.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <string.h>

#include "analysis/arma.h"
#include "num/fft.h"
#include "num/real.h"
#include "num/vecmath.h"

/* ------------------------------------------------------------------ scan */

/* Where in the spectrum of amplitudes at irregular times a sinusoid is strongest, against what noise of the same
 * ARMA(1,1) filter does there. */
struct modulation_problem {
    const double *amplitude;
    double *time;     /* [n] from the middle, over `span`: -1/2 to 1/2 or so                         */
    double span, top; /* s; highest frequency in cycles per span                                     */
    int n;
    struct arma filter;            /* of the amplitudes, or of what the modulation leaves                         */
    double *ones;                  /* [n] whitened                                                                */
    double *value, *cosine, *sine; /* [n] work                                                                 */
};

/* The filter of a series, and the series of ones whitened by it. */

/* Takes from x its share of y. */

/* Puts depth, rate (cycles per span) and probability; the phase is left. */

/* Everything is done on values whitened by their ARMA(1,1) filter (arma.c; generalised least squares): with W the
   whitening, energy left without and with a sinusoid Q0 = min |W (A - m)|^2, Q1 = min |W (A - m - c cos - s sin)|^2,
   its strength is z = (n - 5)/2 ln(Q0/Q1); of Gaussian noise exp(-z) reach z at one frequency, and somewhere below f
   (Baluev, Mon. Not. R. Astron. Soc. 385, 2008, 1279, equation 6, after Davies)

     1 - (1 - exp(-z)) exp(-f sqrt(4 pi var T) sqrt(z) exp(-z)).

   Where to look: |sum g_n exp(-2 pi i nu T_n)|^2/D(nu), g = W'W (A - m), by one FFT of the g_n spread over a regular
   grid (four-point Lagrange weights, 8 points a period of the highest frequency, 1 % off at most; a quarter of a cycle
   over the whole from one frequency to the next), D = |W cos|^2 + |W sin|^2 computed at SCALES frequencies and
   interpolated. The winner is then taken exactly, at NEAR frequencies around it. */
enum { SCALES = 48, NEAR = 9, FINE = 8, PAD = 4 };

static double modulation_scan_dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i] * y[i];
    return sum;
}

static void modulation_scan_project(double *x, const double *y, int n)
{
    double yy = modulation_scan_dot(y, y, n), share = (yy > 0) ? modulation_scan_dot(x, y, n) / yy : 0;
    for (int i = 0; i < n; i++)
        x[i] -= share * y[i];
}

static void modulation_scan_filter(struct modulation_problem *p, const double *amplitude)
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

static void modulation_scan_strongest(struct modulation_problem *p, struct modulation *m)
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

enum { TURNS = 3, STEPS = 100, GROUP = 32 };

/* ------------------------------------------------------------------ refinement: c = m cos phi, s = m sin phi (from the
 * middle), f in cycles per span */

/* 1 + m sin of each, to out. */
static void factors(const struct modulation_problem *p, const double at[3], double *out)
{
    for (int i = 0; i < p->n; i++)
        p->cosine[i] = 2 * at[2] * p->time[i];
    vecmath_sincospi((size_t)p->n, p->cosine, p->sine, p->cosine);
    for (int i = 0; i < p->n; i++)
        out[i] = 1 + at[0] * p->sine[i] + at[1] * p->cosine[i];
}

/* The mean logarithm of factors, by products of GROUP of them, which stay within a double's range. False: one is not
 * between 1e-6 and 1e6. */
static bool mean_logarithm(const double *by, int n, double *mean)
{
    double sum = 0;
    for (int i = 0; i < n;) {
        double product = 1;
        for (int end = i + GROUP < n ? i + GROUP : n; i < end; i++) {
            if (!(by[i] > 1e-6 && by[i] < 1e6)) return false;
            product *= by[i];
        }
        sum += real_log(product);
    }
    *mean = sum / n;
    return true;
}

/* Whitened residuals of what is left over their deviation, times the factor's geometric mean. False: the factor is not
 * above 0 everywhere, or out of all bounds. */
static bool left(const struct modulation_problem *p, const double at[3], double *out)
{
    double mean;
    factors(p, at, out);
    if (!mean_logarithm(out, p->n, &mean)) return false;
    for (int i = 0; i < p->n; i++)
        out[i] = p->amplitude[i] / out[i] - p->filter.mean;
    arma_whiten(out, p->n, p->filter.a1, p->filter.b1, out);
    modulation_scan_project(out, p->ones, p->n);
    double by = real_exp(mean) / fmax(p->filter.deviation, 1e-12 * p->filter.mean);
    for (int i = 0; i < p->n; i++)
        out[i] *= by;
    return true;
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *out)
{
    const struct modulation_problem *p = context;
    double at[3] = {gsl_vector_get(x, 0), gsl_vector_get(x, 1), gsl_vector_get(x, 2)};
    bool good = left(p, at, p->value);
    for (int i = 0; i < p->n; i++)
        gsl_vector_set(out, i, good ? p->value[i] : 1e3);
    return GSL_SUCCESS;
}

/* Moves `at` to the least energy near it; conditional errors to `step`. */
static void descend(struct modulation_problem *p, double at[3], double step[3])
{
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    how.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
    how.h_df = 1e-6;
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, p->n, 3);
    gsl_multifit_nlinear_fdf problem = {.f = residuals, .n = p->n, .p = 3, .params = p};
    gsl_vector_view start = gsl_vector_view_array(at, 3);
    int why;
    gsl_multifit_nlinear_init(&start.vector, &problem, w);
    gsl_multifit_nlinear_driver(STEPS, 1e-9, 1e-10, 0, NULL, NULL, &why, w);
    const gsl_matrix *jacobian = gsl_multifit_nlinear_jac(w);
    const gsl_vector *r = gsl_multifit_nlinear_residual(w);
    double energy = 0, own[3] = {0};
    for (int i = 0; i < p->n; i++) {
        energy += gsl_vector_get(r, i) * gsl_vector_get(r, i) / p->n;
        for (int k = 0; k < 3; k++)
            own[k] += gsl_matrix_get(jacobian, i, k) * gsl_matrix_get(jacobian, i, k);
    }
    for (int k = 0; k < 3; k++) {
        at[k] = gsl_vector_get(gsl_multifit_nlinear_position(w), k);
        step[k] = sqrt(energy / fmax(own[k], DBL_MIN));
    }
    gsl_multifit_nlinear_free(w);
}

/* Phases differ so much within a quarter of a cycle that steps need a start: c and s of least energy at the scan's
 * frequency, from sixteen phases. */
static void begin(struct modulation_problem *p, const struct modulation *m, double at[3])
{
    double least = HUGE_VAL, depth = fmin(m->depth, 0.9);
    for (int i = 0; i < 16; i++) {
        double try[3] = {depth * real_cospi(i / 8.0), depth * real_sinpi(i / 8.0), m->rate}, energy;
        if (!left(p, try, p->value)) continue;
        energy = modulation_scan_dot(p->value, p->value, p->n);
        if (energy < least) {
            least = energy;
            memcpy(at, try, sizeof try);
        }
    }
}

/* n/2 ln of the energy left. */
static double misfit(struct modulation_problem *p, const double at[3])
{
    return left(p, at, p->value) ? 0.5 * p->n * real_log(fmax(modulation_scan_dot(p->value, p->value, p->n), DBL_MIN))
                                 : HUGE_VAL;
}

/* Second differences of the misfit at `at`, by a third of an error to each side. */
static void curvature(struct modulation_problem *p, const double at[3], const double step[3], double h[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double sum = 0, di = step[i] / 3, dj = step[j] / 3;
            for (int corner = 0; corner < 4; corner++) {
                double to[3] = {at[0], at[1], at[2]};
                to[i] += (corner & 1) ? -di : di;
                to[j] += (corner & 2) ? -dj : dj;
                sum += ((corner == 1 || corner == 2) ? -1 : 1) * misfit(p, to);
            }
            h[i][j] = h[j][i] = sum / (4 * di * dj);
        }
}

/* The variance of c cos + s sin along `along`, and of f: from the inverse of h. NAN unless h is positive definite. */
static void errors_make(const struct modulation_problem *p, double h[3][3], const double along[2], struct modulation *m)
{
    double cofactor[3][3], determinant = 0, variance = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r = (i + 1) % 3, s = (i + 2) % 3, t = (j + 1) % 3, u = (j + 2) % 3;
            cofactor[i][j] = h[r][t] * h[s][u] - h[r][u] * h[s][t];
        }
    for (int j = 0; j < 3; j++)
        determinant += h[0][j] * cofactor[0][j];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            variance += along[i] * along[j] * cofactor[i][j] / determinant;
    bool good = determinant > 0 && h[0][0] > 0 && cofactor[2][2] > 0;
    m->depth_error = good ? sqrt(variance) : NAN;
    m->rate_error = good ? sqrt(cofactor[2][2] / determinant) / p->span : NAN;
}

static void refine(struct modulation_problem *p, struct arena *a, struct modulation *m)
{
    double at[3], step[3], h[3][3], *rest = ARENA_TAKE(a, double, p->n);
    begin(p, m, at);
    for (int turn = 0; turn < TURNS; turn++) {
        descend(p, at, step);
        factors(p, at, rest);
        for (int i = 0; i < p->n; i++)
            rest[i] = p->amplitude[i] / rest[i];
        modulation_scan_filter(p, rest);
    }
    curvature(p, at, step, h);
    m->depth = sqrt(at[0] * at[0] + at[1] * at[1]);
    m->rate = at[2];
    m->phase = real_atan2(at[1], at[0]);
    errors_make(p, h, (double[2]){at[0] / m->depth, at[1] / m->depth}, m);
}

void modulation_find(const double *time, const double *amplitude, int n, struct arena *a, struct modulation *m)
{
    double middle = 0.5 * (time[0] + time[n - 1]), least = amplitude[0], most = amplitude[0];
    struct modulation_problem p = {.amplitude = amplitude, .n = n, .span = time[n - 1] - time[0], .top = 0.5 * (n - 1)};
    double **rows[] = {&p.time, &p.ones, &p.value, &p.cosine, &p.sine};
    *m = (struct modulation){.probability = 1, .depth_error = NAN, .rate_error = NAN};
    for (int i = 0; i < 5; i++)
        *rows[i] = ARENA_TAKE(a, double, n);
    for (int i = 0; i < n; i++) {
        p.time[i] = (time[i] - middle) / p.span;
        least = fmin(least, amplitude[i]);
        most = fmax(most, amplitude[i]);
    }
    if (!(most - least > 1e-9 * fmax(fabs(most), fabs(least)))) return;
    modulation_scan_filter(&p, amplitude);
    if (!(p.filter.mean > 3 * sqrt(p.filter.mean_variance))) return;
    modulation_scan_strongest(&p, m);
    m->found = m->probability < MODULATION_PROBABILITY;
    if (m->found) refine(&p, a, m);
    m->rate /= p.span;
    m->phase -= 2 * REAL_PI * m->rate * middle;
    m->phase -= 2 * REAL_PI * floor(m->phase / (2 * REAL_PI));
}

void modulation_divide(const struct modulation *m, const double *time, const double *amplitude, int n, double *out)
{
    for (int i = 0; i < n; i++)
        out[i] = amplitude[i] / (1 + m->depth * real_sin(2 * REAL_PI * m->rate * time[i] + m->phase));
}

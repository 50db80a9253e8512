/* The strongest sinusoid in amplitudes at irregular times, against their own spectrum.

   Amplitudes of rolling are far from white (a1 about -0.97), so that a plain periodogram is greatest at the lowest
   frequencies whatever there is. So values are whitened first, and where a sinusoid is strongest, and how likely noise
   makes one as strong, is found in modulation_scan.c.

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

#include "analysis/modulation_scan.h"
#include "num/real.h"
#include "num/vecmath.h"

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

/* ------------------------------------------------------------------ */

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

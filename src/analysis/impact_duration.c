/* The two steps of papers/002, section IV-E2: outliers (impacts that run into each other) spoil a fit of both
   parameters to rolling, so theta is taken from single impacts and only zeta from the series. Both are least squares of
   log t0, where the law is a line:

     log t0 = log zeta - theta log |A|,     log zeta = mean of (log t0 + theta log |A|) where theta is given.

   R^2 = 1 - sum of squared errors / sum of squares about the mean; of t0 with the law so found, and of log t0. The
   paper does not say which it prints. An R^2 below 0 says that a constant would do better; of durations that are all
   alike there is none. The standard error of theta is that of the scatter: durations measured in a force are right
   within 0.5 % only (impact_find.c), which over a decade of amplitudes moves theta by up to 0.003. */
#include "analysis/impact_duration.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "num/real.h"

#define ALIKE 1e-9 /* of their mean: durations that differ by less are all alike, and theta is 0 exactly */

static bool known(const struct impact_events *v, int i, bool only_alone)
{
    return v->duration[i] > 0 && v->amplitude[i] != 0 && (v->alone[i] || !only_alone);
}

static void r2_both(const struct impact_events *v, bool only_alone, const double law[2], double r2[2])
{
    double n = 0, sum[2] = {0}, squares[2] = {0}, errors[2] = {0};
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            sum[0] += v->duration[i];
            sum[1] += real_log(v->duration[i]);
            n++;
        }
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            double y = real_log(v->duration[i]), fit = real_log(law[0]) - law[1] * real_log(fabs(v->amplitude[i]));
            double d[2] = {v->duration[i] - sum[0] / n, y - sum[1] / n},
                   e[2] = {v->duration[i] - real_exp(fit), y - fit};
            for (int k = 0; k < 2; k++) {
                squares[k] += d[k] * d[k];
                errors[k] += e[k] * e[k];
            }
        }
    double alike = n * (ALIKE * sum[0] / n) * (ALIKE * sum[0] / n);
    for (int k = 0; k < 2; k++)
        r2[k] = squares[0] > alike ? 1 - errors[k] / squares[k] : errors[0] > alike ? -HUGE_VAL : NAN;
}

/* y = c0 + c1 x; error: of c1. False: x are all alike. */
static bool line_fit(const struct impact_events *v, bool only_alone, double c[2], double *error)
{
    double n = 0, mx = 0, my = 0, sxx = 0, sxy = 0, syy = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            double x = real_log(fabs(v->amplitude[i])), y = real_log(v->duration[i]);
            n++;
            double dx = x - mx, dy = y - my; /* running means: no difference of large sums */
            mx += dx / n;
            my += dy / n;
            sxx += dx * (x - mx);
            sxy += dx * (y - my);
            syy += dy * (y - my);
        }
    if (n < IMPACT_DURATION_LEAST || sxx < 4e-4 * n) return false;
    c[1] = syy > ALIKE * ALIKE * n ? sxy / sxx : 0;
    c[0] = my - c[1] * mx;
    *error = sqrt(fmax(syy - c[1] * sxy, 0) / (n - 2) / sxx);
    return true;
}

bool impact_duration_single(const struct impact_events *v, bool only_alone, struct impact_duration *d)
{
    double c[2], error, r2[2];
    long n = 0;
    for (int i = 0; i < v->n; i++)
        n += known(v, i, only_alone);
    d->singles = n;
    if (!line_fit(v, only_alone, c, &error)) return false;
    d->theta = d->theta_single = -c[1];
    d->theta_error = error;
    d->zeta_single = real_exp(c[0]);
    r2_both(v, only_alone, (const double[2]){d->zeta_single, d->theta}, r2);
    d->r2_single = r2[0];
    d->r2_single_log = r2[1];
    return true;
}

bool impact_duration_series(const struct impact_events *v, struct impact_duration *d)
{
    double sum = 0, r2[2];
    d->n = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, false)) {
            sum += real_log(v->duration[i]) + d->theta * real_log(fabs(v->amplitude[i]));
            d->n++;
        }
    if (d->n == 0) return false;
    d->zeta = real_exp(sum / (double)d->n);
    r2_both(v, false, (const double[2]){d->zeta, d->theta}, r2);
    d->r2 = r2[0];
    d->r2_log = r2[1];
    return true;
}

bool impact_duration_constant(const struct impact_events *v, struct arena *a, struct impact_duration *d)
{
    double *duration = ARENA_TAKE(a, double, v->n + 1), r2[2];
    size_t n = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, false)) duration[n++] = v->duration[i];
    d->n = (long)n;
    d->theta = 0;
    if (n == 0) return false;
    gsl_sort(duration, 1, n);
    d->zeta = gsl_stats_median_from_sorted_data(duration, 1, n);
    r2_both(v, false, (const double[2]){d->zeta, 0}, r2);
    d->r2 = r2[0];
    d->r2_log = r2[1];
    return true;
}

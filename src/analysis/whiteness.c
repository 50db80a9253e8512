/* Correlations r_k = sum (x_n - m)(x_(n+k) - m)/sum (x_n - m)^2; Q = n (n + 2) sum_k r_k^2/(n - k), chi-squared with
   lags - fitted degrees of freedom (Ljung and Box, Biometrika 65, 1978, 297). One process that drives two series, each
   by its own rising function, gives ranks that are alike, whatever the distributions: Spearman's correlation, equal
   values having their mean rank. */
#include "analysis/whiteness.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>

static double mean_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    return sum / n;
}

/* sum (x_i - mx)(y_(i+k) - my) */
static double product(const double *x, const double *y, int n, int k, const double mean[2])
{
    double sum = 0;
    for (int i = (k < 0) ? -k : 0; i < n && i + k < n; i++)
        sum += (x[i] - mean[0]) * (y[i + k] - mean[1]);
    return sum;
}

void whiteness_cross(const double *x, const double *y, int n, int lags, double *out)
{
    double mean[2] = {mean_of(x, n), mean_of(y, n)}, own[2] = {mean[0], mean[0]}, other[2] = {mean[1], mean[1]};
    double scale = sqrt(product(x, x, n, 0, own) * product(y, y, n, 0, other));
    for (int k = 1 - lags; k < lags; k++)
        out[k + lags - 1] = (scale > 0) ? product(x, y, n, k, mean) / scale : 0;
}

void whiteness_correlation(const double *x, int n, int lags, double *out)
{
    double mean[2] = {mean_of(x, n), 0};
    mean[1] = mean[0];
    double energy = product(x, x, n, 0, mean);
    for (int k = 0; k < lags; k++)
        out[k] = (k == 0) ? 1 : (energy > 0) ? product(x, x, n, k, mean) / energy : 0;
}

double whiteness_box(const double *correlation, int n, int lags, int fitted, double *p)
{
    double q = 0;
    for (int k = 1; k <= lags; k++)
        q += correlation[k] * correlation[k] / (n - k);
    q *= n * (n + 2.0);
    *p = gsl_cdf_chisq_Q(q, lags - fitted);
    return q;
}

/* rank[i] of x[i], from 0; equal values have their mean. */
static void ranks_make(const double *x, int n, size_t *order, double *rank)
{
    gsl_sort_index(order, x, 1, n);
    for (int i = 0, next; i < n; i = next) {
        for (next = i + 1; next < n && x[order[next]] == x[order[i]];)
            next++;
        for (int k = i; k < next; k++)
            rank[order[k]] = 0.5 * (i + next - 1);
    }
}

double whiteness_ranks(const double *x, const double *y, int n, struct arena *a)
{
    size_t *order = ARENA_TAKE(a, size_t, n);
    double *rank_x = ARENA_TAKE(a, double, n), *rank_y = ARENA_TAKE(a, double, n);
    double mean[2] = {0.5 * (n - 1), 0.5 * (n - 1)};
    ranks_make(x, n, order, rank_x);
    ranks_make(y, n, order, rank_y);
    double scale = product(rank_x, rank_x, n, 0, mean) * product(rank_y, rank_y, n, 0, mean);
    return (scale > 0) ? product(rank_x, rank_y, n, 0, mean) / sqrt(scale) : NAN;
}

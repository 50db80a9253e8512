/* Gains of given decays: a linear least-squares problem, by orthogonal columns (Gram and Schmidt, twice, which leaves
   them orthogonal to rounding); a column of which less than 1e-10 is left depends on those before it, and has gain 0.
 */
#include "response/slopes_gains.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

LANES_CLONES
double slopes_gains_dot(const double *x, const double *y, int n)
{
    double sum[LANES] = {0};
    int i = 0;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += x[i + l] * y[i + l];
    for (; i < n; i++)
        sum[0] += x[i] * y[i];
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

LANES_CLONES
static void take_off(double *restrict x, const double *restrict q, double by, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] -= by * q[i];
}

void slopes_gains_project(const struct slopes_gains *g, int k, double *x, int from, int n, double *c)
{
    for (int pass = 0; pass < 2; pass++)
        for (int j = 0; j < k; j++) {
            double by = slopes_gains_dot(g->q[j] + from, x + from, n);
            take_off(x + from, g->q[j] + from, by, n);
            if (c) c[j] += by;
        }
}

double slopes_gains_unit(double *x, int n, double before)
{
    double size = sqrt(slopes_gains_dot(x, x, n));
    bool gone = !(size > 1e-10 * before);
    for (int i = 0; i < n; i++)
        x[i] = gone ? 0.0 : x[i] / size;
    return gone ? 0.0 : size;
}

/* Gains of one series by back-substitution in R g = c. */
static void solve_gains(int k, double R[][SLOPES_MOST], const double *c, double *gain)
{
    memset(gain, 0, SLOPES_MOST * sizeof *gain);
    for (int j = k - 1; j >= 0; j--) {
        double sum = c[j];
        for (int i = j + 1; i < k; i++)
            sum -= R[j][i] * gain[i];
        gain[j] = R[j][j] > 0.0 ? sum / R[j][j] : 0.0;
    }
}

static void fit_series(struct slopes_gains *g, int s, int from, int k)
{
    double R[SLOPES_MOST][SLOPES_MOST] = {{0}}, c[SLOPES_MOST] = {0};
    int n = g->series[s].n;
    for (int j = 0; j < k; j++) {
        double column[SLOPES_MOST] = {0};
        memcpy(g->q[j] + from, g->e[j] + from, (size_t)n * sizeof(double));
        double before = sqrt(slopes_gains_dot(g->e[j] + from, g->e[j] + from, n));
        slopes_gains_project(g, j, g->q[j], from, n, column);
        for (int i = 0; i < j; i++)
            R[i][j] = column[i];
        R[j][j] = slopes_gains_unit(g->q[j] + from, n, before);
    }
    memcpy(g->r + from, g->a + from, (size_t)n * sizeof(double));
    slopes_gains_project(g, k, g->r, from, n, c);
    solve_gains(k, R, c, g->series[s].gain);
}

void slopes_gains_exponentials(const struct slopes_gains *g, double x, double *e)
{
    double d = -real_exp(x);
    for (int i = 0; i < g->samples; i++)
        e[i] = d * g->t[i];
    vecmath_exp((size_t)g->samples, e, e);
}

double slopes_gains_fit(struct slopes_gains *g, const double *x, int k)
{
    for (int j = 0; j < k; j++)
        slopes_gains_exponentials(g, x[j], g->e[j]);
    for (int s = 0, from = 0; s < g->count; from += g->series[s++].n)
        fit_series(g, s, from, k);
    return slopes_gains_dot(g->r, g->r, g->samples);
}

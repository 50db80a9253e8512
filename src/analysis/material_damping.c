#include "analysis/material_damping.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "num/noise.h"
#include "num/real.h"

enum { HALVINGS = 12 };

static const double alike = 1e-4;       /* of decays: the least scatter */
static const double normal = 0.709;     /* mean of the soft L1 of a standard normal deviate */
static const double rough = 0.15;       /* the scatter of decays that are too few to say */
static const double unseen = 0.01;      /* of a decay: a term that nowhere makes more is none */
static const double undetermined = 4.0; /* of a logarithm: what may as well be 50 times more or less has no interval */

static const struct {
    const char *name;
    int n;
    int term[3]; /* 0: 1, 1: lambda, 2: sqrt(lambda); of the first seven */
    const char *parameter[3], *unit[3];
} laws[MATERIAL_LAWS] = {
    {"alpha", 1, {0}, {"alpha"}, {"1/s"}},
    {"beta", 1, {1}, {"beta"}, {"s"}},
    {"loss", 1, {2}, {"loss"}, {""}},
    {"rayleigh", 2, {0, 1}, {"alpha", "beta"}, {"1/s", "s"}},
    {"alpha_loss", 2, {0, 2}, {"alpha", "loss"}, {"1/s", ""}},
    {"beta_loss", 2, {1, 2}, {"beta", "loss"}, {"s", ""}},
    {"alpha_beta_loss", 3, {0, 1, 2}, {"alpha", "beta", "loss"}, {"1/s", "s", ""}},
    {"power", 2, {0}, {"decay_at_1khz", "exponent"}, {"1/s", ""}},
    {"zener", 2, {0}, {"strength", "relaxation_time"}, {"", "s"}},
};

/* log of the decay and its derivatives to the parameters' logarithms (of an exponent: to itself). */
static double law_log(int law, const double *x, double lambda, double *slope)
{
    double w = sqrt(lambda), sum = 0.0, part[3];
    if (law == MATERIAL_POWER) {
        double octave = real_log(w / (2000.0 * REAL_PI));
        slope[0] = 1.0;
        slope[1] = octave;
        return x[0] + x[1] * octave;
    }
    if (law == MATERIAL_ZENER) {
        double t = real_exp(x[1]), wt2 = lambda * t * t;
        slope[0] = 1.0;
        slope[1] = (1.0 - wt2) / (1.0 + wt2);
        return x[0] + x[1] + real_log(0.5 * lambda / (1.0 + wt2));
    }
    for (int k = 0; k < laws[law].n; k++) {
        int term = laws[law].term[k];
        part[k] = 0.5 * real_exp(x[k]) * (term == 0 ? 1.0 : term == 1 ? lambda : w);
        sum += part[k];
    }
    for (int k = 0; k < laws[law].n; k++)
        slope[k] = part[k] / sum;
    return real_log(sum);
}

/* a x = b by elimination with pivots; n up to 3. */
static bool solve(int n, double a[3][3], double *b)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            best = fabs(a[i][k]) > fabs(a[best][k]) ? i : best;
        if (!(fabs(a[best][k]) > 1e-300)) return false;
        for (int j = 0; j < n; j++) {
            double t = a[k][j];
            a[k][j] = a[best][j];
            a[best][j] = t;
        }
        double t = b[k];
        b[k] = b[best];
        b[best] = t;
        for (int i = k + 1; i < n; i++) {
            double share = a[i][k] / a[k][k];
            for (int j = k; j < n; j++)
                a[i][j] -= share * a[k][j];
            b[i] -= share * b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return true;
}

/* Soft-L1 cost, 2 (sqrt(1 + r^2) - 1) summed, and its normal equations. */
static double damping_equations(int law, const double *x, const struct material_decay *d, int n, const double *times,
                                double a[3][3], double b[3])
{
    double cost = 0.0, slope[3];
    int m = laws[law].n;
    memset(a, 0, 9 * sizeof(double));
    memset(b, 0, 3 * sizeof(double));
    for (int i = 0; i < n; i++) {
        double t = times ? times[i] : 1.0, rest = (d[i].log_decay - law_log(law, x, d[i].lambda, slope)) / d[i].sigma,
               root = sqrt(1.0 + rest * rest);
        cost += t * 2.0 * (root - 1.0);
        for (int k = 0; k < m; k++) {
            b[k] += t / root * slope[k] / d[i].sigma * rest;
            for (int l = 0; l < m; l++)
                a[k][l] += t / root * slope[k] * slope[l] / (d[i].sigma * d[i].sigma);
        }
    }
    return cost;
}

/* Levenberg and Marquardt from x; returns the cost. */
static double damping_descend(int law, double *x, const struct material_decay *d, int n, const double *times)
{
    double a[3][3], b[3], step[3], more[3][3], to[3], unused[3][3], none[3], mu = 1e-3;
    int m = laws[law].n;
    double cost = damping_equations(law, x, d, n, times, a, b);
    for (int pass = 0; pass < 60 && mu < 1e8; pass++) {
        memcpy(more, a, sizeof more);
        memcpy(step, b, sizeof step);
        for (int k = 0; k < m; k++)
            more[k][k] += mu * (a[k][k] + 1e-9);
        if (!solve(m, more, step)) break;
        double size = 0.0;
        for (int k = 0; k < m; k++) {
            step[k] = fmin(fmax(step[k], -2.0), 2.0);
            to[k] = x[k] + step[k];
            size = fmax(size, fabs(step[k]));
        }
        double here = damping_equations(law, to, d, n, times, unused, none);
        if (here <= cost) {
            memcpy(x, to, (size_t)m * sizeof *x);
            cost = damping_equations(law, x, d, n, times, a, b);
            mu *= 0.2;
            if (size < 1e-7) break;
        } else
            mu *= 5.0;
    }
    return cost;
}

/* The best of several starts: each term alone makes the median decay, or a fiftieth of it. */
static double damping_search(int law, double *x, const struct material_decay *d, int n)
{
    double best = INFINITY, one[3], middle[2],
           *sorted[2] = {malloc(sizeof(double) * (size_t)n), malloc(sizeof(double) * (size_t)n)};
    for (int i = 0; i < n; i++) {
        sorted[0][i] = real_log(d[i].lambda);
        sorted[1][i] = d[i].log_decay;
    }
    for (int k = 0; k < 2; k++) {
        gsl_sort(sorted[k], 1, (size_t)n);
        middle[k] = sorted[k][n / 2];
        free(sorted[k]);
    }
    const int starts = law == MATERIAL_ZENER ? 7 : law == MATERIAL_POWER ? 1 : laws[law].n > 1 ? 1 << laws[law].n : 1;
    for (int s = 0; s < starts; s++) {
        for (int k = 0; k < laws[law].n; k++) {
            int term = laws[law].term[k];
            one[k] = middle[1] + real_log(2.0) -
                     (term == 0   ? 0.0
                      : term == 1 ? middle[0]
                                  : 0.5 * middle[0]) -
                     (s >> k & 1 ? real_log(50.0) : 0.0);
        }
        if (law == MATERIAL_POWER) {
            one[0] = middle[1];
            one[1] = 0.5;
        } else if (law == MATERIAL_ZENER) {
            one[1] = -0.5 * middle[0] + s - 3.0; /* w t from e^-3 to e^3 */
            one[0] = 0.0;
            double slope[3];
            one[0] = middle[1] - law_log(law, one, real_exp(middle[0]), slope);
        }
        double cost = damping_descend(law, one, d, n, NULL);
        if (cost < best) {
            best = cost;
            memcpy(x, one, sizeof one);
        }
    }
    return best;
}

static int by_size(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

double material_damping_student(double freedoms) { return gsl_cdf_tdist_Pinv(0.975, fmax(freedoms, 1.0)); }

double material_damping_spread(double *draw, double value)
{
    qsort(draw, MATERIAL_DRAWS, sizeof *draw, by_size);
    return fmax(draw[(int)(0.975 * MATERIAL_DRAWS)] - value, value - draw[(int)(0.025 * MATERIAL_DRAWS)]);
}

void material_damping_resample(int draw, const char *what, int n, double *times)
{
    struct noise s = noise_make(1, what);
    memset(times, 0, (size_t)n * sizeof *times);
    for (int i = 0; i < n; i++)
        times[(int)(noise_uniform(s, (uint64_t)draw, (uint64_t)i) * n)] += 1.0;
}

void material_damping_fit(int law, const struct material_decay *d, int n, struct material_damping *g)
{
    struct arena *room = arena_open();
    const int m = laws[law].n;
    double x[3] = {0}, most[3] = {0}, square = 0.0, slope[3], matrix[3][3], b[3], *times = ARENA_TAKE(room, double, n),
           *draws = ARENA_TAKE(room, double, 3 * MATERIAL_DRAWS);
    *g = (struct material_damping){.name = laws[law].name, .n = m, .bic = INFINITY};
    for (int k = 0; k < m; k++) {
        g->parameter[k] = laws[law].parameter[k];
        g->unit[k] = laws[law].unit[k];
        g->figure[k] = (struct material_figure){NAN, NAN, NAN};
    }
    if (n > m) {
        double cost = damping_search(law, x, d, n), birge = sqrt(cost / (n - m));
        for (int i = 0; i < n; i++) {
            double rest = d[i].log_decay - law_log(law, x, d[i].lambda, slope);
            square += rest * rest;
            for (int k = 0; k < m; k++)
                most[k] = fmax(most[k], slope[k]); /* of a sum each one's share of the decay */
        }
        g->scatter = sqrt(square / n);
        g->bic = n * real_log(fmax(cost, 1e-300) / n) + m * real_log(n);
        for (int i = 0; i < MATERIAL_DRAWS; i++) {
            double one[3];
            memcpy(one, x, sizeof one);
            material_damping_resample(i, "damping", n, times);
            damping_descend(law, one, d, n, times);
            for (int k = 0; k < m; k++)
                draws[k * MATERIAL_DRAWS + i] = one[k];
        }
        for (int k = 0; k < m; k++) {
            damping_equations(law, x, d, n, NULL, matrix, b);
            for (int l = 0; l < m; l++) {
                matrix[l][l] *= 1.0 + 1e-12;
                b[l] = l == k;
            }
            double half =
                solve(m, matrix, b) ? material_damping_student(n - m) * birge * sqrt(fmax(b[k], 0.0)) : INFINITY;
            half = fmax(half, material_damping_spread(draws + k * MATERIAL_DRAWS, x[k]));
            bool log_scale = !(law == MATERIAL_POWER && k == 1);
            if (law < MATERIAL_POWER && most[k] < unseen) {
                g->figure[k].value = 0.0; /* and there is no interval: the others do without it */
                continue;
            }
            if (log_scale && half > undetermined) half = NAN;
            g->figure[k].value = log_scale ? real_exp(x[k]) : x[k];
            g->figure[k].low = log_scale ? real_exp(x[k] - half) : x[k] - half;
            g->figure[k].high = log_scale ? real_exp(x[k] + half > 700.0 ? 700.0 : x[k] + half) : x[k] + half;
        }
    }
    arena_close(room);
}

double material_damping_scatter(const struct material_decay *d, int n)
{
    const int free = n - laws[MATERIAL_ALL].n;
    double low = real_log(alike), high = 0.0, x[3];
    struct arena *room = arena_open();
    struct material_decay *one = ARENA_TAKE(room, struct material_decay, n);
    for (int pass = 0; free > 0 && pass < HALVINGS; pass++) {
        double tau = real_exp(0.5 * (low + high));
        for (int i = 0; i < n; i++) {
            one[i] = d[i];
            one[i].sigma = sqrt(d[i].sigma * d[i].sigma + tau * tau);
        }
        *(damping_search(MATERIAL_ALL, x, one, n) > normal * free ? &low : &high) = real_log(tau);
    }
    arena_close(room);
    return free > 0 ? real_exp(high) : rough;
}

double material_damping_decay(int law, const double *parameter, double lambda)
{
    double x[3] = {0}, slope[3];
    for (int k = 0; k < laws[law].n; k++)
        x[k] = law == MATERIAL_POWER && k == 1 ? parameter[k] : real_log(fmax(parameter[k], 1e-300));
    return real_exp(law_log(law, x, lambda, slope));
}

void material_damping_terms(const struct material_damping *g, int law, double damping[3])
{
    damping[0] = damping[1] = damping[2] = 0.0;
    for (int k = 0; law < MATERIAL_POWER && k < laws[law].n; k++)
        damping[laws[law].term[k]] = g[law].figure[k].value;
}

/* Least-squares fit of sums of real exponentials to envelopes.

       A_s(t) ~ sum_k g_sk e^(-d_k t),   minimise sum_s sum_i (A_s(t_i) - sum_k g_sk e^(-d_k t_i))^2 over d_k > 0 and
   any g_sk

   Variable projection (Golub, Pereyra, SIAM J. Numer. Anal. 10, 1973): for given decays the gains are a linear
   least-squares problem, so that only x_k = log(d_k T), T the longest time, is searched, by Levenberg
   and Marquardt's steps with Kaufman's derivative (BIT 15, 1975): r = P a, dr/dx_k = P (g_k d_k t e^(-d_k t)), P the
   projection off the columns. Times may be unevenly spaced, which matrix pencils do not allow.

   Starts: slopes are added one by one; a grid of decays, 8 a decade, is tried beside those found so far, and the search
   goes on from the STARTS best peaks of what each would take off the error. Decays lie between 1e-3/T and 10 over the
   least step of time; one is 1.49 times the next at least, or gains would be large and cancel (and between places not
   any more: t e^(-d t) has gains of 16 times its peak so, -67 dB off).

   The number is the least whose error is within a tenth of the smallest found; it stops growing below 1e-3, or when two
   more in a row bring less than a tenth. Each sample counts the same: where the shape matters, sample it densely. Only
   + - * / sqrt and num/: same bits everywhere. */
#include "response/slopes.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

/* The linear part of slopes.c. */
struct gains {
    struct slopes_series *series;
    int count, samples;                      /* series; samples of all */
    double *t, *a;                           /* [samples] time/T, amplitudes/largest, series after series */
    double *e[SLOPES_MOST], *q[SLOPES_MOST]; /* [samples] columns e^(-exp(x) t), orthogonal columns */
    double *r;                               /* [samples] residual */
};

/* Gains of given decays: a linear least-squares problem, by orthogonal columns (Gram and Schmidt, twice, which leaves
   them orthogonal to rounding); a column of which less than 1e-10 is left depends on those before it, and has gain 0.
 */

LANES_CLONES
static double dot(const double *x, const double *y, int n)
{
    double sum[LANES] = {0};
    int i = 0;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += x[i + l] * y[i + l];
    for (; i < n; i++)
        sum[0] += x[i] * y[i];
    return lanes_total(sum);
}

LANES_CLONES
static void take_off(double *restrict x, const double *restrict q, double by, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        x[i] -= by * q[i];
}

/* Takes the directions q[0 .. k) off x[from .. from + n), twice; coefficients are added to c (NULL: not wanted). */
static void project(const struct gains *g, int k, double *x, int from, int n, double *c)
{
    for (int pass = 0; pass < 2; pass++)
        for (int j = 0; j < k; j++) {
            double by = dot(g->q[j] + from, x + from, n);
            take_off(x + from, g->q[j] + from, by, n);
            if (c) c[j] += by;
        }
}

/* Unit length, or 0 when next to nothing is left of `before`. Returns the length. */
static double make_unit(double *x, int n, double before)
{
    double size = sqrt(dot(x, x, n));
    bool none = !(size > 1e-10 * before);
    for (int i = 0; i < n; i++)
        x[i] = none ? 0.0 : x[i] / size;
    return none ? 0.0 : size;
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

static void fit_series(struct gains *g, int s, int from, int k)
{
    double R[SLOPES_MOST][SLOPES_MOST] = {{0}}, c[SLOPES_MOST] = {0};
    int n = g->series[s].n;
    for (int j = 0; j < k; j++) {
        double column[SLOPES_MOST] = {0};
        memcpy(g->q[j] + from, g->e[j] + from, (size_t)n * sizeof(double));
        double before = sqrt(dot(g->e[j] + from, g->e[j] + from, n));
        project(g, j, g->q[j], from, n, column);
        for (int i = 0; i < j; i++)
            R[i][j] = column[i];
        R[j][j] = make_unit(g->q[j] + from, n, before);
    }
    memcpy(g->r + from, g->a + from, (size_t)n * sizeof(double));
    project(g, k, g->r, from, n, c);
    solve_gains(k, R, c, g->series[s].gain);
}

static void exponentials(const struct gains *g, double x, double *e)
{
    double d = -real_exp(x);
    for (int i = 0; i < g->samples; i++)
        e[i] = d * g->t[i];
    vecmath_exp((size_t)g->samples, e, e);
}

/* Fits the gains for the decays exp(x[k])/T; returns the sum of squares that is left (in r). */
static double fit_gains(struct gains *g, const double *x, int k)
{
    for (int j = 0; j < k; j++)
        exponentials(g, x[j], g->e[j]);
    for (int s = 0, from = 0; s < g->count; from += g->series[s++].n)
        fit_series(g, s, from, k);
    return dot(g->r, g->r, g->samples);
}

enum { STARTS = 2, STEPS = 40, PER_DECADE = 8 };

static const double enough = 1e-3, spacing = 0.4; /* of the error; of x */

struct work {
    struct gains g;
    double largest;         /* |amplitude| */
    double low, high;       /* bounds of x */
    double *v[SLOPES_MOST]; /* [samples] derivatives */
    int grid;
    double *column; /* [grid][samples] */
};

/* ------------------------------------------------------------------ search */

/* Into the bounds and apart: sorts, and moves what is too near by equal shares. False: there is no room. */
static bool space_out(const struct work *w, double *x, int k)
{
    gsl_sort(x, 1, (size_t)k);
    for (int pass = 0; pass < 30; pass++) {
        bool good = true;
        x[0] = fmax(x[0], w->low);
        x[k - 1] = fmin(x[k - 1], w->high);
        for (int j = 1; j < k; j++) {
            double lack = 0.5 * (spacing - (x[j] - x[j - 1]));
            if (lack > 1e-9) {
                x[j - 1] -= lack;
                x[j] += lack;
                good = false;
            }
        }
        if (good && x[0] >= w->low && x[k - 1] <= w->high) return true;
    }
    return false;
}

/* Solves A y = b of k unknowns, A symmetric and positive definite (Cholesky, in place); false: it is not. */
static bool cholesky(int k, double A[][SLOPES_MOST], double *b)
{
    for (int i = 0; i < k; i++)
        for (int j = 0; j <= i; j++) {
            double sum = A[i][j];
            for (int m = 0; m < j; m++)
                sum -= A[i][m] * A[j][m];
            if (i == j && !(sum > 0.0)) return false;
            A[i][j] = i == j ? sqrt(sum) : sum / A[j][j];
        }
    for (int i = 0; i < k; i++) {
        for (int m = 0; m < i; m++)
            b[i] -= A[i][m] * b[m];
        b[i] /= A[i][i];
    }
    for (int i = k - 1; i >= 0; i--) {
        for (int m = i + 1; m < k; m++)
            b[i] -= A[m][i] * b[m];
        b[i] /= A[i][i];
    }
    return true;
}

/* dr/dx of each decay. */
static void derivatives(struct work *w, const double *x, int k)
{
    for (int j = 0; j < k; j++) {
        double d = real_exp(x[j]);
        for (int s = 0, from = 0; s < w->g.count; from += w->g.series[s++].n) {
            double by = w->g.series[s].gain[j] * d;
            for (int i = from; i < from + w->g.series[s].n; i++)
                w->v[j][i] = by * w->g.t[i] * w->g.e[j][i];
            project(&w->g, k, w->v[j], from, w->g.series[s].n, NULL);
        }
    }
}

/* x + step of Levenberg and Marquardt; false: none. */
static bool step(const struct work *w, const double *x, int k, double damping, double *to)
{
    double A[SLOPES_MOST][SLOPES_MOST] = {{0}}, b[SLOPES_MOST];
    for (int i = 0; i < k; i++) {
        b[i] = -dot(w->v[i], w->g.r, w->g.samples);
        for (int j = 0; j <= i; j++)
            A[i][j] = dot(w->v[i], w->v[j], w->g.samples);
    }
    for (int i = 0; i < k; i++)
        A[i][i] += damping * A[i][i];
    if (!cholesky(k, A, b)) return false;
    for (int i = 0; i < k; i++)
        to[i] = x[i] + fmin(fmax(b[i], -1.0), 1.0);
    return true;
}

/* Moves x[k] to a minimum near it and returns the sum of squares there. */
static double descend(struct work *w, double *x, int k)
{
    double least = fit_gains(&w->g, x, k), damping = 1e-2, to[SLOPES_MOST];
    for (int i = 0, idle = 0; i < STEPS && idle < 3 && damping < 1e9; i++) {
        derivatives(w, x, k);
        double sum = HUGE_VAL;
        while (damping < 1e9 && step(w, x, k, damping, to)) {
            sum = space_out(w, to, k) ? fit_gains(&w->g, to, k) : HUGE_VAL;
            if (sum < least) break;
            damping *= 4.0;
        }
        if (!(sum < least)) break;
        idle = sum > least * (1.0 - 1e-6) ? idle + 1 : 0;
        least = sum;
        damping *= 0.1;
        memcpy(x, to, (size_t)k * sizeof *x);
    }
    return fit_gains(&w->g, x, k);
}

static double grid_at(const struct work *w, int g) { return w->low + (w->high - w->low) * g / (w->grid - 1); }

/* What one more column of the grid would take off the sum of squares, beside the k that are fitted; v[0] is work. */
static double improvement(struct work *w, int g, int k)
{
    double sum = 0.0;
    memcpy(w->v[0], w->column + (size_t)g * w->g.samples, (size_t)w->g.samples * sizeof(double));
    for (int s = 0, from = 0; s < w->g.count; from += w->g.series[s++].n) {
        int n = w->g.series[s].n;
        double before = sqrt(dot(w->v[0] + from, w->v[0] + from, n));
        project(&w->g, k, w->v[0], from, n, NULL);
        make_unit(w->v[0] + from, n, before);
        double by = dot(w->v[0] + from, w->g.r + from, n);
        sum += by * by;
    }
    return sum;
}

/* The best peaks over the grid, as starts. */
static int starts(struct work *w, int k, double *start)
{
    double best[STARTS] = {0}, before = 0.0, here = improvement(w, 0, k);
    int n = 0;
    for (int g = 0; g < w->grid; g++) {
        double after = g + 1 < w->grid ? improvement(w, g + 1, k) : 0.0;
        bool peak = here >= before && here >= after && here > 0.0;
        int at = n < STARTS ? n : STARTS;
        while (peak && at > 0 && best[at - 1] < here)
            at--;
        if (peak && at < STARTS) {
            n += n < STARTS;
            memmove(best + at + 1, best + at, (size_t)(n - 1 - at) * sizeof *best);
            memmove(start + at + 1, start + at, (size_t)(n - 1 - at) * sizeof *start);
            best[at] = here;
            start[at] = grid_at(w, g);
        }
        before = here;
        here = after;
    }
    return n;
}

/* Adds a decay to x[k]; false: no place for one. */
static bool grow(struct work *w, double *x, int k, double *least)
{
    double start[STARTS], best[SLOPES_MOST] = {0};
    fit_gains(&w->g, x, k);
    int n = starts(w, k, start);
    *least = HUGE_VAL;
    for (int i = 0; i < n; i++) {
        double to[SLOPES_MOST];
        memcpy(to, x, (size_t)k * sizeof *x);
        to[k] = start[i];
        double sum = space_out(w, to, k + 1) ? descend(w, to, k + 1) : HUGE_VAL;
        if (sum < *least) {
            *least = sum;
            memcpy(best, to, sizeof best);
        }
    }
    if (!(*least < HUGE_VAL)) return false;
    memcpy(x, best, (size_t)(k + 1) * sizeof *x);
    return true;
}

/* Fills times and amplitudes, in units of T and of the largest; returns T. */
static double lay_out(struct arena *a, struct work *w, int *most)
{
    double longest = 0.0, step = HUGE_VAL;
    for (int s = 0; s < w->g.count; s++) {
        const struct slopes_series *p = &w->g.series[s];
        w->g.samples += p->n;
        longest = fmax(longest, p->time[p->n - 1]);
        *most = p->n / 2 < *most ? p->n / 2 : *most;
        for (int i = 0; i < p->n; i++)
            w->largest = fmax(w->largest, fabs(p->amplitude[i]));
        for (int i = 1; i < p->n; i++)
            step = fmin(step, p->time[i] - p->time[i - 1]);
    }
    w->g.t = ARENA_TAKE(a, double, w->g.samples);
    w->g.a = ARENA_TAKE(a, double, w->g.samples);
    w->g.r = ARENA_TAKE(a, double, w->g.samples);
    for (int s = 0, k = 0; s < w->g.count; s++)
        for (int i = 0; i < w->g.series[s].n; i++, k++) {
            w->g.t[k] = w->g.series[s].time[i] / longest;
            w->g.a[k] = w->largest > 0.0 ? w->g.series[s].amplitude[i] / w->largest : 0.0;
        }
    w->low = real_log(1e-3);
    w->high = real_log(10.0 * longest / step);
    return longest;
}

/* The least number within a tenth of the smallest error: x of each number in all[number - 1]. */
static int choose(struct work *w, int most, double total, double all[][SLOPES_MOST])
{
    double x[SLOPES_MOST] = {0}, sum[SLOPES_MOST], best = HUGE_VAL;
    int n = 0;
    for (int idle = 0; n < most && idle < 2 && best > enough * enough * total;) {
        if (!grow(w, x, n, &sum[n])) break;
        memcpy(all[n], x, sizeof x);
        idle = sum[n] < 0.81 * best ? 0 : idle + 1;
        best = fmin(best, sum[n++]);
    }
    for (int k = 0; k < n; k++)
        if (sum[k] <= 1.21 * best || sum[k] <= enough * enough * total) return k + 1;
    return n;
}

struct slopes_fit slopes_fit(struct slopes_series *series, int count)
{
    struct arena *a = arena_open();
    struct work w = {.g = {.series = series, .count = count}};
    struct slopes_fit f = {.n = 1};
    double all[SLOPES_MOST][SLOPES_MOST] = {{0}};
    int most = SLOPES_MOST;
    double longest = lay_out(a, &w, &most), total = dot(w.g.a, w.g.a, w.g.samples);
    w.grid = (int)((w.high - w.low) * PER_DECADE / 2.302585) + 2;
    w.column = ARENA_TAKE(a, double, (size_t)w.grid *w.g.samples);
    for (int g = 0; g < w.grid; g++)
        exponentials(&w.g, grid_at(&w, g), w.column + (size_t)g * w.g.samples);
    for (int j = 0; j < SLOPES_MOST; j++) {
        w.g.e[j] = ARENA_TAKE(a, double, w.g.samples);
        w.g.q[j] = ARENA_TAKE(a, double, w.g.samples);
        w.v[j] = ARENA_TAKE(a, double, w.g.samples);
    }
    int n = total > 0.0 ? choose(&w, most, total, all) : 0;
    f.n = n > 0 ? n : 1;
    gsl_sort(all[f.n - 1], 1, (size_t)f.n);
    double left = fit_gains(&w.g, all[f.n - 1], f.n);
    f.error = total > 0.0 ? sqrt(left / total) : 0.0;
    for (int k = 0; k < f.n; k++) {
        f.decay[k] = real_exp(all[f.n - 1][k]) / longest;
        for (int s = 0; s < count; s++)
            series[s].gain[k] *= w.largest;
    }
    arena_close(a);
    return f;
}

/* Least squares of a block of modes: poles by Levenberg's and Marquardt's steps, gains and the smooth columns projected
   out of every step (variable projection, in Kaufman's approximation). Sums run in fixed lanes and order, so that all
   CPUs and compilers make the same bits. */
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/lanes.h"

enum { CHUNK = 64, ROWS = 2 * CHUNK, TRIES = 3 };

static const double rounded = 1e-10; /* of a column's squares: what the others leave of it is rounding */

struct group {     /* columns: gains, smooth ones, gains times steps of poles if full, what is left */
    int n, linear; /* columns; gains and smooth ones */
    double a[MODAL_COLUMNS * MODAL_COLUMNS], scale[MODAL_COLUMNS];
    bool swept[MODAL_COLUMNS];
};

/* a -> swept by its pivots from ... to - 1, the greatest over its scale first: of those rows and columns the inverse,
 * of the others what is left of them. */
int modal_block_sweep(double *a, int n, int from, int to, const double *scale, bool *swept)
{
    int count = 0;
    for (int k = from; k < to; k++)
        swept[k] = false;
    for (;;) {
        int best = -1;
        double most = rounded;
        for (int k = from; k < to; k++)
            if (!swept[k] && scale[k] > 0.0 && a[k * n + k] > most * scale[k]) {
                most = a[k * n + k] / scale[k];
                best = k;
            }
        if (best < 0) return count;
        double *row = a + best * n, pivot = 1.0 / row[best];
        swept[best] = true;
        count++;
        row[best] = 1.0;
        for (int j = 0; j < n; j++)
            row[j] *= pivot;
        for (int i = 0; i < n; i++) {
            double factor = a[i * n + best];
            if (i == best || factor == 0.0) continue;
            a[i * n + best] = 0.0;
            for (int j = 0; j < n; j++)
                a[i * n + j] -= factor * row[j];
        }
    }
}

/* ------------------------------------------------------------------ sums over bins */

static inline __attribute__((always_inline)) double lanes_sum(const double s[LANES])
{
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

/* a[i][j] += sum over ROWS of column i times column j, j <= i < n, by blocks of 4 x 2; x has three columns of zeros
 * behind its last. */
LANES_CLONES
void modal_block_products(const double *x, int n, double *a);
LANES_CLONES
void modal_block_products(const double *x, int n, double *a)
{
    for (int i = 0; i < n; i += 4)
        for (int j = 0; j < i + 4 && j < n; j += 2) {
            const double *p = x + i * ROWS, *q = x + j * ROWS;
            double s[8][LANES] = {{0}};
            for (int k = 0; k < ROWS; k += LANES)
#pragma omp simd
                for (int l = 0; l < LANES; l++) {
                    double u = q[k + l], v = q[ROWS + k + l];
                    s[0][l] += p[k + l] * u;
                    s[1][l] += p[k + l] * v;
                    s[2][l] += p[ROWS + k + l] * u;
                    s[3][l] += p[ROWS + k + l] * v;
                    s[4][l] += p[2 * ROWS + k + l] * u;
                    s[5][l] += p[2 * ROWS + k + l] * v;
                    s[6][l] += p[3 * ROWS + k + l] * u;
                    s[7][l] += p[3 * ROWS + k + l] * v;
                }
            for (int c = 0; c < 8; c++)
                if (i + c / 2 < n && j + c % 2 <= i + c / 2) a[(i + c / 2) * n + j + c % 2] += lanes_sum(s[c]);
        }
}

/* Columns of one mode on n bins: v (X + C) and v j (X - C), C of the mirror pole, for its gain; the same of dX/ds for
   gain times pole's step (p; NULL: not wanted). What the mode makes with its gain B goes off r. */
LANES_CLONES
void modal_block_columns(cplx gain, const double *const x[8], const double *weight, long n, double *g, double *p,
                         double *r);
LANES_CLONES
void modal_block_columns(cplx gain, const double *const x[8], const double *weight, long n, double *g, double *p,
                         double *r)
{
    const double *xr = x[0], *xi = x[1], *sr = x[2], *si = x[3], *cr = x[4], *ci = x[5], *mr = x[6], *mi = x[7],
                 br = gain.re, bi = gain.im;
#pragma omp simd
    for (long k = 0; k < n; k++) {
        double v = 0.5 * weight[k], a = v * (xr[k] + cr[k]), b = v * (xi[k] + ci[k]), c = v * (ci[k] - xi[k]),
               d = v * (xr[k] - cr[k]);
        g[k] = a;
        g[CHUNK + k] = b;
        g[ROWS + k] = c;
        g[ROWS + CHUNK + k] = d;
        r[k] -= br * a + bi * c;
        r[CHUNK + k] -= br * b + bi * d;
    }
    if (!p) return;
#pragma omp simd
    for (long k = 0; k < n; k++) {
        double v = 0.5 * weight[k];
        p[k] = v * (sr[k] + mr[k]);
        p[CHUNK + k] = v * (si[k] + mi[k]);
        p[ROWS + k] = v * (mi[k] - si[k]);
        p[ROWS + CHUNK + k] = v * (sr[k] - mr[k]);
    }
}

static void smooth_columns(const struct modal_bins *bins, const struct modal_block *b, const double *weight, long from,
                           long n, double *to)
{
    for (long k = 0; k < n; k++) {
        double u = ((double)(bins->first + from + k) * bins->width - b->centre) / b->half, power = weight[k];
        for (int q = 0; q < MODAL_SMOOTH; q += 2, power *= u) {
            double fr = power * bins->fr[from + k], fi = power * bins->fi[from + k];
            to[q * ROWS + k] = fr;
            to[q * ROWS + CHUNK + k] = fi;
            to[(q + 1) * ROWS + k] = -fi;
            to[(q + 1) * ROWS + CHUNK + k] = fr;
        }
    }
}

static void stretch_add(struct modal_block *b, int s, const cplx *gain, bool full, struct group *g)
{
    static const long size = ROWS * (long)sizeof(double);
    const struct modal_fit *f = b->fit;
    const struct modal_bins *bins = &f->bins[s];
    int groups = f->data->groups, mine = f->data->stretch[s].group;
    double room[8][CHUNK], weight[CHUNK], *x[8], *columns = ARENA_TAKE(b->a, double, (MODAL_COLUMNS + 3) * ROWS),
                                                 *r = columns + (g->n - 1) * ROWS;
    struct modal_line line[MODAL_BLOCK];
    for (int c = 0; c < 8; c++)
        x[c] = room[c];
    for (int i = 0; i < b->m; i++)
        line[i] = modal_fit_line(f, s, b->s[i], b->hum[i]);
    for (long from = b->from[s]; from < b->to[s]; from += CHUNK) {
        long n = from + CHUNK < b->to[s] ? CHUNK : b->to[s] - from, at = from - b->from[s], all = b->to[s] - b->from[s];
        if (n < CHUNK) memset(columns, 0, (size_t)(g->n * size));
        for (long k = 0; k < n; k++) {
            weight[k] = sqrt(2.0 / bins->variance[from + k]);
            r[k] = weight[k] * b->r[s][at + k];
            r[CHUNK + k] = weight[k] * b->r[s][all + at + k];
        }
        for (int i = 0; i < b->m; i++) {
            modal_fit_basis(bins, &line[i], from, from + n, x);
            modal_block_columns(gain[i * groups + mine], (const double *const *)x, weight, n, columns + 2 * i * ROWS,
                                full ? columns + (g->linear + 2 * i) * ROWS : NULL, r);
        }
        smooth_columns(bins, b, weight, from, n, columns + 2 * b->m * ROWS);
        modal_block_products(columns, g->n, g->a);
    }
}

static bool counts(const struct modal_block *b, int s)
{
    bool lead = b->fit->data->stretch[s].strike < 0; /* only hums are heard in it */
    for (int i = 0; lead && !b->stretches && i < b->m; i++)
        if (b->hum[i]) return true;
    return b->stretches ? b->stretches[s] : b->fit->data->stretch[s].fitted && !lead;
}

/* The group's sums, its linear columns swept out; false: none of its stretches counts. */
static bool group_make(struct modal_block *b, int group, const cplx *gain, bool full, struct group *g)
{
    bool any = false;
    g->linear = 2 * b->m + MODAL_SMOOTH;
    g->n = g->linear + (full ? 2 * b->m : 0) + 1;
    memset(g->a, 0, (size_t)(g->n * g->n) * sizeof *g->a);
    for (int s = 0; s < b->fit->data->stretches; s++)
        if (b->fit->data->stretch[s].group == group && counts(b, s) && b->to[s] > b->from[s]) {
            stretch_add(b, s, gain, full, g);
            any = true;
        }
    for (int i = 0; i < g->n; i++) {
        g->scale[i] = g->a[i * g->n + i];
        for (int j = 0; j < i; j++)
            g->a[j * g->n + i] = g->a[i * g->n + j];
    }
    return any;
}

/* By how much gain times step (its two parts) of component i moves with omega and with log d: to[part][omega, log d].
 */
static void steps_of(const struct modal_block *b, int i, int group, double to[2][2])
{
    cplx gain = b->gain[i * b->fit->data->groups + group];
    double decay = b->hum[i] ? 0.0 : -b->s[i].re;
    to[0][0] = -gain.im;
    to[0][1] = -decay * gain.re;
    to[1][0] = gain.re;
    to[1][1] = -decay * gain.im;
}

/* The poles' normal equations of a group, its gains projected out, go to the block's. */
static void add_normal(struct modal_block *b, int group, const struct group *g)
{
    int poles = 2 * b->m, n = g->n;
    for (int i = 0; i < b->m; i++) {
        double u[2][2], v[2][2];
        steps_of(b, i, group, u);
        const double *row[2] = {g->a + (g->linear + 2 * i) * n + g->linear,
                                g->a + (g->linear + 2 * i + 1) * n + g->linear};
        for (int k = 0; k < b->m; k++) {
            steps_of(b, k, group, v);
            for (int p = 0; p < 2; p++)
                for (int q = 0; q < 2; q++)
                    b->normal[(2 * i + p) * poles + 2 * k + q] +=
                        u[0][p] * (row[0][2 * k] * v[0][q] + row[0][2 * k + 1] * v[1][q]) +
                        u[1][p] * (row[1][2 * k] * v[0][q] + row[1][2 * k + 1] * v[1][q]);
        }
        for (int p = 0; p < 2; p++) {
            b->right[2 * i + p] += u[0][p] * row[0][poles] + u[1][p] * row[1][poles];
            b->scale[2 * i + p] +=
                u[0][p] * u[0][p] * g->scale[g->linear + 2 * i] + u[1][p] * u[1][p] * g->scale[g->linear + 2 * i + 1];
        }
    }
}

/* All groups: gains += what their columns take of what is left, chi, and with full the poles' normal equations. */
static void pass(struct modal_block *b, bool full, struct group *keep)
{
    const struct modal_data *d = b->fit->data;
    struct arena *a = b->a, *inner = arena_open();
    struct group *g = keep ? keep : ARENA_TAKE(inner, struct group, 1);
    b->a = inner;
    b->chi = 0.0;
    if (full) {
        memset(b->normal, 0, sizeof b->normal);
        memset(b->right, 0, sizeof b->right);
        memset(b->scale, 0, sizeof b->scale);
    }
    for (int k = 0; k < d->groups; k++, g += keep ? 1 : 0) {
        if (!group_make(b, k, b->gain, full, g)) {
            g->n = 0;
            continue;
        }
        int n = g->n, last = n - 1;
        modal_block_sweep(g->a, n, 0, g->linear, g->scale, g->swept);
        b->chi += g->a[last * n + last];
        for (int i = 0; i < 2 * b->m; i++)
            if (g->swept[i])
                (i % 2 ? &b->gain[i / 2 * d->groups + k].im : &b->gain[i / 2 * d->groups + k].re)[0] +=
                    g->a[i * n + last];
        if (full) add_normal(b, k, g);
    }
    arena_close(inner);
    b->a = a;
}

/* ------------------------------------------------------------------ blocks */

static double reach(const struct modal_fit *f, cplx s)
{
    return -MODAL_REACH * s.re + 4.0 * MODAL_REACH * REAL_PI / f->longest;
}

void modal_block_open(struct modal_block *b, const struct modal_fit *f, int m, const int *of, const cplx *extra,
                      int extras, const bool *stretches, struct arena *a)
{
    const struct modal_data *d = f->data;
    double low = HUGE_VAL, high = -HUGE_VAL;
    memset(b, 0, sizeof *b);
    b->fit = f;
    b->a = a;
    b->stretches = stretches;
    b->fastest = f->fastest;
    b->m = m + extras;
    b->gain = ARENA_TAKE(a, cplx, MODAL_BLOCK * d->groups);
    for (int i = 0; i < m + extras; i++) {
        b->of[i] = i < m ? of[i] : -1;
        b->s[i] = i < m ? f->s[of[i]] : extra[i - m];
        b->hum[i] = i < m && f->hum[of[i]];
        if (i < m) modal_fit_totals(f, of[i], b->gain + i * d->groups);
        low = fmin(low, b->s[i].im - reach(f, b->s[i]));
        high = fmax(high, b->s[i].im + reach(f, b->s[i]));
    }
    b->centre = 0.5 * (low + high);
    b->half = 0.5 * (high - low);
    b->from = ARENA_TAKE(a, long, d->stretches);
    b->to = ARENA_TAKE(a, long, d->stretches);
    b->r = arena_take(a, (size_t)d->stretches, sizeof *b->r);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_bins *bins = &f->bins[s];
        double from = ceil(low / bins->width) - (double)bins->first,
               to = floor(high / bins->width) - (double)bins->first + 1.0;
        b->from[s] = from > 0.0 ? from < (double)bins->n ? (long)from : bins->n : 0;
        b->to[s] = to > 0.0 ? to < (double)bins->n ? (long)to : bins->n : 0;
        long n = b->to[s] - b->from[s];
        if (!counts(b, s) || n <= 0) {
            b->to[s] = b->from[s];
            continue;
        }
        b->r[s] = ARENA_TAKE(a, double, 2 * n);
        memcpy(b->r[s], bins->rr + b->from[s], (size_t)n * sizeof(double));
        memcpy(b->r[s] + n, bins->ri + b->from[s], (size_t)n * sizeof(double));
        double room[8][CHUNK], *x[8];
        for (int c = 0; c < 8; c++)
            x[c] = room[c];
        for (int i = 0; i < m; i++) {
            struct modal_line line = modal_fit_line(f, s, b->s[i], b->hum[i]);
            for (long at = 0; at < n; at += CHUNK) {
                long part = at + CHUNK < n ? CHUNK : n - at;
                cplx g = cplx_scale(0.5, b->gain[i * d->groups + d->stretch[s].group]);
                modal_fit_basis(bins, &line, b->from[s] + at, b->from[s] + at + part, x);
                for (long k = 0; k < part; k++) {
                    b->r[s][at + k] += g.re * (x[0][k] + x[4][k]) - g.im * (x[1][k] - x[5][k]);
                    b->r[s][n + at + k] += g.re * (x[1][k] + x[5][k]) + g.im * (x[0][k] - x[4][k]);
                }
            }
        }
    }
    long rows = 0, groups = 0;
    for (int g = 0; g < d->groups; g++) {
        long bins = 0;
        for (int s = 0; s < d->stretches; s++)
            bins += d->stretch[s].group == g ? b->to[s] - b->from[s] : 0;
        rows += bins > 2 * b->m + MODAL_SMOOTH ? 2 * bins : 0;
        groups += bins > 2 * b->m + MODAL_SMOOTH;
    }
    b->dof = rows - 2 * b->m - groups * (2 * b->m + MODAL_SMOOTH);
    b->dof = b->dof > 1 ? b->dof : 1;
}

void modal_block_gains(struct modal_block *b) { pass(b, false, NULL); }

void modal_block_drop(struct modal_block *b, int i)
{
    int groups = b->fit->data->groups;
    for (b->m--; i < b->m; i++) {
        b->of[i] = b->of[i + 1];
        b->s[i] = b->s[i + 1];
        b->hum[i] = b->hum[i + 1];
        memcpy(b->gain + i * groups, b->gain + (i + 1) * groups, (size_t)groups * sizeof *b->gain);
    }
    b->dof += 2 + 2 * groups;
}

void modal_block_worth(struct modal_block *b, double *worth)
{
    int groups = b->fit->data->groups;
    struct arena *inner = arena_open();
    struct group *g = ARENA_TAKE(inner, struct group, groups);
    pass(b, false, g);
    for (int i = 0; i < b->m; i++)
        worth[i] = 0.0;
    for (int k = 0; k < groups; k++)
        for (int i = 0; i < b->m && g[k].n; i++) {
            const double *a = g[k].a + 2 * i * (g[k].n + 1), p = a[0], q = 0.5 * (a[1] + a[g[k].n]), r = a[g[k].n + 1],
                         det = p * r - q * q;
            cplx at = b->gain[i * groups + k];
            if (g[k].swept[2 * i] && g[k].swept[2 * i + 1] && det > 0.0)
                worth[i] += (at.re * at.re * r - 2.0 * at.re * at.im * q + at.im * at.im * p) / det;
        }
    arena_close(inner);
}

double modal_block_noise(const struct modal_block *b) { return fmax(b->chi / (double)b->dof, 1e-300); }

static double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/* Where a step of the poles leads. */
static void step_to(const struct modal_block *b, const cplx *s, const double *step, cplx *to)
{
    const struct modal_fit *f = b->fit;
    for (int i = 0; i < b->m; i++) {
        double wide = -3.0 * s[i].re + 10.0 / f->longest;
        to[i].im = clamp(s[i].im + clamp(step[2 * i], -wide, wide), f->low, f->high);
        to[i].re = b->hum[i] ? s[i].re
                             : -clamp(-s[i].re * real_exp(clamp(step[2 * i + 1], -0.7, 0.7)), f->slowest, b->fastest);
    }
}

/* The step of the damped normal equations, and what it would take off chi. */
static double solve(const struct modal_block *b, double damping, double *step)
{
    int p = 2 * b->m, n = p + 1;
    double a[(2 * MODAL_BLOCK + 1) * (2 * MODAL_BLOCK + 1)], fall = 0.0;
    bool swept[2 * MODAL_BLOCK];
    for (int i = 0; i < p; i++) {
        for (int j = 0; j < p; j++)
            a[i * n + j] = b->normal[i * p + j];
        a[i * n + i] *= 1.0 + damping;
        a[i * n + p] = a[p * n + i] = b->right[i];
    }
    a[p * n + p] = 0.0;
    modal_block_sweep(a, n, 0, p, b->scale, swept);
    for (int i = 0; i < p; i++) {
        step[i] = swept[i] ? a[i * n + p] : 0.0;
        fall += step[i] * b->right[i];
    }
    return fall;
}

bool modal_block_polish(struct modal_block *b, int steps)
{
    int groups = b->fit->data->groups;
    double damping = 1e-3, step[2 * MODAL_BLOCK];
    struct arena *inner = arena_open();
    struct modal_block *was = ARENA_TAKE(inner, struct modal_block, 1);
    cplx *gain = ARENA_TAKE(inner, cplx, b->m * groups);
    bool converged = false, better = true;
    pass(b, steps > 0, NULL);
    for (int k = 0; k < steps && better && !converged; k++) {
        double enough = b->fit->tolerance * modal_block_noise(b);
        converged = solve(b, 0.0, step) < enough;
        *was = *b;
        memcpy(gain, b->gain, (size_t)(b->m * groups) * sizeof *gain);
        better = false;
        for (int t = 0; t < TRIES && !better && !converged; t++) {
            solve(was, damping, step);
            step_to(b, was->s, step, b->s);
            pass(b, true, NULL);
            better = b->chi <= was->chi;
            if (!better) {
                *b = *was;
                memcpy(b->gain, gain, (size_t)(b->m * groups) * sizeof *gain);
                damping = fmax(8.0 * damping, 1e-4);
            }
        }
        converged = converged || (better && was->chi - b->chi < enough);
        damping = damping > 1e-9 ? damping / 10.0 : 0.0;
    }
    arena_close(inner);
    return converged;
}

void modal_block_errors(struct modal_block *b, int i, double se[2], double *gain_se)
{
    int p = 2 * b->m, groups = b->fit->data->groups;
    struct arena *inner = arena_open();
    struct group *g = ARENA_TAKE(inner, struct group, groups);
    bool swept[2 * MODAL_BLOCK];
    pass(b, true, g);
    modal_block_sweep(b->normal, p, 0, p, b->scale, swept);
    for (int q = 0; q < 2; q++)
        se[q] = swept[2 * i + q] ? sqrt(fmax(b->normal[(2 * i + q) * (p + 1)], 0.0)) : HUGE_VAL;
    for (int k = 0; k < groups; k++) {
        cplx at = b->gain[i * groups + k];
        double size = fmax(cplx_abs(at), 1e-300), u[2] = {at.re / size, at.im / size}, sum = 0.0,
               *row = ARENA_TAKE(inner, double, p);
        int n = g[k].n;
        gain_se[k] = HUGE_VAL;
        if (n == 0 || !g[k].swept[2 * i] || !g[k].swept[2 * i + 1]) continue;
        for (int c = 0; c < 2; c++)
            for (int e = 0; e < 2; e++)
                sum += u[c] * u[e] * g[k].a[(2 * i + c) * n + 2 * i + e];
        for (int j = 0; j < b->m; j++) {
            const double *re = g[k].a + 2 * i * n + g[k].linear + 2 * j, *im = re + n;
            double by[2][2];
            steps_of(b, j, k, by);
            for (int q = 0; q < 2; q++)
                row[2 * j + q] = (u[0] * re[0] + u[1] * im[0]) * by[0][q] + (u[0] * re[1] + u[1] * im[1]) * by[1][q];
        }
        for (int j = 0; j < p; j++)
            for (int l = 0; l < p; l++)
                if (swept[j] && swept[l]) sum += row[j] * b->normal[j * p + l] * row[l];
        gain_se[k] = sqrt(fmax(sum, 0.0));
    }
    arena_close(inner);
}

/* Least squares of a block of modes: poles by Levenberg's and Marquardt's steps, gains and the smooth columns projected
   out of every step (variable projection, in Kaufman's approximation). Sums run in fixed lanes and order, so that all
   CPUs and compilers make the same bits. */
#include <string.h>

#include "analysis/modal_fit.h"
#include "num/lanes.h"

enum { CHUNK = MODAL_CHUNK, ROWS = 2 * CHUNK, TRIES = 3 };

static const double known = 20.0; /* degrees of freedom that the noise of the wider band counts as in a block's own */
static const double rounded = 1e-10; /* of a column's squares: what the others leave of it is rounding */

struct sums {      /* columns: gains, smooth ones, gains times steps of poles if full, what is left */
    int n, linear; /* columns; gains and smooth ones */
    double a[MODAL_COLUMNS * MODAL_COLUMNS], scale[MODAL_COLUMNS];
};

/* a -> swept by its pivots from ... to - 1, the greatest over its scale first: of those rows and columns the inverse,
 * of the others what is left of them. What is left of a pivot may be rounding: then its row and column are 0. */
void modal_block_sweep(double *a, int n, int from, int to, const double *scale)
{
    bool swept[MODAL_COLUMNS] = {false};
    for (;;) {
        int best = -1;
        double most = rounded;
        for (int k = from; k < to; k++)
            if (!swept[k] && scale[k] > 0.0 && a[k * n + k] > most * scale[k]) {
                most = a[k * n + k] / scale[k];
                best = k;
            }
        if (best < 0) break;
        double *row = a + best * n, pivot = 1.0 / row[best];
        swept[best] = true;
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
    for (int k = from; k < to; k++)
        for (int j = 0; j < n && !swept[k]; j++)
            a[k * n + j] = a[j * n + k] = 0.0;
}

/* ------------------------------------------------------------------ sums over bins */

static inline __attribute__((always_inline)) double lanes_sum(const double s[LANES])
{
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

/* sum[i][j][lane] += column i times column j over the lane's rows, j <= i < n, by blocks of 4 x 2. A column has a half
   of real and a half of imaginary parts, of each of which the first `rows` count, a multiple of LANES. x has three
   columns of zeros behind its last, sum is [n + 3][n + 3][LANES]. */
LANES_CLONES
void modal_block_products(const double *x, int n, long rows, double *sum);
LANES_CLONES
void modal_block_products(const double *x, int n, long rows, double *sum)
{
    for (int i = 0; i < n; i += 4)
        for (int j = 0; j < i + 4 && j < n; j += 2) {
            const double *p = x + i * ROWS, *q = x + j * ROWS;
            double s[8][LANES] = {{0}};
            for (long k = 0; k < CHUNK + rows; k = k + LANES == rows ? CHUNK : k + LANES)
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
            for (int c = 0; c < 8; c++) {
                double *to = sum + ((i + c / 2) * (n + 3) + j + c % 2) * LANES;
#pragma omp simd
                for (int l = 0; l < LANES; l++)
                    to[l] += s[c][l];
            }
        }
}

/* Columns of one mode on n bins: v (X + C) and v j (X - C), C of the mirror pole, for its gain; the same of dX/ds for
   gain times pole's step (p; NULL: not wanted). What the mode makes with its gain B goes off r. */
LANES_CLONES
void modal_block_columns(cplx gain, double (*x)[CHUNK], const double *weight, long n, double *g, double *p, double *r);
LANES_CLONES
void modal_block_columns(cplx gain, double (*x)[CHUNK], const double *weight, long n, double *g, double *p, double *r)
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

/* The stretch's sums over its bins; false: it has none. */
static bool sums_make(struct modal_block *b, int s, bool full, struct sums *g)
{
    static const long size = ROWS * (long)sizeof(double);
    const struct modal_window *w = &b->window[s];
    if (w->to <= w->from) return false;
    g->linear = 2 * b->m + MODAL_SMOOTH;
    g->n = g->linear + (full ? 2 * b->m : 0) + 1;
    const struct modal_fit *f = b->fit;
    const struct modal_bins *bins = &f->bins[s];
    int stretches = f->data->stretches;
    double x[8][CHUNK], weight[CHUNK], *columns = ARENA_TAKE(b->a, double, (MODAL_COLUMNS + 3) * ROWS),
                                       *r = columns + (g->n - 1) * ROWS,
                                       *sum = ARENA_TAKE(b->a, double, (g->n + 3) * (g->n + 3) * LANES);
    struct modal_line line[MODAL_BLOCK];
    for (int i = 0; i < b->m; i++)
        line[i] = modal_fit_line(f, s, b->part[i * stretches + s].pole);
    for (long from = w->from; from < w->to; from += CHUNK) {
        long n = from + CHUNK < w->to ? CHUNK : w->to - from;
        if (n < CHUNK) memset(columns, 0, (size_t)(g->n * size));
        for (long k = 0; k < n; k++) {
            weight[k] = sqrt(2.0 / bins->variance[from + k]);
            r[k] = weight[k] * w->rest[from - w->from + k].re;
            r[CHUNK + k] = weight[k] * w->rest[from - w->from + k].im;
        }
        for (int i = 0; i < b->m; i++) {
            modal_fit_basis(bins, &line[i], from, n, x);
            modal_block_columns(b->part[i * stretches + s].gain, x, weight, n, columns + 2 * i * ROWS,
                                full ? columns + (g->linear + 2 * i) * ROWS : NULL, r);
        }
        smooth_columns(bins, b, weight, from, n, columns + 2 * b->m * ROWS);
        modal_block_products(columns, g->n, (n + LANES - 1) / LANES * LANES, sum);
    }
    for (int i = 0; i < g->n; i++) {
        for (int j = 0; j <= i; j++)
            g->a[j * g->n + i] = g->a[i * g->n + j] = lanes_sum(sum + (i * (g->n + 3) + j) * LANES);
        g->scale[i] = g->a[i * g->n + i];
    }
    return true;
}

/* Columns, then rows, of gain times pole's step -> of omega and log d. */
static void turn_to_poles(const struct modal_block *b, int stretch, struct sums *g)
{
    for (int i = 0; i < b->m; i++) {
        const struct modal_part *part = &b->part[i * b->fit->data->stretches + stretch];
        double re = part->gain.re, im = part->gain.im, decay = -part->pole.re;
        int n = g->n, c = g->linear + 2 * i;
        for (int rows = 0; rows < 2; rows++)
            for (int j = 0; j < n; j++) {
                double *p = g->a + (rows ? c * n + j : j * n + c), *q = p + (rows ? n : 1), u = *p, v = *q;
                *p = re * v - im * u;
                *q = -decay * (re * u + im * v);
            }
        double u = g->scale[c], v = g->scale[c + 1];
        g->scale[c] = im * im * u + re * re * v;
        g->scale[c + 1] = decay * decay * (re * re * u + im * im * v);
    }
}

enum { POLES = 2 * MODAL_BLOCK };

/* How far a strike's own poles are from the shared ones (omega, log d), and what a square of that weighs in chi. */
static void deviations_of(const struct modal_block *b, int stretch, double *deviation, double *weight)
{
    static const double least = 1e-11; /* no spread is less: 0 is one that nothing shows */
    for (int i = 0; i < b->m; i++) {
        cplx own = b->part[i * b->fit->data->stretches + stretch].pole;
        double sigma[2] = {fmax(b->spread[i][0], least) * b->s[i].im, fmax(b->spread[i][1], least)};
        deviation[2 * i] = own.im - b->s[i].im;
        deviation[2 * i + 1] = real_log(own.re / b->s[i].re);
        for (int q = 0; q < 2; q++)
            weight[2 * i + q] = 1.0 / (sigma[q] * sigma[q]);
    }
}

/* to[p][p + 1]: (N + W)^-1 of a strike and, last, times its gradient, N damped, the shared poles moved by step (NULL:
   not); returns what the step would take off. */
static double own_inverse(const struct modal_block *b, int stretch, double damping, const double *step,
                          double *deviation, double *weight, double *to)
{
    const struct modal_window *g = &b->window[stretch];
    int p = 2 * b->m, n = p + 1;
    double scale[POLES] = {0}, fall = 0.0;
    deviations_of(b, stretch, deviation, weight);
    for (int i = 0; i < p; i++) {
        deviation[i] -= step ? step[i] : 0.0;
        memcpy(to + i * n, g->a + i * p, (size_t)p * sizeof *to);
        to[i * n + i] = (1.0 + damping) * to[i * n + i] + weight[i];
        scale[i] = (1.0 + damping) * g->scale[i] + weight[i];
        to[i * n + p] = to[p * n + i] = g->right[i] - weight[i] * deviation[i];
    }
    to[p * n + p] = 0.0;
    modal_block_sweep(to, n, 0, p, scale);
    for (int i = 0; i < p; i++)
        fall += to[i * n + p] * (g->right[i] - weight[i] * deviation[i]);
    return fall;
}

/* The step of all poles, damped: of the shared ones, step[p], and own[stretches][p]; returns what it would take off
   chi. The shared ones' normal equations are sum N - N (N + W)^-1 N = sum W (N + W)^-1 N, where W holds the damping,
   too, their right side sum r - N (N + W)^-1 (r - W apart). */
static double solve(struct modal_block *b, double damping, double *step, double *own)
{
    int p = 2 * b->m, n = p + 1, stretches = b->fit->data->stretches;
    struct arena *arena = arena_open();
    double *inverse = ARENA_TAKE(arena, double, n *n), *a = ARENA_TAKE(arena, double, n *n), deviation[POLES],
           weight[POLES], scale[POLES] = {0}, fall = 0.0;
    for (int g = 0; g < stretches; g++) {
        const struct modal_window *e = &b->window[g];
        if (!e->used) continue;
        fall += own_inverse(b, g, damping, NULL, deviation, weight, inverse);
        for (int i = 0; i < p; i++) {
            double damped = weight[i] + damping * e->a[i * p + i];
            for (int j = 0; j < p; j++) {
                double sum = 0.0;
                for (int k = 0; k < p; k++)
                    sum += inverse[i * n + k] * e->a[k * p + j];
                a[i * n + j] += damped * sum;
            }
            a[i * n + p] += e->right[i];
            for (int k = 0; k < p; k++)
                a[i * n + p] -= e->a[i * p + k] * inverse[k * n + p];
            scale[i] += e->scale[i];
        }
    }
    for (int i = 0; i < p; i++) {
        memcpy(b->normal + i * p, a + i * n, (size_t)p * sizeof *a);
        step[i] = a[i * n + p];
        a[p * n + i] = a[i * n + p];
        a[i * n + i] *= 1.0 + damping;
    }
    a[p * n + p] = 0.0;
    modal_block_sweep(a, n, 0, p, scale);
    for (int i = 0; i < p; i++) {
        double right = step[i];
        step[i] = a[i * n + p];
        fall += step[i] * right;
    }
    for (int g = 0; g < stretches; g++) {
        if (!b->window[g].used) continue;
        own_inverse(b, g, damping, step, deviation, weight, inverse);
        for (int i = 0; i < p; i++)
            own[g * p + i] = inverse[i * n + p];
    }
    arena_close(arena);
    return fall;
}

/* All stretches: gains += what their columns take of what is left; of those that are fitted noise, chi, and with full
   the poles' normal equations. */
static void pass(struct modal_block *b, bool full, struct sums *to)
{
    const struct modal_data *d = b->fit->data;
    struct arena *a = b->a, *inner = arena_open();
    struct sums *g = to ? to : ARENA_TAKE(inner, struct sums, 1);
    double deviation[POLES], weight[POLES], sum = 0.0;
    b->a = inner;
    for (int k = 0; k < d->stretches; k++, g += to ? 1 : 0) {
        struct modal_window *w = &b->window[k];
        bool fitted = d->stretch[k].fitted;
        if (full) w->used = false;
        if (!sums_make(b, k, full, g)) {
            g->n = 0;
            continue;
        }
        int n = g->n, last = n - 1, poles = 2 * b->m;
        modal_block_sweep(g->a, n, 0, g->linear, g->scale);
        w->noise = (g->a[last * n + last] + known) / w->degrees;
        sum += fitted ? w->degrees / w->alike * real_log(w->noise) : 0.0;
        for (int i = 0; i < b->m; i++) {
            cplx *gain = &b->part[i * d->stretches + k].gain;
            *gain = cplx_add(*gain, (cplx){g->a[2 * i * n + last], g->a[(2 * i + 1) * n + last]});
        }
        if (!full) continue;
        turn_to_poles(b, k, g);
        w->used = fitted;
        for (int i = 0; i < poles; i++) {
            const double *row = g->a + (g->linear + i) * n, part = 1.0 / (w->noise * w->alike);
            for (int j = 0; j < poles; j++)
                w->a[i * poles + j] = part * row[g->linear + j];
            w->right[i] = part * row[last];
            w->scale[i] = part * g->scale[g->linear + i];
        }
    }
    for (int k = 0; k < d->stretches; k++) {
        deviations_of(b, k, deviation, weight);
        for (int i = 0; i < 2 * b->m; i++)
            sum += deviation[i] * deviation[i] * weight[i];
    }
    b->chi = sum;
    arena_close(inner);
    b->a = a;
}

/* ------------------------------------------------------------------ blocks */

static double reach(const struct modal_fit *f, cplx s)
{
    return -MODAL_REACH * s.re + 4.0 * MODAL_REACH * REAL_PI / f->longest;
}

/* (1 + r)/(1 - r), r the correlation of neighbours in x, what is left, as of an autoregressive series. Of white noise
   |r|^2 n is exponential: what is less than chance makes it in one of 50 is taken for 0. */
static double alike(const struct modal_bins *bins, long from, long n, const cplx *left)
{
    static const double chance = 4.0, most = 0.9;
    struct arena *a = arena_open();
    double power = 0.0;
    cplx *x = ARENA_TAKE(a, cplx, n), product = {0};
    modal_fit_take_smooth_off(bins, from, n, left, x);
    for (long k = 0; k < n; k++) {
        double weight = 1.0 / bins->variance[from + k];
        power += weight * cplx_square(x[k]);
        if (k)
            product = cplx_add(
                product, cplx_scale(sqrt(weight / bins->variance[from + k - 1]), cplx_mul(x[k], cplx_conj(x[k - 1]))));
    }
    arena_close(a);
    double square = power > 0.0 ? cplx_square(product) / (power * power) - chance / (double)n : 0.0,
           r = fmin(sqrt(fmax(square, 0.0)), most);
    return (1.0 + r) / (1.0 - r);
}

double modal_block_alike(const struct modal_block *b)
{
    const struct modal_data *d = b->fit->data;
    double sum = 0.0, bins = 0.0;
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_window *w = &b->window[s];
        long n = w->to - w->from;
        if (n < 2) continue;
        struct arena *a = arena_open();
        cplx *left = ARENA_TAKE(a, cplx, n);
        memcpy(left, w->rest, (size_t)n * sizeof *left);
        for (int i = 0; i < b->m; i++) {
            const struct modal_part *mine = &b->part[i * d->stretches + s];
            struct modal_line line = modal_fit_line(b->fit, s, mine->pole);
            modal_fit_add_line(&b->fit->bins[s], &line, cplx_scale(-1.0, mine->gain), w->from, n, left);
        }
        sum += (double)n * alike(&b->fit->bins[s], w->from, n, left);
        bins += (double)n;
        arena_close(a);
    }
    return bins > 0.0 ? sum / bins : 1.0;
}

struct modal_block *modal_block_room(const struct modal_fit *f, struct arena *a)
{
    struct modal_block *b = ARENA_TAKE(a, struct modal_block, 1);
    b->part = ARENA_TAKE(a, struct modal_part, MODAL_BLOCK * f->data->stretches);
    b->window = ARENA_TAKE(a, struct modal_window, f->data->stretches);
    return b;
}

struct modal_block *modal_block_open(const struct modal_fit *f, int m, const int *of, const cplx *extra, int extras,
                                     struct arena *a)
{
    const struct modal_data *d = f->data;
    double low = HUGE_VAL, high = -HUGE_VAL;
    struct modal_block *b = modal_block_room(f, a);
    b->fit = f;
    b->a = a;
    b->fastest = f->fastest;
    b->m = m + extras;
    for (int i = 0; i < m + extras; i++) {
        b->of[i] = i < m ? of[i] : -1;
        b->s[i] = i < m ? f->c[of[i]].s : extra[i - m];
        for (int q = 0; q < 2; q++)
            b->spread[i][q] = f->strikes < 2 ? 0.0 : i < m ? f->c[of[i]].spread[q] : f->typical[q];
        for (int g = 0; g < d->stretches; g++)
            b->part[i * d->stretches + g].pole = b->s[i];
        if (i < m) modal_fit_totals(f, of[i], b->part + i * d->stretches);
        low = fmin(low, b->s[i].im - reach(f, b->s[i]));
        high = fmax(high, b->s[i].im + reach(f, b->s[i]));
    }
    b->centre = 0.5 * (low + high);
    b->half = 0.5 * (high - low);
    for (int s = 0; s < d->stretches; s++) {
        const struct modal_bins *bins = &f->bins[s];
        struct modal_window *w = &b->window[s];
        double from = ceil(low / bins->width) - (double)bins->first,
               to = floor(high / bins->width) - (double)bins->first + 1.0;
        w->from = from > 0.0 ? from < (double)bins->n ? (long)from : bins->n : 0;
        w->to = to > 0.0 ? to < (double)bins->n ? (long)to : bins->n : 0;
        long n = w->to - w->from;
        w->alike = 1.0;
        if (d->stretch[s].strike < 0 || d->stretch[s].idle || n <= 0) {
            w->to = w->from;
            continue;
        }
        w->degrees = known - 2.0 * b->m - MODAL_SMOOTH - 2.0 * b->m / d->stretches;
        w->degrees = fmax(w->degrees + 2.0 * (double)n, known);
        if (f->found && !extras && n > 1) w->alike = alike(bins, w->from, n, bins->rest + w->from);
        w->rest = ARENA_TAKE(a, cplx, n);
        memcpy(w->rest, bins->rest + w->from, (size_t)n * sizeof(cplx));
        for (int i = 0; i < m; i++) {
            const struct modal_part *mine = &b->part[i * d->stretches + s];
            struct modal_line line = modal_fit_line(f, s, mine->pole);
            modal_fit_add_line(bins, &line, mine->gain, w->from, n, w->rest);
        }
    }
    return b;
}

void modal_block_drop(struct modal_block *b, int i)
{
    int stretches = b->fit->data->stretches;
    for (b->m--; i < b->m; i++) {
        b->of[i] = b->of[i + 1];
        b->s[i] = b->s[i + 1];
        memcpy(b->spread[i], b->spread[i + 1], sizeof b->spread[i]);
        memcpy(b->part + i * stretches, b->part + (i + 1) * stretches, (size_t)stretches * sizeof *b->part);
    }
}

void modal_block_worth(struct modal_block *b, double *worth)
{
    int stretches = b->fit->data->stretches;
    struct arena *inner = arena_open();
    struct sums *g = ARENA_TAKE(inner, struct sums, stretches);
    pass(b, false, g);
    for (int i = 0; i < b->m; i++)
        worth[i] = 0.0;
    for (int k = 0; k < stretches; k++)
        for (int i = 0; i < b->m && g[k].n && b->fit->data->stretch[k].fitted; i++) {
            const double *a = g[k].a + 2 * i * (g[k].n + 1), p = a[0], q = 0.5 * (a[1] + a[g[k].n]), r = a[g[k].n + 1],
                         det = p * r - q * q;
            cplx at = b->part[i * stretches + k].gain;
            if (det > 0.0)
                worth[i] += (at.re * at.re * r - 2.0 * at.re * at.im * q + at.im * at.im * p) /
                            (det * b->window[k].noise * b->window[k].alike);
        }
    arena_close(inner);
}

static double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/* Where a step leads a pole. */
static cplx stepped(const struct modal_block *b, cplx s, const double *step)
{
    const struct modal_fit *f = b->fit;
    double wide = -3.0 * s.re + 10.0 / f->longest;
    return (cplx){-clamp(-s.re * real_exp(clamp(step[1], -0.7, 0.7)), f->slowest, b->fastest),
                  clamp(s.im + clamp(step[0], -wide, wide), f->low, f->high)};
}

void modal_block_copy(struct modal_block *to, const struct modal_block *from)
{
    size_t stretches = (size_t)from->fit->data->stretches;
    struct modal_part *part = to->part;
    struct modal_window *window = to->window;
    *to = *from;
    to->part = memcpy(part, from->part, MODAL_BLOCK * stretches * sizeof *part);
    to->window = memcpy(window, from->window, stretches * sizeof *window);
}

bool modal_block_polish(struct modal_block *b, int steps)
{
    int stretches = b->fit->data->stretches;
    double damping = 1e-3, step[POLES];
    struct arena *inner = arena_open();
    struct modal_block *was = modal_block_room(b->fit, inner);
    double *own = ARENA_TAKE(inner, double, stretches * 2 * b->m);
    bool converged = false, better = true;
    pass(b, steps > 0, NULL);
    for (int k = 0; k < steps && better && !converged; k++) {
        double enough = b->fit->tolerance;
        converged = solve(b, 0.0, step, own) < enough;
        modal_block_copy(was, b);
        better = false;
        for (int t = 0; t < TRIES && !better && !converged; t++) {
            solve(b, damping, step, own);
            for (int i = 0; i < b->m; i++) {
                b->s[i] = stepped(b, b->s[i], step + 2 * i);
                for (int g = 0; g < stretches; g++) {
                    struct modal_part *p = &b->part[i * stretches + g];
                    p->pole = b->window[g].used ? stepped(b, p->pole, own + (g * b->m + i) * 2) : b->s[i];
                }
            }
            pass(b, true, NULL);
            better = b->chi <= was->chi;
            if (!better) {
                modal_block_copy(b, was);
                damping = fmax(8.0 * damping, 1e-4);
            }
        }
        converged = converged || (better && was->chi - b->chi < enough);
        damping = damping > 1e-9 ? damping / 10.0 : 0.0;
    }
    arena_close(inner);
    return converged;
}

int modal_block_deviations(struct modal_block *b, int i, int q, double *by, double *variance)
{
    static const double blind = 0.01; /* of what is known of a strike's pole: if the strike says less it says nothing */
    int n = 2 * b->m + 1, strikes = 0;
    struct arena *inner = arena_open();
    double *inverse = ARENA_TAKE(inner, double, n *n), deviation[POLES], weight[POLES], value = q ? 1.0 : b->s[i].im;
    for (int j = 0; j < b->m; j++) /* not as they were found: what is 0 would stay it */
        memcpy(b->spread[j], modal_converge_stated, sizeof b->spread[j]);
    pass(b, true, NULL);
    for (int k = 0; k < b->fit->data->stretches; k++) {
        if (!b->window[k].used) continue;
        own_inverse(b, k, 0.0, NULL, deviation, weight, inverse);
        double all = 1.0 / inverse[(2 * i + q) * (n + 1)], strike = all - weight[2 * i + q];
        if (!(strike > blind * all)) continue;
        by[strikes] = (deviation[2 * i + q] + inverse[(2 * i + q) * n + n - 1]) * all / (strike * value);
        variance[strikes++] = 1.0 / (strike * value * value);
    }
    arena_close(inner);
    return strikes;
}

/* Of the poles as all strikes together tell them, were they one object at rest, and of each strike's gain with what its
 * own poles are uncertain by. */
void modal_block_errors(struct modal_block *b, int i, double se[2], struct modal_gain *gain)
{
    int p = 2 * b->m, n = p + 1, stretches = b->fit->data->stretches;
    struct arena *inner = arena_open();
    struct sums *g = ARENA_TAKE(inner, struct sums, stretches);
    double *all = ARENA_TAKE(inner, double, p *p), *inverse = ARENA_TAKE(inner, double, n *n), scale[POLES] = {0},
           step[POLES], *own = ARENA_TAKE(inner, double, stretches *p), deviation[POLES], weight[POLES];
    pass(b, true, g);
    solve(b, 0.0, step, own);
    for (int k = 0; k < stretches; k++)
        for (int j = 0; j < p && b->window[k].used; j++) {
            for (int l = 0; l < p; l++)
                all[j * p + l] += b->window[k].a[j * p + l];
            scale[j] += b->window[k].scale[j];
        }
    modal_block_sweep(all, p, 0, p, scale);
    modal_block_sweep(b->normal, p, 0, p, scale);
    for (int q = 0; q < 2; q++)
        se[q] = all[(2 * i + q) * (p + 1)] > 0.0 ? sqrt(all[(2 * i + q) * (p + 1)]) : HUGE_VAL;
    for (int k = 0; k < stretches; k++) {
        cplx at = b->part[i * stretches + k].gain;
        double size = fmax(cplx_abs(at), 1e-300), u[2] = {at.re / size, at.im / size}, sum = 0.0, row[POLES],
               through[POLES] = {0};
        int wide = g[k].n;
        const double *re = g[k].a + 2 * i * wide, *im = re + wide;
        gain[k] = (struct modal_gain){.se = HUGE_VAL};
        if (wide == 0 || !(re[2 * i] > 0.0 && im[2 * i + 1] > 0.0)) continue;
        sum = u[0] * u[0] * re[2 * i] + u[0] * u[1] * (re[2 * i + 1] + im[2 * i]) + u[1] * u[1] * im[2 * i + 1];
        sum *= b->window[k].noise * b->window[k].alike;
        for (int j = 0; j < p; j++)
            row[j] = u[0] * re[g[k].linear + j] + u[1] * im[g[k].linear + j];
        own_inverse(b, k, 0.0, NULL, deviation, weight, inverse);
        for (int j = 0; j < p; j++) /* own poles: (N + W)^-1 by the strike, W (N + W)^-1 times the shared ones' error */
            for (int l = 0; l < p; l++) {
                sum += row[j] * inverse[j * n + l] * row[l];
                through[l] += row[j] * inverse[j * n + l] * weight[l];
            }
        for (int j = 0; j < p; j++)
            for (int l = 0; l < p; l++)
                gain[k].shared += through[j] * b->normal[j * p + l] * through[l];
        gain[k].se = sqrt(fmax(sum, 0.0));
        gain[k].shared = sqrt(fmax(gain[k].shared, 0.0));
    }
    arena_close(inner);
}

/* A fit as a whole: blocks of neighbours in turn until nothing moves, and the modes that it does without. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <string.h>

#include "analysis/modal_fit.h"

enum { NEIGHBOURS = 10, ROUNDS = 4 };

static const double touches = 6.0; /* of the sum of two widths: nearer modes are fitted together */
static const double still = 0.05;  /* standard errors: what moved less has not moved */
static const double cancels =
    10.0; /* of the recording's energy in a mode's window: a louder mode is one of several that cancel */
const double modal_converge_leave = 23.5; /* chance 1e-4 */

static double width_of(const struct modal_fit *f, int i) { return -f->c[i].s.re + 4.0 * REAL_PI / f->longest; }

static double distance(const struct modal_fit *f, int i, int k)
{
    return fabs(f->c[i].s.im - f->c[k].s.im) / (width_of(f, i) + width_of(f, k));
}

int modal_converge_near(const struct modal_fit *f, int i, int most, int *of)
{
    double at[MODAL_BLOCK];
    int n = 0;
    for (int k = 0; k < f->m; k++) {
        double q = k == i ? -1.0 : distance(f, i, k);
        if (q >= touches || (n == most && q >= at[n - 1])) continue;
        int to = n < most ? n++ : n - 1;
        for (; to > 0 && at[to - 1] > q; to--) {
            at[to] = at[to - 1];
            of[to] = of[to - 1];
        }
        at[to] = q;
        of[to] = k;
    }
    for (int a = 1; a < n; a++) /* by frequency: the order of columns is that of the data, not of the search */
        for (int b = a; b > 0 && f->c[of[b]].s.im < f->c[of[b - 1]].s.im; b--) {
            int swap = of[b];
            of[b] = of[b - 1];
            of[b - 1] = swap;
        }
    return n;
}

struct modal_block *modal_converge_open(const struct modal_fit *f, int i, int most, int *at, struct arena *a)
{
    int of[MODAL_BLOCK], n = modal_converge_near(f, i, most, of);
    for (*at = 0; of[*at] != i;)
        ++*at;
    return modal_block_open(f, n, of, NULL, 0, a);
}

double modal_converge_refine(struct modal_fit *f, int n, const int *of, int steps)
{
    struct arena *a = arena_open();
    struct modal_block *b = modal_block_open(f, n, of, NULL, 0, a);
    double most = 0.0, moved[MODAL_BLOCK];
    int stretches = f->data->stretches;
    bool converged = modal_block_polish(b, steps);
    for (int i = 0; i < n; i++) {
        double by[2] = {b->s[i].im - f->c[of[i]].s.im, real_log(b->s[i].re / f->c[of[i]].s.re)};
        double square =
            by[0] * by[0] * b->normal[2 * i * (2 * n + 1)] + by[1] * by[1] * b->normal[(2 * i + 1) * (2 * n + 1)];
        moved[i] = sqrt(square);
        most = fmax(most, moved[i]);
        modal_fit_replace(f, of[i], b->s[i], b->part + i * stretches);
        f->c[of[i]].moved = converged ? 0.0 : fmin(moved[i], 1.0);
    }
    for (int k = 0; k < f->m; k++) {
        bool mine = false;
        for (int i = 0; i < n; i++)
            mine = mine || of[i] == k;
        for (int i = 0; i < n && !mine; i++) { /* skirts fall with the distance, in power with its square */
            double q = distance(f, of[i], k);
            f->c[k].moved = fmax(f->c[k].moved, moved[i] / (1.0 + q * q));
        }
    }
    arena_close(a);
    return most;
}

/* By frequency, so that nothing depends on the order in which components came. */
static void order(struct modal_fit *f)
{
    size_t stretches = (size_t)f->data->stretches;
    for (int i = 1; i < f->m; i++)
        for (int k = i; k > 0 && f->c[k].s.im < f->c[k - 1].s.im; k--) {
            struct modal_component c = f->c[k];
            f->c[k] = f->c[k - 1];
            f->c[k - 1] = c;
            for (size_t g = 0; g < stretches; g++) {
                struct modal_part *at = f->part + (size_t)k * stretches + g, mine = *at;
                *at = at[-(ptrdiff_t)stretches];
                at[-(ptrdiff_t)stretches] = mine;
            }
        }
}

void modal_converge_sweeps(struct modal_fit *f, int most, int rounds)
{
    double left = HUGE_VAL;
    for (int k = 0; k < rounds && left > still; k++) {
        left = 0.0;
        order(f);
        for (int i = 0; i < f->m; i++)
            if (f->c[i].moved > still) {
                int of[MODAL_BLOCK], n = modal_converge_near(f, i, most, of);
                left = fmax(left, modal_converge_refine(f, n, of, 5));
            }
    }
}

/* ------------------------------------------------------------------ what a fit can do without */

double modal_converge_limit(const struct modal_fit *f, double chi4)
{
    return gsl_cdf_chisq_Qinv(real_exp(-0.5 * chi4) * (1.0 + 0.5 * chi4), 2.0 + 2.0 * f->data->stretches);
}

double modal_converge_rise(struct modal_fit *f, int i)
{
    struct arena *a = arena_open();
    int at;
    struct modal_block *b = modal_converge_open(f, i, NEIGHBOURS, &at, a);
    modal_block_polish(b, 0);
    double chi = b->chi;
    modal_block_drop(b, at);
    modal_block_polish(b, 4);
    double rise = b->chi - chi;
    arena_close(a);
    return rise;
}

void modal_converge_drop(struct modal_fit *f, int i, int most)
{
    int of[MODAL_BLOCK], n = modal_converge_near(f, i, most, of), others = 0;
    for (int k = 0; k < n; k++) {
        f->c[of[k]].rise = NAN;
        if (of[k] != i) of[others++] = of[k] - (of[k] > i);
    }
    modal_fit_drop(f, i);
    if (others) modal_converge_refine(f, others, of, 20);
}

int modal_converge_drop_least(struct modal_fit *f, double (*worth)(struct modal_fit *f, int i), int most)
{
    for (int dropped = 0;; dropped++) {
        int which = -1;
        double least = HUGE_VAL;
        for (int i = 0; i < f->m; i++) {
            double mine = worth(f, i);
            which = mine < least ? i : which;
            least = fmin(least, mine);
        }
        if (which < 0) return dropped;
        modal_converge_drop(f, which, most);
    }
}

static double needless(struct modal_fit *f, int i)
{
    struct modal_component *c = &f->c[i];
    if (isnan(c->rise)) c->rise = modal_converge_rise(f, i);
    return c->rise < modal_converge_limit(f, modal_converge_leave) ? c->rise : HUGE_VAL;
}

void modal_converge_eliminate(struct modal_fit *f)
{
    modal_fit_rest(f);
    modal_fit_noise(f, 0.0);
    for (int i = 0; i < f->m; i++)
        f->c[i].rise = NAN;
    modal_converge_drop_least(f, needless, NEIGHBOURS + 1);
}

/* Energy of a component in its own window over that of what there is without it. */
static double loudness(const struct modal_fit *f, int i)
{
    struct arena *a = arena_open();
    struct modal_block *b = modal_block_open(f, 1, &i, NULL, 0, a);
    double mine = 0.0, all = 0.0;
    for (int s = 0; s < f->data->stretches; s++)
        for (long k = b->window[s].from; k < b->window[s].to; k++) {
            mine += cplx_square(cplx_sub(b->window[s].rest[k - b->window[s].from], f->bins[s].rest[k]));
            all += cplx_square(f->bins[s].y[k]);
        }
    arena_close(a);
    return all > 0.0 ? mine / all : 0.0;
}

/* One after the other, the loudest first: without it what it cancelled with may be right. */
static double runaway(struct modal_fit *f, int i)
{
    double size = loudness(f, i);
    return -f->c[i].s.re > 0.99 * f->fastest || size > cancels ? -size : HUGE_VAL;
}

int modal_converge_runaways(struct modal_fit *f) { return modal_converge_drop_least(f, runaway, NEIGHBOURS + 1); }

void modal_converge(struct modal_fit *f)
{
    f->tolerance = 1e-4;
    for (int k = 0, m = -1; k < 4 && m != f->m; k++) {
        for (int i = 0; i < f->m; i++)
            f->c[i].moved = fmax(f->c[i].moved, 1.0);
        m = f->m;
        do /* at first once: many leave, and need not be converged before */
            modal_converge_sweeps(f, 8, k ? ROUNDS : 1);
        while (modal_converge_runaways(f));
        modal_converge_eliminate(f);
    }
    modal_converge_sweeps(f, 8, ROUNDS);
    modal_fit_rest(f);
    modal_fit_noise(f, 0.0);
}

/* ------------------------------------------------------------------ spread

   By how much an object's poles differ from strike to strike, as it rests anew each time: each mode's own variance, by
   moments, drawn towards the median of all modes; none, if all modes together do not show one. */

const double modal_converge_stated[2] = {2e-4, 0.05}; /* of an object that rests well */
static const double prior = 3.0;    /* strikes that the median of all modes counts as */
static const double doubtful = 6.0; /* by how much noise alone spreads a median, times the root of its degrees */

struct moments {
    int n;                   /* strikes */
    double variance, excess; /* between strikes, noise off; scatter over what noise makes of it */
};

/* Strikes weigh as their own noise and the spread so far let them. With weights w of sum W the scatter about the mean
   is expected to be sum w (1 - w/W) (noise + variance), which gives the variance. */
static struct moments moments(const struct modal_fit *f, int i, int q)
{
    struct moments m = {0, 0.0, 0.0};
    struct arena *a = arena_open();
    int at;
    struct modal_block *b = modal_converge_open(f, i, 8, &at, a);
    double *by = ARENA_TAKE(a, double, f->data->stretches), *variance = ARENA_TAKE(a, double, f->data->stretches),
           all = 0.0, mean = 0.0, scatter = 0.0, noise = 0.0, share = 0.0;
    m.n = modal_block_deviations(b, at, q, by, variance);
    for (int k = 0; k < m.n; k++) {
        double w = 1.0 / (variance[k] + f->c[i].spread[q] * f->c[i].spread[q]);
        all += w;
        mean += w * by[k];
    }
    for (int k = 0; k < m.n; k++) {
        double w = 1.0 / (variance[k] + f->c[i].spread[q] * f->c[i].spread[q]), off = by[k] - mean / all,
               part = w * (1.0 - w / all);
        scatter += w * off * off;
        noise += part * variance[k];
        share += part;
    }
    arena_close(a);
    if (m.n < 2) return m;
    double c = 2.0 / (9.0 * (m.n - 1)), median = (1.0 - c) * (1.0 - c) * (1.0 - c); /* of chi squared over degrees */
    m.variance = (scatter - noise) / share;
    m.excess = scatter / (noise * median);
    return m;
}

void modal_converge_spread(struct modal_fit *f)
{
    struct arena *a = arena_open();
    struct moments *m = ARENA_TAKE(a, struct moments, f->m + 1);
    double *excess = ARENA_TAKE(a, double, f->m + 1), *variance = ARENA_TAKE(a, double, f->m + 1);
    for (int q = 0; q < 2; q++) {
        int count = 0;
        double degrees = 0.0, typical = modal_converge_stated[q] * modal_converge_stated[q];
        for (int i = 0; i < f->m; i++) {
            m[i] = moments(f, i, q);
            if (m[i].n < 2) continue;
            excess[count] = m[i].excess;
            variance[count++] = m[i].variance;
            degrees += m[i].n - 1;
        }
        gsl_sort(excess, 1, (size_t)count);
        gsl_sort(variance, 1, (size_t)count);
        bool differ = count && excess[count / 2] > 1.0 + doubtful / sqrt(degrees);
        if (count) typical = differ ? fmax(variance[count / 2], 0.0) : 0.0;
        f->typical[q] = sqrt(typical);
        for (int i = 0; i < f->m; i++) {
            double of = m[i].n > 1 ? m[i].n - 1.0 : 0.0, own = fmax(m[i].variance, 0.0);
            f->c[i].spread[q] = count && !differ ? 0.0 : sqrt((prior * typical + of * own) / (prior + of));
        }
    }
    arena_close(a);
}

/* By how much an object's poles differ from strike to strike, as it rests anew each time: each mode's own variance, by
   moments, drawn towards the median of all modes; none, if all modes together do not show one. */
#include <gsl/gsl_sort.h>

#include "analysis/modal_fit.h"

const double modal_spread_stated[2] = {2e-4, 0.05};
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

void modal_spread(struct modal_fit *f)
{
    struct arena *a = arena_open();
    struct moments *m = ARENA_TAKE(a, struct moments, f->m + 1);
    double *excess = ARENA_TAKE(a, double, f->m + 1), *variance = ARENA_TAKE(a, double, f->m + 1);
    for (int q = 0; q < 2; q++) {
        int count = 0;
        double degrees = 0.0, typical = modal_spread_stated[q] * modal_spread_stated[q];
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

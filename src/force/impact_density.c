/* The inverse of the distribution function F of a mixture, F = sum of s_k F_k. With q_k = F_k^-1(w) the root lies
   between the least and the greatest q_k, since there F is at most and at least w. That bracket is first cut at the
   places where F jumps (what is constant) or has a kink (the ends of an exponential's and of a table's range); inside,
   Newton's steps on ln F, and beyond the median on ln(1 - F), which are nearly straight in the tails where F is not; a
   step that leaves the bracket or does not halve the one before is replaced by bisection. Beyond the median 1 - F is
   summed itself, not had from F. */
#include "force/impact_density.h"

#include "num/normal.h"
#include "num/real.h"

/* ------------------------------------------------------------------ one */

static struct impact_density *density_make(struct arena *a, int kind, double mean, double deviation)
{
    struct impact_density *d = ARENA_TAKE(a, struct impact_density, 1);
    *d = (struct impact_density){.kind = kind, .mean = mean, .variance = deviation * deviation, .deviation = deviation};
    return d;
}

struct impact_density *impact_density_point(double value, struct arena *a)
{
    return density_make(a, IMPACT_DENSITY_POINT, value, 0);
}

struct impact_density *impact_density_gaussian(double deviation, struct arena *a)
{
    return density_make(a, deviation > 0 ? IMPACT_DENSITY_GAUSSIAN : IMPACT_DENSITY_POINT, 0, deviation);
}

struct impact_density *impact_density_exponential(double mean, struct arena *a)
{
    return density_make(a, mean > 0 ? IMPACT_DENSITY_EXPONENTIAL : IMPACT_DENSITY_POINT, mean, mean);
}

struct impact_density *impact_density_table(const char *file, struct arena *a, struct err *e)
{
    struct impact_density *d = density_make(a, IMPACT_DENSITY_TABLE, 0, 0);
    if (!impact_table_read(file, a, &d->table, e)) return NULL;
    d->mean = d->table.mean;
    d->variance = d->table.variance;
    d->deviation = sqrt(d->variance);
    return d;
}

double impact_density_quantile(const struct impact_density *d, double w)
{
    switch (d->kind) {
    case IMPACT_DENSITY_GAUSSIAN:
        return d->deviation * normal_quantile(w);
    case IMPACT_DENSITY_EXPONENTIAL:
        return -d->mean * (w <= 0.5 ? real_log1p(-w) : real_log(1 - w));
    case IMPACT_DENSITY_TABLE:
        return impact_table_quantile(&d->table, w);
    default:
        return d->mean;
    }
}

/* The probability above x (`upper`) or below it, a point at x apart, and the density there. */
static double beyond(const struct impact_density *d, bool upper, double x, double *density)
{
    double e;
    switch (d->kind) {
    case IMPACT_DENSITY_GAUSSIAN:
        e = normal_cdf_density((upper ? -x : x) / d->deviation, density);
        *density /= d->deviation;
        return e;
    case IMPACT_DENSITY_EXPONENTIAL:
        e = x > 0 ? real_exp(-x / d->mean) : 1;
        *density = x > 0 ? e / d->mean : 0;
        return upper ? e : 1 - e;
    case IMPACT_DENSITY_TABLE:
        *density = impact_table_density(&d->table, x);
        return upper ? impact_table_above(&d->table, x) : impact_table_below(&d->table, x);
    default:
        *density = 0;
        return upper ? x < d->mean : x > d->mean;
    }
}

/* Where F jumps or has a kink. */
static int breaks(const struct impact_density *d, double at[2])
{
    at[0] = d->kind == IMPACT_DENSITY_POINT ? d->mean : 0;
    if (d->kind == IMPACT_DENSITY_TABLE) {
        at[0] = d->table.value[0];
        at[1] = d->table.value[d->table.n - 1];
        return 2;
    }
    return d->kind != IMPACT_DENSITY_GAUSSIAN;
}

/* ------------------------------------------------------------------ a mixture */

void impact_density_moments(const struct impact_mixture *m, double *mean, double *variance)
{
    double sum = 0, square = 0;
    for (int k = 0; k < m->n; k++)
        sum += m->share[k] * m->part[k]->mean;
    for (int k = 0; k < m->n; k++)
        square += m->share[k] * (m->part[k]->variance + (m->part[k]->mean - sum) * (m->part[k]->mean - sum));
    *mean = sum;
    *variance = square;
}

struct root {
    const struct impact_mixture *m;
    bool upper;       /* w > 1/2: probabilities are those above          */
    double tail;      /* w, or 1 - w                                     */
    double low, high; /* the root lies between                           */
};

/* The same of the mixture. */
static double root_beyond(const struct root *r, double x, double *density)
{
    double sum = 0, one;
    *density = 0;
    for (int k = 0; k < r->m->n; k++) {
        sum += r->m->share[k] * beyond(r->m->part[k], r->upper, x, &one);
        *density += r->m->share[k] * one;
    }
    return sum;
}

/* Cuts the bracket at b; true: it is the root. */
static bool root_cut(struct root *r, double b)
{
    double density, outside = root_beyond(r, b, &density), mass = 0;
    for (int k = 0; k < r->m->n; k++)
        if (r->m->part[k]->kind == IMPACT_DENSITY_POINT && r->m->part[k]->mean == b) mass += r->m->share[k];
    bool left = r->upper ? r->tail >= outside + mass : r->tail <= outside; /* w <= P(X < b) */
    bool right = r->upper ? r->tail < outside : r->tail > outside + mass;  /* w > P(X <= b) */
    if (left) r->high = b;
    if (right) r->low = b;
    return !left && !right;
}

/* Newton's step at x, after cutting the bracket there; HUGE_VAL: there is none. */
static double root_step(struct root *r, double x)
{
    double d, outside = root_beyond(r, x, &d);
    if ((outside > r->tail) == r->upper)
        r->low = x;
    else
        r->high = x;
    if (!(d > 0) || !(outside > 0)) return HUGE_VAL;
    return (r->upper ? 1 : -1) * real_log(outside / r->tail) * outside / d;
}

/* Newton's error after a step is about c step^2; c is taken as at least 10 over the least deviation of a part, and as
   what two steps in a row tell, step / (the step before)^2. */
static double root_find(struct root *r, double x, double width)
{
    double last = r->high - r->low, least = HUGE_VAL;
    bool told = false;
    for (int k = 0; k < r->m->n; k++)
        least = r->m->part[k]->deviation > 0 ? fmin(least, r->m->part[k]->deviation) : least;
    for (int i = 0; i < 200 && r->high - r->low > 1e-13 * width; i++) {
        double step = root_step(r, x), ratio = fabs(step) / last;
        if (x + step >= r->low && x + step <= r->high && ratio <= 0.5) {
            x += step;
            if (fmin(fmax(told ? ratio * ratio : 1, 10 * fabs(step) / least), 1) * fabs(step) <= 1e-13 * width) break;
            last = fabs(step);
            told = true;
        } else {
            last = 0.5 * (r->high - r->low);
            x = 0.5 * (r->low + r->high);
            told = false;
            if (x <= r->low || x >= r->high) break;
        }
    }
    return x;
}

double impact_density_mixed(const struct impact_mixture *m, double w)
{
    struct root r = {m, w > 0.5, w > 0.5 ? 1 - w : w, HUGE_VAL, -HUGE_VAL};
    double start = 0, mean, variance, at[2];
    for (int k = 0; k < m->n; k++) {
        double q = impact_density_quantile(m->part[k], w);
        r.low = fmin(r.low, q);
        r.high = fmax(r.high, q);
        start += m->share[k] * q;
    }
    for (int k = 0; k < m->n; k++)
        for (int i = breaks(m->part[k], at) - 1; i >= 0; i--)
            if (at[i] >= r.low && at[i] <= r.high && root_cut(&r, at[i])) return at[i];
    impact_density_moments(m, &mean, &variance);
    if (!(start > r.low && start < r.high)) start = 0.5 * (r.low + r.high);
    return root_find(&r, start, sqrt(variance));
}

/* The inverse of the distribution function F of a mixture, F = sum of s_k F_k. With q_k = F_k^-1(w) the root lies
   between the least and the greatest q_k, since there F is at most and at least w. That bracket is first cut at the
   places where F jumps (what is constant) or has a kink (the ends of an exponential's and of a table's range); inside,
   Newton's steps on ln F, and beyond the median on ln(1 - F), which are nearly straight in the tails where F is not; a
   step that leaves the bracket or does not halve the one before is replaced by bisection. Beyond the median 1 - F is
   summed itself, not had from F. */
#include "force/impact_density.h"

#include <math.h>

#include "base/stopwatch.h"
#include "file/csv.h"
#include "num/real.h"
#include "num/special.h"

/* ------------------------------------------------------------------ a table */

/* A density d that is straight between its rows (v_i, d_i) and 0 outside. In a piece with s = x - v_i and slope k the
   probability is P_i + d_i s + k s^2/2, whose inverse is s = 2 r / (d_i + sqrt(d_i^2 + 2 k r)), r = w - P_i: no
   difference of near numbers. Below the median probabilities are counted from the left, above it from the right, so
   that both ends are exact. Where the density is 0 over a whole piece, the inverse at its probability is either end. */

static bool table_columns(const struct csv *c, struct impact_table *t, struct err *e)
{
    int value = csv_column(c, "value"), density = csv_column(c, "density");
    if (value < 0 || density < 0)
        return err_set(e, ERR_SCENE,
                       "%s: there is no column '%s'; a distribution has the columns value, density, separated by "
                       "commas: name them in its first line",
                       c->file, value < 0 ? "value" : "density");
    if (c->rows < 2)
        return err_set(e, ERR_SCENE, "%s: %zu row%s; a density needs at least 2", c->file, c->rows,
                       c->rows == 1 ? "" : "s");
    for (size_t i = 0; i < c->rows; i++)
        if (!csv_number(c, i, value, &t->value[i], e) || !csv_number(c, i, density, &t->density[i], e)) return false;
    return true;
}

static bool table_values(const struct csv *c, const struct impact_table *t, struct err *e)
{
    for (int i = 0; i < t->n; i++) {
        if (t->density[i] < 0)
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'density': %.9g is below 0; a density is 0 or more: mend the row", c->file,
                           c->lines[i], t->density[i]);
        if (i > 0 && !(t->value[i] > t->value[i - 1]))
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'value': %.9g comes after %.9g; values must rise from row to row", c->file,
                           c->lines[i], t->value[i], t->value[i - 1]);
    }
    return true;
}

/* Probability of piece i. */
static double table_piece(const struct impact_table *t, int i)
{
    return 0.5 * (t->value[i + 1] - t->value[i]) * (t->density[i] + t->density[i + 1]);
}

static bool table_scale(const struct csv *c, struct impact_table *t, struct err *e)
{
    double area = 0;
    for (int i = 0; i + 1 < t->n; i++)
        area += table_piece(t, i);
    if (!(area > 0) || !isfinite(area) || !isfinite(1 / area))
        return err_set(e, ERR_SCENE,
                       "%s: the area under column 'density' is %.9g; it must be above 0 (and is scaled to 1)", c->file,
                       area);
    for (int i = 0; i < t->n; i++)
        t->density[i] /= area;
    for (int i = 1; i < t->n; i++)
        t->below[i] = t->below[i - 1] + table_piece(t, i - 1);
    for (int i = t->n - 2; i >= 0; i--)
        t->above[i] = t->above[i + 1] + table_piece(t, i);
    return true;
}

/* The sum over the pieces of the integral of d (x - from)^power, a polynomial of degree 3 at most: Simpson's rule is
 * exact. */
static double table_moment(const struct impact_table *t, double from, int power)
{
    double sum = 0;
    for (int i = 0; i + 1 < t->n; i++) {
        double x[2] = {t->value[i] - from, t->value[i + 1] - from}, middle = 0.5 * (x[0] + x[1]),
               d[2] = {t->density[i], t->density[i + 1]};
        double f[3] = {d[0] * x[0], 0.5 * (d[0] + d[1]) * middle, d[1] * x[1]};
        if (power == 2) f[0] *= x[0], f[1] *= middle, f[2] *= x[1];
        sum += (x[1] - x[0]) / 6 * (f[0] + 4 * f[1] + f[2]);
    }
    return sum;
}

static bool table_read(const char *file, struct arena *a, struct impact_table *t, struct err *e)
{
    struct csv c;
    if (!csv_read(file, a, &c, e)) return false;
    *t = (struct impact_table){.n = (int)c.rows,
                               .value = ARENA_TAKE(a, double, c.rows + 1),
                               .density = ARENA_TAKE(a, double, c.rows + 1),
                               .below = ARENA_TAKE(a, double, c.rows + 1),
                               .above = ARENA_TAKE(a, double, c.rows + 1)};
    if (!table_columns(&c, t, e) || !table_values(&c, t, e) || !table_scale(&c, t, e)) return false;
    t->mean = t->value[0] + table_moment(t, t->value[0], 1);
    t->variance = table_moment(t, t->mean, 2);
    return true;
}

/* The piece i, 0 .. n - 2, of the last row with at[i] <= x (`sign` 1, rising) or >= x (-1, falling). */
static int table_piece_of(const double *at, int n, double x, double sign)
{
    int low = 0, high = n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (sign * at[middle] <= sign * x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Distance from a row at which the probability r is reached, the density being d there and d + slope s at distance s.
 */
static double table_reach(double d, double slope, double r)
{
    double root = sqrt(fmax(d * d + 2 * slope * r, 0));
    return r > 0 ? 2 * r / (d + root) : 0;
}

static double table_quantile(const struct impact_table *t, double w)
{
    const double *v = t->value, *d = t->density;
    int i = table_piece_of(w <= 0.5 ? t->below : t->above, t->n, w <= 0.5 ? w : 1 - w, w <= 0.5 ? 1 : -1);
    double width = v[i + 1] - v[i], slope = (d[i + 1] - d[i]) / width;
    if (w <= 0.5) return v[i] + fmin(table_reach(d[i], slope, w - t->below[i]), width);
    return v[i + 1] - fmin(table_reach(d[i + 1], -slope, 1 - w - t->above[i + 1]), width);
}

static double table_density(const struct impact_table *t, double x)
{
    if (x < t->value[0] || x > t->value[t->n - 1]) return 0;
    int i = table_piece_of(t->value, t->n, x, 1);
    return t->density[i] + (t->density[i + 1] - t->density[i]) * ((x - t->value[i]) / (t->value[i + 1] - t->value[i]));
}

/* The share of what lies above x, or below it. */
static double table_beyond(const struct impact_table *t, double x, bool upper)
{
    if (x <= t->value[0] || x >= t->value[t->n - 1]) return (x > t->value[0]) != upper;
    int i = table_piece_of(t->value, t->n, x, 1), end = i + upper;
    return (upper ? t->above : t->below)[end] + 0.5 * fabs(t->value[end] - x) * (t->density[end] + table_density(t, x));
}

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
    if (!table_read(file, a, &d->table, e)) return NULL;
    d->mean = d->table.mean;
    d->variance = d->table.variance;
    d->deviation = sqrt(d->variance);
    return d;
}

double impact_density_quantile(const struct impact_density *d, double w)
{
    switch (d->kind) {
    case IMPACT_DENSITY_GAUSSIAN:
        return d->deviation * special_normal_quantile(w);
    case IMPACT_DENSITY_EXPONENTIAL:
        return -d->mean * (w <= 0.5 ? real_log1p(-w) : real_log(1 - w));
    case IMPACT_DENSITY_TABLE:
        return table_quantile(&d->table, w);
    default:
        return d->mean;
    }
}

double impact_density_beyond(const struct impact_density *d, bool upper, double x, double *density)
{
    double e;
    switch (d->kind) {
    case IMPACT_DENSITY_GAUSSIAN:
        e = special_normal_cdf_density((upper ? -x : x) / d->deviation, density);
        *density /= d->deviation;
        return e;
    case IMPACT_DENSITY_EXPONENTIAL:
        e = x > 0 ? real_exp(-x / d->mean) : 1;
        *density = x > 0 ? e / d->mean : 0;
        return upper ? e : 1 - e;
    case IMPACT_DENSITY_TABLE:
        *density = table_density(&d->table, x);
        return table_beyond(&d->table, x, upper);
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
        sum += r->m->share[k] * impact_density_beyond(r->m->part[k], r->upper, x, &one);
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
    bool known = false;
    for (int k = 0; k < r->m->n; k++)
        least = r->m->part[k]->deviation > 0 ? fmin(least, r->m->part[k]->deviation) : least;
    for (int i = 0; i < 200 && r->high - r->low > 1e-13 * width; i++) {
        double step = root_step(r, x), ratio = fabs(step) / last;
        if (x + step >= r->low && x + step <= r->high && ratio <= 0.5) {
            x += step;
            if (fmin(fmax(known ? ratio * ratio : 1, 10 * fabs(step) / least), 1) * fabs(step) <= 1e-13 * width) break;
            last = fabs(step);
            known = true;
        } else {
            last = 0.5 * (r->high - r->low);
            x = 0.5 * (r->low + r->high);
            known = false;
            if (x <= r->low || x >= r->high) break;
        }
    }
    return x;
}

double impact_density_mixed(const struct impact_mixture *m, double w)
{
    struct root r = {m, w > 0.5, w > 0.5 ? 1 - w : w, HUGE_VAL, -HUGE_VAL};
    double start = 0, mean, variance, at[2];
    stopwatch_spend(2200); /* predicted cycles of Newton's method */
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

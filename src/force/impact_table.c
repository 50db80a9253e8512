/* A density d that is straight between its rows (v_i, d_i) and 0 outside. In a piece with s = x - v_i and slope k the
   probability is P_i + d_i s + k s^2/2, whose inverse is s = 2 r / (d_i + sqrt(d_i^2 + 2 k r)), r = w - P_i: no
   difference of near numbers. Below the median probabilities are counted from the left, above it from the right, so
   that both ends are exact. Where the density is 0 over a whole piece, the inverse at its probability is either end. */
#include "force/impact_table.h"

#include <math.h>

#include "file/csv.h"

/* ------------------------------------------------------------------ reading */

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
static double piece(const struct impact_table *t, int i)
{
    return 0.5 * (t->value[i + 1] - t->value[i]) * (t->density[i] + t->density[i + 1]);
}

static bool table_scale(const struct csv *c, struct impact_table *t, struct err *e)
{
    double area = 0;
    for (int i = 0; i + 1 < t->n; i++)
        area += piece(t, i);
    if (!(area > 0) || !isfinite(area) || !isfinite(1 / area))
        return err_set(e, ERR_SCENE,
                       "%s: the area under column 'density' is %.9g; it must be above 0 (and is scaled to 1)", c->file,
                       area);
    for (int i = 0; i < t->n; i++)
        t->density[i] /= area;
    for (int i = 1; i < t->n; i++)
        t->below[i] = t->below[i - 1] + piece(t, i - 1);
    for (int i = t->n - 2; i >= 0; i--)
        t->above[i] = t->above[i + 1] + piece(t, i);
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

bool impact_table_read(const char *file, struct arena *a, struct impact_table *t, struct err *e)
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

/* ------------------------------------------------------------------ the distribution */

/* The piece i, 0 .. n - 2, of the last row with at[i] <= x (`sign` 1, rising) or >= x (-1, falling). */
static int piece_of(const double *at, int n, double x, double sign)
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
static double reach(double d, double slope, double r)
{
    double root = sqrt(fmax(d * d + 2 * slope * r, 0));
    return r > 0 ? 2 * r / (d + root) : 0;
}

double impact_table_quantile(const struct impact_table *t, double w)
{
    const double *v = t->value, *d = t->density;
    int i = piece_of(w <= 0.5 ? t->below : t->above, t->n, w <= 0.5 ? w : 1 - w, w <= 0.5 ? 1 : -1);
    double width = v[i + 1] - v[i], slope = (d[i + 1] - d[i]) / width;
    if (w <= 0.5) return v[i] + fmin(reach(d[i], slope, w - t->below[i]), width);
    return v[i + 1] - fmin(reach(d[i + 1], -slope, 1 - w - t->above[i + 1]), width);
}

double impact_table_density(const struct impact_table *t, double x)
{
    if (x < t->value[0] || x > t->value[t->n - 1]) return 0;
    int i = piece_of(t->value, t->n, x, 1);
    return t->density[i] + (t->density[i + 1] - t->density[i]) * ((x - t->value[i]) / (t->value[i + 1] - t->value[i]));
}

double impact_table_below(const struct impact_table *t, double x)
{
    if (x <= t->value[0] || x >= t->value[t->n - 1]) return x > t->value[0];
    int i = piece_of(t->value, t->n, x, 1);
    return t->below[i] + 0.5 * (x - t->value[i]) * (t->density[i] + impact_table_density(t, x));
}

double impact_table_above(const struct impact_table *t, double x)
{
    if (x <= t->value[0] || x >= t->value[t->n - 1]) return x <= t->value[0];
    int i = piece_of(t->value, t->n, x, 1);
    return t->above[i + 1] + 0.5 * (t->value[i + 1] - x) * (t->density[i + 1] + impact_table_density(t, x));
}

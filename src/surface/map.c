/* Height maps as tensor-product cubic splines: C2, so that curvature in any direction is continuous. The coefficients are those of
   surface/profile.c, along rows, then along columns. Weights of the four coefficients around a point at share f of its cell:

     B    (1-f)^3/6,  2/3 - f^2 + f^3/2,  1/6 + f/2 + f^2/2 - f^3/2,  f^3/6
     B'   -(1-f)^2/2, f (3f/2 - 2),  1/2 + f - 3f^2/2,  f^2/2             per pitch
     B''  1-f,  3f-2,  1-3f,  f                                           per pitch^2 */
#include "surface/map.h"

#include <math.h>

#include "surface/profile.h"

struct map {
    long columns, rows;
    double pitch[2], origin[2];
    int off_map;
    double base, *c;   /* m; coefficients above base, so that a flat map is flat to the bit */
};

struct weights {
    double b[4], d[4], dd[4]; /* value, first and second derivative, in units of the pitch */
};

static struct weights weights_at(double f)
{
    double g = 1 - f;
    return (struct weights){.b = {g * g * g / 6, 2.0 / 3 - f * f * (1 - f / 2), 2.0 / 3 - g * g * (1 - g / 2), f * f * f / 6},
                            .d = {-g * g / 2, f * (1.5 * f - 2), -g * (1.5 * g - 2), f * f / 2},
                            .dd = {g, 3 * f - 2, 1 - 3 * f, f}};
}

/* The 16 coefficients around a cell, [row][column]. */
static void map_gather(const struct map *m, long column, long row, double c[4][4])
{
    bool inside = column >= 1 && column + 2 < m->columns && row >= 1 && row + 2 < m->rows;
    for (int j = 0; j < 4; j++) {
        long r = row - 1 + j;
        const double *from = m->c + (inside ? r : profile_folded(r, m->rows, m->off_map)) * m->columns;
        for (int i = 0; i < 4; i++) {
            long k = column - 1 + i;
            c[j][i] = from[inside ? k : profile_folded(k, m->columns, m->off_map)];
        }
    }
}

static double dot(const double a[4], const double b[4])
{
    return ((a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]));
}

static void map_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct map *m = part->state;
    double hx = m->pitch[0], hy = m->pitch[1];
    for (size_t n = 0; n < p->n; n++) {
        double qx = (p->x[n] - m->origin[0]) / hx, qy = (p->y[n] - m->origin[1]) / hy, i = floor(qx), j = floor(qy);
        double c[4][4], b[4], d[4], dd[4];
        struct weights x = weights_at(qx - i), y = weights_at(qy - j);
        map_gather(m, (long)i, (long)j, c);
        for (int k = 0; k < 4; k++) {
            b[k] = dot(x.b, c[k]);
            d[k] = dot(x.d, c[k]);
            dd[k] = dot(x.dd, c[k]);
        }
        if (v->z)
            v->z[n] += m->base + dot(y.b, b);
        if (v->x)
            v->x[n] += dot(y.b, d) / hx;
        if (v->y)
            v->y[n] += dot(y.d, b) / hy;
        if (v->xx)
            v->xx[n] += dot(y.b, dd) / (hx * hx);
        if (v->xy)
            v->xy[n] += dot(y.d, d) / (hx * hy);
        if (v->yy)
            v->yy[n] += dot(y.dd, b) / (hy * hy);
    }
}

/* Along rows into c, then along columns in place, one column at a time; then above the first. */
static void map_coefficients(struct map *m, const double *z, struct arena *a)
{
    double *column = ARENA_TAKE(a, double, m->rows), *smooth = ARENA_TAKE(a, double, m->rows);
    for (long j = 0; j < m->rows; j++)
        profile_coefficients(z + j * m->columns, m->c + j * m->columns, (size_t)m->columns, m->off_map);
    for (long i = 0; i < m->columns; i++) {
        for (long j = 0; j < m->rows; j++)
            column[j] = m->c[j * m->columns + i];
        profile_coefficients(column, smooth, (size_t)m->rows, m->off_map);
        for (long j = 0; j < m->rows; j++)
            m->c[j * m->columns + i] = smooth[j];
    }
    m->base = m->c[0];
    for (long k = 0; k < m->columns * m->rows; k++)
        m->c[k] -= m->base;
}

struct relief_part *map_part(struct arena *a, const double *z, size_t columns, size_t rows, const double pitch[2], const double origin[2],
                             int off_map, const char *name)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct map *m = ARENA_TAKE(a, struct map, 1);
    *m = (struct map){.columns = (long)columns, .rows = (long)rows, .pitch = {pitch[0], pitch[1]}, .origin = {origin[0], origin[1]},
                      .off_map = off_map, .c = ARENA_TAKE(a, double, columns * rows)};
    map_coefficients(m, z, a);
    *part = (struct relief_part){.name = name, .pitch = {pitch[0], pitch[1]}, .origin = {origin[0], origin[1]},
                                 .finest = pitch[0] < pitch[1] ? pitch[0] : pitch[1], .from = {origin[0], origin[1]},
                                 .to = {origin[0] + pitch[0] * (double)(columns - 1), origin[1] + pitch[1] * (double)(rows - 1)},
                                 .add = map_add, .state = m};
    return part;
}

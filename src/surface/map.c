/* Height maps as tensor-product cubic splines: C2, so that curvature in any direction is continuous. The coefficients
   are those of surface/profile.c, along rows, then along columns; they are read by surface/bicubic.c. */
#include "surface/map.h"

#include "num/lanes.h"
#include "surface/bicubic.h"
#include "surface/profile.h"

struct map {
    struct map_spline spline;
    double origin[2];
};

/* The 4 x 4 coefficients around a cell, in rows `stride` numbers apart: in the map, or at its edges gathered. */
static const double *map_around(const struct map_spline *m, long column, long row, double edge[16], long *stride)
{
    if (column >= 1 && column + 2 < m->columns && row >= 1 && row + 2 < m->rows) {
        *stride = m->columns;
        return m->c + (row - 1) * m->columns + column - 1;
    }
    *stride = 4;
    long across[4];
    for (long i = 0; i < 4; i++)
        across[i] = profile_folded(column - 1 + i, m->columns, m->off_map);
    for (long j = 0; j < 4; j++) {
        const double *from = m->c + profile_folded(row - 1 + j, m->rows, m->off_map) * m->columns;
        for (long i = 0; i < 4; i++)
            edge[4 * j + i] = from[across[i]];
    }
    return edge;
}

LANES_CLONES
static void places(const struct map *m, int n, const double *x, const double *y, double *p[2])
{
    double *restrict px = p[0], *restrict py = p[1], from[2] = {m->origin[0], m->origin[1]},
                     pitch[2] = {m->spline.pitch[0], m->spline.pitch[1]};
#pragma omp simd
    for (int i = 0; i < n; i++) {
        px[i] = (x[i] - from[0]) / pitch[0];
        py[i] = (y[i] - from[1]) / pitch[1];
    }
}

LANES_CLONES
static void values_put(int n, const double *from, double base, double *to)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        to[i] += base + from[i];
}

static void map_put(const struct map_spline *m, const struct bicubic *b, const struct relief_values *v, size_t at)
{
    const double *from[6] = {b->z, b->x, b->y, b->xx, b->xy, b->yy};
    double *to[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    for (int k = 0; k < 6; k++)
        if (to[k]) values_put(b->n, from[k], k == 0 ? m->base : 0, to[k] + at);
}

static void map_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    const struct map *m = part->state;
    struct bicubic b;
    double px[BICUBIC_POINTS], py[BICUBIC_POINTS];
    for (size_t at = 0; at < p->n; at += BICUBIC_POINTS) {
        int n = p->n - at < BICUBIC_POINTS ? (int)(p->n - at) : BICUBIC_POINTS;
        places(m, n, p->x + at, p->y + at, (double *[2]){px, py});
        bicubic_cells(&b, n, px, py);
        for (int i = 0, end; i < n; i = end) {
            double edge[16];
            long stride;
            const double *from = map_around(&m->spline, (long)b.column[i], (long)b.row[i], edge, &stride);
            end = bicubic_run(&b, i);
            bicubic_put(&b, i, end, from, stride);
        }
        bicubic_sum(&b, 1 / m->spline.pitch[0], 1 / m->spline.pitch[1], v);
        map_put(&m->spline, &b, v, at);
    }
}

/* Along rows into c, then along columns in place, one column at a time; then above the first. */
static void map_coefficients(struct map_spline *m, const double *z, struct arena *a)
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

struct map_spline *map_spline(struct arena *a, const struct height_map *h, int off_map)
{
    struct map_spline *m = ARENA_TAKE(a, struct map_spline, 1);
    *m = (struct map_spline){.columns = (long)h->columns,
                             .rows = (long)h->rows,
                             .pitch = {h->pitch[0], h->pitch[1]},
                             .off_map = off_map,
                             .c = ARENA_TAKE(a, double, h->columns * h->rows)};
    map_coefficients(m, h->z, a);
    return m;
}

struct relief_part *map_part(struct arena *a, const struct map_spline *spline, const double origin[2], const char *name)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct map *m = ARENA_TAKE(a, struct map, 1);
    const double *pitch = spline->pitch;
    *m = (struct map){*spline, {origin[0], origin[1]}};
    *part = (struct relief_part){
        .name = name,
        .pitch = {pitch[0], pitch[1]},
        .origin = {origin[0], origin[1]},
        .finest = pitch[0] < pitch[1] ? pitch[0] : pitch[1],
        .from = {origin[0], origin[1]},
        .to = {origin[0] + pitch[0] * (double)(spline->columns - 1), origin[1] + pitch[1] * (double)(spline->rows - 1)},
        .add = map_add,
        .state = m};
    return part;
}

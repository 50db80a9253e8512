/* A round rod along x: a section of a square inside and rings round it, swept; a tube: layers round the axis. */
#include <math.h>

#include "fem/shapes_disc.h"
#include "fem/shapes_kinds.h"
#include "num/real.h"

enum { LENGTH, DIAMETER, WALL };
enum { SQUARE = 4, TUBE };

struct rod {
    double length, radius, wall;
    int m, layers, along; /* cells: side of the square (a quarter round), outwards, along x */
};

static void place(const void *shape, int which, const double c[3], double at[3])
{
    const struct rod *r = shape;
    double p[2], scale = r->radius;
    if (which == SQUARE)
        shapes_disc_core(2 * c[0] / r->m - 1, 2 * c[1] / r->m - 1, p);
    else if (which == TUBE) {
        shapes_disc_turn(90 * c[0] / r->m, p);
        scale = r->radius - (1 - c[1] / r->layers) * r->wall;
    } else
        shapes_disc_ring(which, 2 * c[0] / r->m - 1, c[1] / r->layers, 90 * (which + c[0] / r->m - 0.5), p);
    at[0] = r->length * (c[2] / r->along);
    at[1] = scale * p[0];
    at[2] = scale * p[1];
}

static void blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct rod *r = ARENA_TAKE(a, struct rod, 1);
    *r = (struct rod){.length = q->length[LENGTH],
                      .radius = q->length[DIAMETER] / 2,
                      .wall = isnan(q->length[WALL]) ? 0 : q->length[WALL]};
    r->m = shapes_kinds_cells(q, REAL_PI / 2 * r->radius, r->wall > 0 ? q->fineness + 1 : q->fineness);
    r->layers = shapes_kinds_across(q, r->wall > 0 ? r->wall : r->radius / 2);
    r->along = shapes_kinds_cells(q, r->length, q->fineness);
    *s = (struct shapes_blocks){.place = place, .shape = r, .size = fmax(r->length, 2 * r->radius)};
    if (r->wall > 0)
        shapes_blocks_add(s, TUBE, 4 * r->m, r->layers, r->along);
    else {
        shapes_blocks_add(s, SQUARE, r->m, r->m, r->along);
        for (int i = 0; i < 4; i++)
            shapes_blocks_add(s, i, r->m, r->layers, r->along);
    }
    for (int i = 0; i < s->n; i++) {
        s->block[i].side[2][0] = "x0";
        s->block[i].side[2][1] = "x1";
    }
}

static bool check(struct shapes_ask *q, struct err *e)
{
    return !(q->length[WALL] >= 0.49 * q->length[DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "wall is %g m, and at most 0.49 of the diameter, %g m, makes a tube; without wall= the rod is solid",
                   q->length[WALL], q->length[DIAMETER]);
}

const struct shapes_kind shapes_rod = {"rod", {"length", "diameter", "wall"}, 2, 3, 13000, check, blocks};

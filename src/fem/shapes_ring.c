/* A flat ring round the z axis, z in [0, thickness]. */
#include <math.h>

#include "fem/shapes_disc.h"
#include "fem/shapes_kinds.h"
#include "num/real.h"

enum { DIAMETER, WIDTH, THICKNESS };

struct ring {
    double radius, width, thickness;
    int round, across, up; /* cells */
};

static void place(const void *shape, int which, const double c[3], double at[3])
{
    (void)which;
    const struct ring *r = shape;
    double radius = r->radius - (1 - c[1] / r->across) * r->width;
    shapes_disc_turn(360 * c[0] / r->round, at);
    at[0] *= radius;
    at[1] *= radius;
    at[2] = r->thickness * (c[2] / r->up);
}

static void blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct ring *r = ARENA_TAKE(a, struct ring, 1);
    *r = (struct ring){.radius = q->length[DIAMETER] / 2, .width = q->length[WIDTH], .thickness = q->length[THICKNESS]};
    r->round = 4 * shapes_kinds_cells(q, REAL_PI / 2 * (r->radius - r->width / 2), q->fineness + 1);
    r->across = shapes_kinds_across(q, r->width);
    r->up = shapes_kinds_across(q, r->thickness);
    *s = (struct shapes_blocks){.place = place, .shape = r, .size = fmax(2 * r->radius, r->thickness)};
    struct shapes_block *b = shapes_blocks_add(s, 0, r->round, r->across, r->up);
    b->side[2][0] = "z0";
    b->side[2][1] = "z1";
}

static bool check(struct shapes_ask *q, struct err *e)
{
    return !(q->length[WIDTH] > 0.49 * q->length[DIAMETER]) ||
           err_set(e, ERR_USAGE, "width is %g m, and at most 0.49 of the diameter, %g m, leaves a hole in the ring",
                   q->length[WIDTH], q->length[DIAMETER]);
}

const struct shapes_kind shapes_ring = {"ring", {"diameter", "width", "thickness"}, 3, 3, 11000, check, blocks};

/* A bowl: outside, a disc of the foot's diameter at z = 0 and above it the sphere through its edge and the rim's,

     z_c = ((diameter/2)^2 + height^2 - (foot/2)^2) / (2 height),   R^2 = (foot/2)^2 + z_c^2

   inside, the same z = thickness and radius R - thickness, so that the wall is as thick everywhere; the rim is cut flat
   at z = height. A layer at w of the thickness (0 outside) is the sphere of radius R - w from z = w, where it meets the
   foot's disc, up to z = height, in steps of its angle that shrink towards the rim, where the waves are: the last is
   0.6 of their mean, the first 1.4. */
#include <math.h>

#include "fem/shapes_disc.h"
#include "fem/shapes_kinds.h"
#include "num/real.h"

enum { DIAMETER, HEIGHT, THICKNESS, FOOT };
enum { SQUARE = 4, WALL };

#define GRADING 0.4

struct bowl {
    double height, thickness, centre, radius; /* of the sphere */
    int m, ring, layers, up;                  /* cells: a quarter round, the foot's ring, through, from foot to rim */
};

static void sphere(const struct shapes_ask *q, double *centre, double *radius)
{
    double d = q->length[DIAMETER] / 2, f = q->length[FOOT] / 2, h = q->length[HEIGHT];
    *centre = (d * d + h * h - f * f) / (2 * h);
    *radius = sqrt(f * f + *centre * *centre);
}

/* Angle from the bottom at which a sphere round z = centre reaches z, rad. */
static double angle_at(double radius, double down)
{
    return real_atan2(sqrt(fmax(radius * radius - down * down, 0)), down);
}

static void place(const void *shape, int which, const double c[3], double at[3])
{
    const struct bowl *b = shape;
    double w = b->thickness * (c[2] / b->layers), radius = b->radius - w, down = b->centre - w,
           foot = sqrt(fmax(radius * radius - down * down, 0));
    at[2] = w;
    if (which == SQUARE)
        shapes_disc_core(2 * c[0] / b->m - 1, 2 * c[1] / b->m - 1, at);
    else if (which < 4)
        shapes_disc_ring(which, 2 * c[0] / b->m - 1, c[1] / b->ring, 90 * (which + c[0] / b->m - 0.5), at);
    else {
        double from = angle_at(radius, down), to = angle_at(radius, b->centre - b->height), t = c[1] / b->up,
               angle = from + t * (1 + GRADING * (1 - t)) * (to - from);
        foot = c[1] > 0 ? radius * real_sin(angle) : foot;
        at[2] = c[1] <= 0 ? w : c[1] >= b->up ? b->height : b->centre - radius * real_cos(angle);
        shapes_disc_turn(90 * (c[0] / b->m - 0.5), at);
    }
    at[0] *= foot;
    at[1] *= foot;
}

static void blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct bowl *b = ARENA_TAKE(a, struct bowl, 1);
    double foot = q->length[FOOT] / 2;
    *b = (struct bowl){.height = q->length[HEIGHT], .thickness = q->length[THICKNESS]};
    sphere(q, &b->centre, &b->radius);
    double way = b->radius * (angle_at(b->radius, b->centre - b->height) - angle_at(b->radius, b->centre));
    b->m = shapes_kinds_cells(q, REAL_PI / 4 * q->length[DIAMETER],
                              q->fineness + 1); /* at the rim, where the waves are shortest */
    b->ring = shapes_kinds_cells(q, foot / 2, (q->fineness + 1) / 2);
    b->layers = shapes_kinds_across(q, b->thickness);
    b->up = shapes_kinds_cells(q, 0.85 * way, 2 * q->fineness);
    *s = (struct shapes_blocks){.place = place, .shape = b, .size = fmax(2 * b->radius, b->height)};
    shapes_blocks_add(s, SQUARE, b->m, b->m, b->layers)->side[2][0] = "foot";
    for (int i = 0; i < 4; i++)
        shapes_blocks_add(s, i, b->m, b->ring, b->layers)->side[2][0] = "foot";
    shapes_blocks_add(s, WALL, 4 * b->m, b->up, b->layers)->side[1][1] = "rim";
}

static bool check(struct shapes_ask *q, struct err *e)
{
    double *length = q->length, centre, radius, t = length[THICKNESS], f;
    if (isnan(length[FOOT])) length[FOOT] = length[DIAMETER] / 3;
    f = length[FOOT] / 2;
    if (length[FOOT] >= 0.95 * length[DIAMETER])
        return err_set(e, ERR_USAGE, "the bowl's foot is %g m and must be below 0.95 of its diameter, %g m",
                       length[FOOT], length[DIAMETER]);
    sphere(q, &centre, &radius);
    double down = centre - t, up = length[HEIGHT] - centre,
           inside = (radius - t) * (radius - t); /* squared radii of the inner foot and rim must be left */
    return (t <= 0.5 * length[HEIGHT] && t <= 0.5 * radius && inside - down * down > 0.04 * f * f &&
            inside - up * up > 0.01 * length[DIAMETER] * length[DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "thickness is %g m, too much for a bowl %g m high, %g m wide at the rim and %g m at the foot", t,
                   length[HEIGHT], length[DIAMETER], length[FOOT]);
}

const struct shapes_kind shapes_bowl = {"bowl", {"diameter", "height", "thickness", "foot"}, 3, 4, 29000, check,
                                        blocks};

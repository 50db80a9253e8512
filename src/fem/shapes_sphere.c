/* A ball: a cube of m^3 cells inside, its faces bulged, and six caps of m^2 cells between them and the sphere; hollow:
   the caps alone. A cap's directions are (1, tan(a pi/4), tan(b pi/4)), a and b in
   [-1, 1], so that its lines are as far apart in angle; the bulge is half of the smooth map of the cube onto the ball x
   sqrt(1 - y^2/2 - z^2/2 + y^2 z^2/3). */
#include <math.h>

#include "fem/shapes_kinds.h"
#include "num/real.h"

enum { DIAMETER, WALL };

static const double inner = 0.45, bulge = 0.5; /* the cube's half side, of the radius; share of the ball in it */

struct ball {
    double radius, wall; /* wall 0: solid */
    int m, layers;
};

static void cube(const struct ball *b, const double p[3], double at[3])
{
    for (int i = 0; i < 3; i++) {
        double y = p[(i + 1) % 3] * p[(i + 1) % 3], z = p[(i + 2) % 3] * p[(i + 2) % 3];
        at[i] = b->radius * inner * p[i] * (1 - bulge + bulge * sqrt(1 - y / 2 - z / 2 + y * z / 3));
    }
}

/* Caps 0 to 5: +x -x +y -y +z -z. */
static void cap(const struct ball *b, int which, const double c[3], double at[3])
{
    int d = which / 2;
    double sign = which % 2 ? -1 : 1, u = 2 * c[0] / b->m - 1, v = 2 * c[1] / b->m - 1, low[3], p[3] = {0};
    p[d] = sign;
    p[(d + 1) % 3] = u;
    p[(d + 2) % 3] = v;
    cube(b, p, low);
    p[(d + 1) % 3] = real_tan(u * REAL_PI / 4);
    p[(d + 2) % 3] = real_tan(v * REAL_PI / 4);
    double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), t = c[2] / b->layers;
    for (int i = 0; i < 3; i++) {
        double out = p[i] / length;
        at[i] = b->wall > 0 ? out * (b->radius - (1 - t) * b->wall) : (1 - t) * low[i] + t * b->radius * out;
    }
}

static void place(const void *shape, int which, const double c[3], double at[3])
{
    const struct ball *b = shape;
    if (which < 6)
        cap(b, which, c, at);
    else
        cube(b, (double[3]){2 * c[0] / b->m - 1, 2 * c[1] / b->m - 1, 2 * c[2] / b->m - 1}, at);
}

static void blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct ball *b = ARENA_TAKE(a, struct ball, 1);
    *b = (struct ball){.radius = q->length[DIAMETER] / 2, .wall = isnan(q->length[WALL]) ? 0 : q->length[WALL]};
    b->m = shapes_kinds_cells(q, REAL_PI / 2 * b->radius, q->fineness < 2 ? 2 : q->fineness);
    b->layers = shapes_kinds_across(q, b->wall > 0 ? b->wall : (1 - inner) * b->radius);
    *s = (struct shapes_blocks){.place = place, .shape = b, .size = 2 * b->radius};
    if (b->wall == 0) shapes_blocks_add(s, 6, b->m, b->m, b->m);
    for (int i = 0; i < 6; i++)
        shapes_blocks_add(s, i, b->m, b->m, b->layers);
}

/* Through and through, half of the nodes are within 0.1 % for the 60 lowest modes. */
static bool check(struct shapes_ask *q, struct err *e)
{
    q->nodes *= isnan(q->length[WALL]) ? 0.55 : 1;
    return !(q->length[WALL] >= 0.49 * q->length[DIAMETER]) ||
           err_set(
               e, ERR_USAGE,
               "wall is %g m, and at most 0.49 of the diameter, %g m, makes a hollow sphere; without wall= it is solid",
               q->length[WALL], q->length[DIAMETER]);
}

const struct shapes_kind shapes_sphere = {"sphere", {"diameter", "wall"}, 1, 3, 18000, check, blocks};

/* See shapes_kinds.h. The unit disc, of which round solids are swept, is a square of m x m cells, its sides bulged,
   and four rings of cells between its sides and the circle. */
#include "fem/shapes_kinds.h"

#include <math.h>

#include "num/real.h"

/* The bulge is a share of the smooth map of the square onto the disc, x sqrt(1 - y^2/2): the
 * square's corners then keep clear angles. */

static const double disc_inner = 0.5,
                    disc_rounding = 0.5; /* half side, of the radius; share of the disc in the square */

static void disc_core(double a, double b, double p[2])
{
    p[0] = disc_inner * a * (1 - disc_rounding + disc_rounding * sqrt(1 - b * b / 2));
    p[1] = disc_inner * b * (1 - disc_rounding + disc_rounding * sqrt(1 - a * a / 2));
}

/* (cos, sin) of degrees, exact at multiples of 90. */
static void cos_sin(double degrees, double p[2])
{
    double turn = degrees / 180;
    turn -= 2 * floor(turn / 2);
    p[0] = real_cospi(turn);
    p[1] = real_sinpi(turn);
}

/* Beside side 0 to 3 (+x, +y, -x, -y): along it from -1 to 1 counterclockwise, out from 0 (the square) to 1 (the
 * circle, at the angle given, degrees). */
static void disc_ring(int side, double along, double out, double angle, double p[2])
{
    static const double corner[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    double core[2], circle[2];
    const double *n = corner[side % 4];
    disc_core(n[0] - n[1] * along, n[1] + n[0] * along, core);
    cos_sin(angle, circle);
    for (int i = 0; i < 2; i++)
        p[i] = (1 - out) * core[i] + out * circle[i];
}

/* Cells along a length, at least so many. */
static int cells(const struct shapes_ask *q, double length, int least)
{
    double n = rint(length / q->cell);
    return n < least ? least : n > 1e6 ? 1000000 : (int)n;
}

/* Cells through a thickness: one at fineness 1 and 2, two at 3 and 4, three above; more where it is thick. */
static int cells_across(const struct shapes_ask *q, double thickness)
{
    return cells(q, thickness, (q->fineness + 1) / 2);
}

/* A box: x in [0, length], y in [0, width], z in [0, thickness]. Cells are about square in the plane. */

struct box {
    double size[3];
    int n[3];
};

static void box_place(const void *shape, int which, const double c[3], double at[3])
{
    (void)which;
    const struct box *b = shape;
    for (int i = 0; i < 3; i++)
        at[i] = b->size[i] * (c[i] / b->n[i]);
}

/* At least so many cells in each direction. */
static void box_blocks(const struct shapes_ask *q, const int least[3], struct arena *a, struct shapes_blocks *s)
{
    static const char *const names[3][2] = {{"x0", "x1"}, {"y0", "y1"}, {"z0", "z1"}};
    struct box *b = ARENA_TAKE(a, struct box, 1);
    *s = (struct shapes_blocks){.place = box_place, .shape = b};
    for (int i = 0; i < 3; i++) {
        b->size[i] = q->length[i];
        b->n[i] = cells(q, q->length[i], least[i]);
        s->size = fmax(s->size, b->size[i]);
    }
    struct shapes_block *k = shapes_blocks_add(s, 0, b->n[0], b->n[1], b->n[2]);
    for (int i = 0; i < 6; i++)
        k->side[i / 2][i % 2] = names[i / 2][i % 2];
}

static void plate_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    int across = (q->fineness + 1) / 2;
    box_blocks(q, (int[3]){across, across, across}, a, s);
}

static void bar_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    box_blocks(q, (int[3]){4 * q->fineness, q->fineness, q->fineness}, a, s);
}

static const struct shapes_kind plate = {"plate", {"length", "width", "thickness"}, 3, 3, 18000, NULL, plate_blocks};
static const struct shapes_kind bar = {"bar", {"length", "width", "thickness"}, 3, 3, 11000, NULL, bar_blocks};

/* A round rod along x: a section of a square inside and rings round it, swept; a tube: layers round the axis. */

enum { ROD_LENGTH, ROD_DIAMETER, ROD_WALL };
enum { ROD_SQUARE = 4, TUBE };

struct rod {
    double length, radius, wall;
    int m, layers, along; /* cells: side of the square (a quarter round), outwards, along x */
};

static void rod_place(const void *shape, int which, const double c[3], double at[3])
{
    const struct rod *r = shape;
    double p[2], scale = r->radius;
    if (which == ROD_SQUARE)
        disc_core(2 * c[0] / r->m - 1, 2 * c[1] / r->m - 1, p);
    else if (which == TUBE) {
        cos_sin(90 * c[0] / r->m, p);
        scale = r->radius - (1 - c[1] / r->layers) * r->wall;
    } else
        disc_ring(which, 2 * c[0] / r->m - 1, c[1] / r->layers, 90 * (which + c[0] / r->m - 0.5), p);
    at[0] = r->length * (c[2] / r->along);
    at[1] = scale * p[0];
    at[2] = scale * p[1];
}

static void rod_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct rod *r = ARENA_TAKE(a, struct rod, 1);
    *r = (struct rod){.length = q->length[ROD_LENGTH],
                      .radius = q->length[ROD_DIAMETER] / 2,
                      .wall = isnan(q->length[ROD_WALL]) ? 0 : q->length[ROD_WALL]};
    r->m = cells(q, REAL_PI / 2 * r->radius, r->wall > 0 ? q->fineness + 1 : q->fineness);
    r->layers = cells_across(q, r->wall > 0 ? r->wall : r->radius / 2);
    r->along = cells(q, r->length, q->fineness);
    *s = (struct shapes_blocks){.place = rod_place, .shape = r, .size = fmax(r->length, 2 * r->radius)};
    if (r->wall > 0)
        shapes_blocks_add(s, TUBE, 4 * r->m, r->layers, r->along);
    else {
        shapes_blocks_add(s, ROD_SQUARE, r->m, r->m, r->along);
        for (int i = 0; i < 4; i++)
            shapes_blocks_add(s, i, r->m, r->layers, r->along);
    }
    for (int i = 0; i < s->n; i++) {
        s->block[i].side[2][0] = "x0";
        s->block[i].side[2][1] = "x1";
    }
}

static bool rod_check(struct shapes_ask *q, struct err *e)
{
    return !(q->length[ROD_WALL] >= 0.49 * q->length[ROD_DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "wall is %g m, and at most 0.49 of the diameter, %g m, makes a tube; without wall= the rod is solid",
                   q->length[ROD_WALL], q->length[ROD_DIAMETER]);
}

static const struct shapes_kind rod_kind = {"rod", {"length", "diameter", "wall"}, 2, 3, 13000, rod_check, rod_blocks};

/* A flat ring round the z axis, z in [0, thickness]. */

enum { RING_DIAMETER, RING_WIDTH, RING_THICKNESS };

struct ring {
    double radius, width, thickness;
    int round, across, up; /* cells */
};

static void ring_place(const void *shape, int which, const double c[3], double at[3])
{
    (void)which;
    const struct ring *r = shape;
    double radius = r->radius - (1 - c[1] / r->across) * r->width;
    cos_sin(360 * c[0] / r->round, at);
    at[0] *= radius;
    at[1] *= radius;
    at[2] = r->thickness * (c[2] / r->up);
}

static void ring_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct ring *r = ARENA_TAKE(a, struct ring, 1);
    *r = (struct ring){
        .radius = q->length[RING_DIAMETER] / 2, .width = q->length[RING_WIDTH], .thickness = q->length[RING_THICKNESS]};
    r->round = 4 * cells(q, REAL_PI / 2 * (r->radius - r->width / 2), q->fineness + 1);
    r->across = cells_across(q, r->width);
    r->up = cells_across(q, r->thickness);
    *s = (struct shapes_blocks){.place = ring_place, .shape = r, .size = fmax(2 * r->radius, r->thickness)};
    struct shapes_block *b = shapes_blocks_add(s, 0, r->round, r->across, r->up);
    b->side[2][0] = "z0";
    b->side[2][1] = "z1";
}

static bool ring_check(struct shapes_ask *q, struct err *e)
{
    return !(q->length[RING_WIDTH] > 0.49 * q->length[RING_DIAMETER]) ||
           err_set(e, ERR_USAGE, "width is %g m, and at most 0.49 of the diameter, %g m, leaves a hole in the ring",
                   q->length[RING_WIDTH], q->length[RING_DIAMETER]);
}

static const struct shapes_kind ring_kind = {"ring",     {"diameter", "width", "thickness"}, 3, 3, 11000, ring_check,
                                             ring_blocks};

/* A bowl: outside, a disc of the foot's diameter at z = 0 and above it the sphere through its edge and the rim's,

     z_c = ((diameter/2)^2 + height^2 - (foot/2)^2) / (2 height),   R^2 = (foot/2)^2 + z_c^2

   inside, the same z = thickness and radius R - thickness, so that the wall is as thick everywhere; the rim is cut flat
   at z = height. A layer at w of the thickness (0 outside) is the sphere of radius R - w from z = w, where it meets the
   foot's disc, up to z = height, in steps of its angle that shrink towards the rim, where the waves are: the last is
   0.6 of their mean, the first 1.4. */

enum { BOWL_DIAMETER, BOWL_HEIGHT, BOWL_THICKNESS, FOOT };
enum { BOWL_SQUARE = 4, BOWL_WALL };

#define GRADING 0.4

struct bowl {
    double height, thickness, centre, radius; /* of the sphere */
    int m, ring, layers, up;                  /* cells: a quarter round, the foot's ring, through, from foot to rim */
};

static void sphere(const struct shapes_ask *q, double *centre, double *radius)
{
    double d = q->length[BOWL_DIAMETER] / 2, f = q->length[FOOT] / 2, h = q->length[BOWL_HEIGHT];
    *centre = (d * d + h * h - f * f) / (2 * h);
    *radius = sqrt(f * f + *centre * *centre);
}

/* Angle from the bottom at which a sphere round z = centre reaches z, rad. */
static double angle_at(double radius, double down)
{
    return real_atan2(sqrt(fmax(radius * radius - down * down, 0)), down);
}

static void bowl_place(const void *shape, int which, const double c[3], double at[3])
{
    const struct bowl *b = shape;
    double w = b->thickness * (c[2] / b->layers), radius = b->radius - w, down = b->centre - w,
           foot = sqrt(fmax(radius * radius - down * down, 0));
    at[2] = w;
    if (which == BOWL_SQUARE)
        disc_core(2 * c[0] / b->m - 1, 2 * c[1] / b->m - 1, at);
    else if (which < 4)
        disc_ring(which, 2 * c[0] / b->m - 1, c[1] / b->ring, 90 * (which + c[0] / b->m - 0.5), at);
    else {
        double from = angle_at(radius, down), to = angle_at(radius, b->centre - b->height), t = c[1] / b->up,
               angle = from + t * (1 + GRADING * (1 - t)) * (to - from);
        foot = c[1] > 0 ? radius * real_sin(angle) : foot;
        at[2] = c[1] <= 0 ? w : c[1] >= b->up ? b->height : b->centre - radius * real_cos(angle);
        cos_sin(90 * (c[0] / b->m - 0.5), at);
    }
    at[0] *= foot;
    at[1] *= foot;
}

static void bowl_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct bowl *b = ARENA_TAKE(a, struct bowl, 1);
    double foot = q->length[FOOT] / 2;
    *b = (struct bowl){.height = q->length[BOWL_HEIGHT], .thickness = q->length[BOWL_THICKNESS]};
    sphere(q, &b->centre, &b->radius);
    double arc = b->radius * (angle_at(b->radius, b->centre - b->height) - angle_at(b->radius, b->centre));
    b->m = cells(q, REAL_PI / 4 * q->length[BOWL_DIAMETER],
                 q->fineness + 1); /* at the rim, where the waves are shortest */
    b->ring = cells(q, foot / 2, (q->fineness + 1) / 2);
    b->layers = cells_across(q, b->thickness);
    b->up = cells(q, 0.85 * arc, 2 * q->fineness);
    *s = (struct shapes_blocks){.place = bowl_place, .shape = b, .size = fmax(2 * b->radius, b->height)};
    shapes_blocks_add(s, BOWL_SQUARE, b->m, b->m, b->layers)->side[2][0] = "foot";
    for (int i = 0; i < 4; i++)
        shapes_blocks_add(s, i, b->m, b->ring, b->layers)->side[2][0] = "foot";
    shapes_blocks_add(s, BOWL_WALL, 4 * b->m, b->up, b->layers)->side[1][1] = "rim";
}

static bool bowl_check(struct shapes_ask *q, struct err *e)
{
    double *length = q->length, centre, radius, t = length[BOWL_THICKNESS], f;
    if (isnan(length[FOOT])) length[FOOT] = length[BOWL_DIAMETER] / 3;
    f = length[FOOT] / 2;
    if (length[FOOT] >= 0.95 * length[BOWL_DIAMETER])
        return err_set(e, ERR_USAGE, "the bowl's foot is %g m and must be below 0.95 of its diameter, %g m",
                       length[FOOT], length[BOWL_DIAMETER]);
    sphere(q, &centre, &radius);
    double down = centre - t, up = length[BOWL_HEIGHT] - centre,
           inside = (radius - t) * (radius - t); /* squared radii of the inner foot and rim must be left */
    return (t <= 0.5 * length[BOWL_HEIGHT] && t <= 0.5 * radius && inside - down * down > 0.04 * f * f &&
            inside - up * up > 0.01 * length[BOWL_DIAMETER] * length[BOWL_DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "thickness is %g m, too much for a bowl %g m high, %g m wide at the rim and %g m at the foot", t,
                   length[BOWL_HEIGHT], length[BOWL_DIAMETER], length[FOOT]);
}

static const struct shapes_kind bowl_kind = {
    "bowl", {"diameter", "height", "thickness", "foot"}, 3, 4, 29000, bowl_check, bowl_blocks};

/* A ball: a cube of m^3 cells inside, its faces bulged, and six caps of m^2 cells between them and the sphere; hollow:
   the caps alone. A cap's directions are (1, tan(a pi/4), tan(b pi/4)), a and b in
   [-1, 1], so that its lines are as far apart in angle; the bulge is half of the smooth map of the cube onto the ball x
   sqrt(1 - y^2/2 - z^2/2 + y^2 z^2/3). */

enum { SPHERE_DIAMETER, SPHERE_WALL };

static const double sphere_inner = 0.45,
                    sphere_rounding = 0.5; /* the cube's half side, of the radius; share of the ball in it */

struct ball {
    double radius, wall; /* wall 0: solid */
    int m, layers;
};

static void cube(const struct ball *b, const double p[3], double at[3])
{
    for (int i = 0; i < 3; i++) {
        double y = p[(i + 1) % 3] * p[(i + 1) % 3], z = p[(i + 2) % 3] * p[(i + 2) % 3];
        at[i] = b->radius * sphere_inner * p[i] *
                (1 - sphere_rounding + sphere_rounding * sqrt(1 - y / 2 - z / 2 + y * z / 3));
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

static void sphere_place(const void *shape, int which, const double c[3], double at[3])
{
    const struct ball *b = shape;
    if (which < 6)
        cap(b, which, c, at);
    else
        cube(b, (double[3]){2 * c[0] / b->m - 1, 2 * c[1] / b->m - 1, 2 * c[2] / b->m - 1}, at);
}

static void sphere_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct ball *b = ARENA_TAKE(a, struct ball, 1);
    *b = (struct ball){.radius = q->length[SPHERE_DIAMETER] / 2,
                       .wall = isnan(q->length[SPHERE_WALL]) ? 0 : q->length[SPHERE_WALL]};
    b->m = cells(q, REAL_PI / 2 * b->radius, q->fineness < 2 ? 2 : q->fineness);
    b->layers = cells_across(q, b->wall > 0 ? b->wall : (1 - sphere_inner) * b->radius);
    *s = (struct shapes_blocks){.place = sphere_place, .shape = b, .size = 2 * b->radius};
    if (b->wall == 0) shapes_blocks_add(s, 6, b->m, b->m, b->m);
    for (int i = 0; i < 6; i++)
        shapes_blocks_add(s, i, b->m, b->m, b->layers);
}

/* Through and through, half of the nodes are within 0.1 % for the 60 lowest modes. */
static bool sphere_check(struct shapes_ask *q, struct err *e)
{
    q->nodes *= isnan(q->length[SPHERE_WALL]) ? 0.55 : 1;
    return !(q->length[SPHERE_WALL] >= 0.49 * q->length[SPHERE_DIAMETER]) ||
           err_set(
               e, ERR_USAGE,
               "wall is %g m, and at most 0.49 of the diameter, %g m, makes a hollow sphere; without wall= it is solid",
               q->length[SPHERE_WALL], q->length[SPHERE_DIAMETER]);
}

static const struct shapes_kind sphere_kind = {"sphere",     {"diameter", "wall"}, 1, 3, 18000,
                                               sphere_check, sphere_blocks};

/* A mug: a disc for a bottom, a wall round it, and a handle in the x-z plane at +x: a strip of square section that
   leaves the wall's outside at z = height/4 and 3/4 height at a right angle, and whose middle line is half a circle
   between them. The wall's lattice lines are drawn so that the strip's ends are whole cells of it; the ends' bend round
   the wall fades out along the bow. */

enum { MUG_DIAMETER, MUG_HEIGHT, MUG_WALL, BOTTOM, HANDLE };
enum { MUG_SQUARE = 4, ROUND, BOW };
enum { STEPS = 6 };

struct mug {
    double radius, height, wall, bottom, handle;
    int m, p, ring, layers, under, up, bow; /* cells: a quarter round, handle's side, bottom's ring, through the wall,
                                               the bottom, up the wall, along the bow */
    double z[STEPS + 1];                    /* heights between which lattice lines are as far apart, ... */
    int line[STEPS + 1];                    /* ... and the lines there */
    int steps;
};

/* Degrees of a lattice line, counted from the middle of the handle. */
static double angle(const struct mug *g, double line)
{
    double all = 4. * g->m, half = g->p / 2., edge;
    if (line > all / 2) return 360 - angle(g, all - line);
    if (g->p == 0) return 360 * line / all;
    edge = 180 / REAL_PI * real_atan2(g->handle / 2, sqrt(g->radius * g->radius - g->handle * g->handle / 4));
    return line <= half ? edge * line / half : edge + (180 - edge) * (line - half) / (all / 2 - half);
}

static double signed_angle(const struct mug *g, double line) { return line < 0 ? -angle(g, -line) : angle(g, line); }

static double height_of(const struct mug *g, double line)
{
    int i = 0;
    while (i < g->steps - 1 && line > g->line[i + 1])
        i++;
    return g->z[i] + (g->z[i + 1] - g->z[i]) * ((line - g->line[i]) / (g->line[i + 1] - g->line[i]));
}

/* c: across (in y), across (outwards on the bow), along the bow from above. */
static void bow(const struct mug *g, const double c[3], double at[3])
{
    double side[2], turn[2], arc = 0.25 * g->height + g->handle * (c[1] / g->p - 0.5);
    cos_sin(signed_angle(g, c[0] - g->p / 2.), side);
    cos_sin(180 * c[2] / g->bow, turn);
    at[0] = g->radius + arc * turn[1] + (1 - turn[1]) * g->radius * (side[0] - 1);
    at[1] = g->radius * side[1];
    at[2] = g->height / 2 + arc * turn[0];
}

static void mug_place(const void *shape, int which, const double c[3], double at[3])
{
    const struct mug *g = shape;
    double scale = g->radius - g->wall;
    if (which == BOW) {
        bow(g, c, at);
        return;
    }
    at[2] = g->bottom * (c[2] / g->under);
    if (which == MUG_SQUARE)
        disc_core(2 * c[0] / g->m - 1, 2 * c[1] / g->m - 1, at);
    else if (which == ROUND) {
        cos_sin(signed_angle(g, c[0] - g->m / 2.), at);
        scale += g->wall * (c[1] / g->layers);
        at[2] = height_of(g, c[2]);
    } else
        disc_ring(which, 2 * c[0] / g->m - 1, c[1] / g->ring, signed_angle(g, which * g->m + c[0] - g->m / 2.), at);
    at[0] *= scale;
    at[1] *= scale;
}

static void step(struct mug *g, double z, int cells)
{
    g->steps++;
    g->z[g->steps] = z;
    g->line[g->steps] = g->line[g->steps - 1] + cells;
}

static void steps_up(const struct shapes_ask *q, struct mug *g)
{
    double half = g->handle / 2, low = g->height / 4, high = 3 * g->height / 4;
    step(g, g->bottom, g->under);
    if (g->p > 0) {
        step(g, low - half, cells(q, low - half - g->bottom, 1));
        step(g, low + half, g->p);
        step(g, high - half, cells(q, high - low - g->handle, 1));
        step(g, high + half, g->p);
        step(g, g->height, cells(q, g->height - high - half, 1));
    } else
        step(g, g->height, cells(q, g->height - g->bottom, 2 * q->fineness));
    g->up = g->line[g->steps];
}

static void add(const struct mug *g, struct shapes_blocks *s)
{
    struct shapes_block *b = shapes_blocks_add(s, ROUND, 4 * g->m, g->layers, g->up);
    b->side[2][0] = "bottom";
    b->side[2][1] = "rim";
    shapes_blocks_add(s, MUG_SQUARE, g->m, g->m, g->under)->side[2][0] = "bottom";
    for (int i = 0; i < 4; i++)
        shapes_blocks_add(s, i, g->m, g->ring, g->under)->side[2][0] = "bottom";
    if (g->p > 0) {
        b = shapes_blocks_add(s, BOW, g->p, g->p, g->bow);
        for (int i = 0; i < 4; i++)
            b->side[i / 2][i % 2] = "handle";
    }
}

static void mug_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct mug *g = ARENA_TAKE(a, struct mug, 1);
    *g = (struct mug){.radius = q->length[MUG_DIAMETER] / 2,
                      .height = q->length[MUG_HEIGHT],
                      .wall = q->length[MUG_WALL],
                      .bottom = q->length[BOTTOM],
                      .handle = q->length[HANDLE]};
    g->m = cells(q, REAL_PI / 2 * (g->radius - g->wall / 2), q->fineness + 1);
    if (g->handle > 0) {
        g->p = cells(q, g->handle, (q->fineness + 1) / 2);
        g->m += (g->m + g->p) % 2;
        g->m += g->m <= g->p ? 2 : 0;
        g->bow = cells(q, REAL_PI * g->height / 4, 3 * q->fineness);
    }
    g->ring = cells(q, (g->radius - g->wall) / 2, (q->fineness + 1) / 2);
    g->layers = cells_across(q, g->wall);
    g->under = cells_across(q, g->bottom);
    steps_up(q, g);
    *s = (struct shapes_blocks){.place = mug_place, .shape = g, .size = fmax(2 * g->radius, g->height)};
    add(g, s);
}

static bool mug_check(struct shapes_ask *q, struct err *e)
{
    double *d = q->length;
    d[BOTTOM] = isnan(d[BOTTOM]) ? d[MUG_WALL] : d[BOTTOM];
    d[HANDLE] = isnan(d[HANDLE]) ? d[MUG_DIAMETER] / 10 : d[HANDLE];
    if (d[MUG_WALL] > 0.25 * d[MUG_DIAMETER])
        return err_set(e, ERR_USAGE, "wall is %g m, and a mug's is at most a quarter of the diameter, %g m",
                       d[MUG_WALL], d[MUG_DIAMETER]);
    if (d[BOTTOM] > 0.5 * d[MUG_HEIGHT])
        return err_set(e, ERR_USAGE, "bottom is %g m, and a mug's is at most half the height, %g m", d[BOTTOM],
                       d[MUG_HEIGHT]);
    if (d[HANDLE] == 0) return true;
    double room = fmin(d[MUG_HEIGHT] / 4 - d[BOTTOM], d[MUG_HEIGHT] / 4);
    return (d[HANDLE] / 2 <= 0.8 * room && d[HANDLE] <= 0.5 * d[MUG_DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "a handle %g m thick does not fit a mug %g m high and %g m wide; give a smaller handle=, or "
                   "handle=0 for none",
                   d[HANDLE], d[MUG_HEIGHT], d[MUG_DIAMETER]);
}

static const struct shapes_kind mug_kind = {
    "mug", {"diameter", "height", "wall", "bottom", "handle"}, 3, 4, 20000, mug_check, mug_blocks};

const struct shapes_kind *const shapes_kinds[SHAPES_KINDS + 1] = {&plate,     &bar,         &rod_kind, &ring_kind,
                                                                  &bowl_kind, &sphere_kind, &mug_kind};

/* A mug: a disc for a bottom, a wall round it, and a handle in the x-z plane at +x: a strip of square section that
   leaves the wall's outside at z = height/4 and 3/4 height at a right angle, and whose middle line is half a circle
   between them. The wall's lattice lines are drawn so that the strip's ends are whole cells of it; the ends' bend round
   the wall fades out along the bow. */
#include <math.h>

#include "fem/shapes_disc.h"
#include "fem/shapes_kinds.h"
#include "num/real.h"

enum { DIAMETER, HEIGHT, WALL, BOTTOM, HANDLE };
enum { SQUARE = 4, ROUND, BOW };
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
    double side[2], turn[2], way = 0.25 * g->height + g->handle * (c[1] / g->p - 0.5);
    shapes_disc_turn(signed_angle(g, c[0] - g->p / 2.), side);
    shapes_disc_turn(180 * c[2] / g->bow, turn);
    at[0] = g->radius + way * turn[1] + (1 - turn[1]) * g->radius * (side[0] - 1);
    at[1] = g->radius * side[1];
    at[2] = g->height / 2 + way * turn[0];
}

static void place(const void *shape, int which, const double c[3], double at[3])
{
    const struct mug *g = shape;
    double scale = g->radius - g->wall;
    if (which == BOW) {
        bow(g, c, at);
        return;
    }
    at[2] = g->bottom * (c[2] / g->under);
    if (which == SQUARE)
        shapes_disc_core(2 * c[0] / g->m - 1, 2 * c[1] / g->m - 1, at);
    else if (which == ROUND) {
        shapes_disc_turn(signed_angle(g, c[0] - g->m / 2.), at);
        scale += g->wall * (c[1] / g->layers);
        at[2] = height_of(g, c[2]);
    } else
        shapes_disc_ring(which, 2 * c[0] / g->m - 1, c[1] / g->ring, signed_angle(g, which * g->m + c[0] - g->m / 2.),
                         at);
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
        step(g, low - half, shapes_kinds_cells(q, low - half - g->bottom, 1));
        step(g, low + half, g->p);
        step(g, high - half, shapes_kinds_cells(q, high - low - g->handle, 1));
        step(g, high + half, g->p);
        step(g, g->height, shapes_kinds_cells(q, g->height - high - half, 1));
    } else
        step(g, g->height, shapes_kinds_cells(q, g->height - g->bottom, 2 * q->fineness));
    g->up = g->line[g->steps];
}

static void add(const struct mug *g, struct shapes_blocks *s)
{
    struct shapes_block *b = shapes_blocks_add(s, ROUND, 4 * g->m, g->layers, g->up);
    b->side[2][0] = "bottom";
    b->side[2][1] = "rim";
    shapes_blocks_add(s, SQUARE, g->m, g->m, g->under)->side[2][0] = "bottom";
    for (int i = 0; i < 4; i++)
        shapes_blocks_add(s, i, g->m, g->ring, g->under)->side[2][0] = "bottom";
    if (g->p > 0) {
        b = shapes_blocks_add(s, BOW, g->p, g->p, g->bow);
        for (int i = 0; i < 4; i++)
            b->side[i / 2][i % 2] = "handle";
    }
}

static void blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    struct mug *g = ARENA_TAKE(a, struct mug, 1);
    *g = (struct mug){.radius = q->length[DIAMETER] / 2,
                      .height = q->length[HEIGHT],
                      .wall = q->length[WALL],
                      .bottom = q->length[BOTTOM],
                      .handle = q->length[HANDLE]};
    g->m = shapes_kinds_cells(q, REAL_PI / 2 * (g->radius - g->wall / 2), q->fineness + 1);
    if (g->handle > 0) {
        g->p = shapes_kinds_cells(q, g->handle, (q->fineness + 1) / 2);
        g->m += (g->m + g->p) % 2;
        g->m += g->m <= g->p ? 2 : 0;
        g->bow = shapes_kinds_cells(q, REAL_PI * g->height / 4, 3 * q->fineness);
    }
    g->ring = shapes_kinds_cells(q, (g->radius - g->wall) / 2, (q->fineness + 1) / 2);
    g->layers = shapes_kinds_across(q, g->wall);
    g->under = shapes_kinds_across(q, g->bottom);
    steps_up(q, g);
    *s = (struct shapes_blocks){.place = place, .shape = g, .size = fmax(2 * g->radius, g->height)};
    add(g, s);
}

static bool check(struct shapes_ask *q, struct err *e)
{
    double *d = q->length;
    d[BOTTOM] = isnan(d[BOTTOM]) ? d[WALL] : d[BOTTOM];
    d[HANDLE] = isnan(d[HANDLE]) ? d[DIAMETER] / 10 : d[HANDLE];
    if (d[WALL] > 0.25 * d[DIAMETER])
        return err_set(e, ERR_USAGE, "wall is %g m, and a mug's is at most a quarter of the diameter, %g m", d[WALL],
                       d[DIAMETER]);
    if (d[BOTTOM] > 0.5 * d[HEIGHT])
        return err_set(e, ERR_USAGE, "bottom is %g m, and a mug's is at most half the height, %g m", d[BOTTOM],
                       d[HEIGHT]);
    if (d[HANDLE] == 0) return true;
    double room = fmin(d[HEIGHT] / 4 - d[BOTTOM], d[HEIGHT] / 4);
    return (d[HANDLE] / 2 <= 0.8 * room && d[HANDLE] <= 0.5 * d[DIAMETER]) ||
           err_set(e, ERR_USAGE,
                   "a handle %g m thick does not fit a mug %g m high and %g m wide; give a smaller handle=, or "
                   "handle=0 for none",
                   d[HANDLE], d[HEIGHT], d[DIAMETER]);
}

const struct shapes_kind shapes_mug = {"mug", {"diameter", "height", "wall", "bottom", "handle"}, 3, 4, 20000, check,
                                       blocks};

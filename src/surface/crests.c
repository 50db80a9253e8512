/* See crests.h. Two memories of blocks on lattices through 0, each made from the one before when it is asked for:

     heights   z of the surface at multiples of d = h / finer, read every 2 d, and between by Taylor's formula. In one coordinate crest_part.c
               keeps them, at a pitch of their own
     crests    E at multiples of h = patch / 4

   Errors. In one coordinate those of crest.c. In the plane the ball touches between samples too: E is too low by at most d^2/8 (1/R + |z''|) at the places of contact (in each direction;
   Taylor's formula adds d^3/17 |z'''|). */
#include "surface/crests.h"

#include <math.h>

#include "surface/envelope.h"

enum { LINE = 1024, CREST = 32, READ = 64, EIGHT = 8 };

struct crests {
    const struct relief *under;
    struct rolling_plan plan;
    double h, d;            /* m; d: of the plane */
    double least, most;     /* m, of the heights read so far */
    bool warned;
    long reach;             /* in d */
    struct grid heights;
    struct envelope *envelope; /* of the plane */
    struct relief line;     /* the envelope in one coordinate */
};

/* ------------------------------------------------------------------ heights */

static void heights_watch(struct crests *w, const double *z, long n)
{
    for (long i = 0; i < n; i++) {
        w->least = fmin(w->least, z[i]);
        w->most = fmax(w->most, z[i]);
    }
    if (!w->warned && w->most - w->least > w->plan.span) {
        w->warned = true;
        if (w->plan.exceeded)
            w->plan.exceeded(w->plan.self);
    }
}

/* Reading is most of the work, and parts work out all derivatives anyway: one point is read for each square of 2 x 2 heights, in
   its middle, and they are its Taylor polynomial of second degree. 64 points are read at a time, in a square, as parts that keep a patch of
   coefficients like it. */
static void heights_fill(void *self, long column, long row, double *out)
{
    struct crests *w = self;
    double x[READ], y[READ], z[READ], zx[READ], zy[READ], xx[READ], xy[READ], yy[READ], s = w->d / 2;
    long side = w->heights.side[0], first_x = column * side, first_y = row * side;
    for (long at = 0; at < side * side / (2 * EIGHT * 2 * EIGHT); at++) {
        long left = at % (side / (2 * EIGHT)) * 2 * EIGHT, below = at / (side / (2 * EIGHT)) * 2 * EIGHT;
        for (long k = 0; k < READ; k++) {
            x[k] = ((double)(first_x + left + 2 * (k % EIGHT)) + 0.5) * w->d;
            y[k] = ((double)(first_y + below + 2 * (k / EIGHT)) + 0.5) * w->d;
        }
        relief_at(w->under, &(struct relief_points){READ, x, y}, &(struct relief_values){z, zx, zy, xx, xy, yy});
        for (long k = 0; k < READ; k++) {
            double *to = out + (below + 2 * (k / EIGHT)) * side + left + 2 * (k % EIGHT);
            double even = z[k] + 0.5 * s * s * (xx[k] + yy[k]), cross = s * s * xy[k], a = s * zx[k], b = s * zy[k];
            to[0] = even + cross - (a + b);
            to[1] = even - cross + (a - b);
            to[side] = even - cross - (a - b);
            to[side + 1] = even + cross + (a + b);
        }
    }
    heights_watch(w, out, side * side);
}

/* ------------------------------------------------------------------ crests */

long crests_side(const struct rolling_plan *p)
{
    return (CREST - 1) * p->finer + 1 + 2 * (long)ceil(p->reach / (p->patch / ROLLING_PER_PATCH / p->finer));
}

static void crests_square(void *self, long column, long row, double *out)
{
    struct crests *w = self;
    long finer = w->plan.finer, side = crests_side(&w->plan), stride;
    double *heights = envelope_heights(w->envelope, &stride);
    grid_gather(&w->heights, (long[]){column * CREST * finer - w->reach, row * CREST * finer - w->reach}, (long[]){side, side}, heights, stride);
    envelope_prepare(w->envelope);
    for (long j = 0; j < CREST; j++)
        for (long i = 0; i < CREST; i++)
            out[j * CREST + i] = envelope_at(w->envelope, w->reach + i * finer, w->reach + j * finer);
}

struct crest_plan crests_line(const struct rolling_plan *p)
{
    return (struct crest_plan){p->radius, p->pitch, p->reach, p->span, p->points, p->exceeded, p->self};
}

static void crests_row(void *self, long column, long row, double *out)
{
    struct crests *w = self;
    double x[LINE];
    (void)row;
    for (long i = 0; i < LINE; i++)
        x[i] = (double)(column * LINE + i) * w->h;
    relief_at(&w->line, &(struct relief_points){LINE, x, NULL}, &(struct relief_values){.z = out});
}

/* ------------------------------------------------------------------ making */

/* Blocks held: of heights, what one block of crests needs, and as much again; of crests, what one of splines does, many times. */
static struct grid crests_plane(struct crests *w, struct arena *a)
{
    long side = crests_side(&w->plan);
    size_t across = (size_t)(side / READ + 2), needed = 2 * across * across;
    w->reach = (long)ceil(w->plan.reach / w->d);
    w->envelope = envelope_make(a, w->plan.radius, w->d, side, side);
    w->heights = (struct grid){kept_make(a, READ * READ, needed > 512 ? needed : 512, heights_fill, w), {READ, READ}};
    return (struct grid){kept_make(a, CREST * CREST, 1024, crests_square, w), {CREST, CREST}};
}

struct grid crests_make(struct arena *a, const struct relief *under, const struct rolling_plan *p)
{
    struct crests *w = ARENA_TAKE(a, struct crests, 1);
    struct crest_plan line = crests_line(p);
    double h = p->patch / ROLLING_PER_PATCH;
    *w = (struct crests){.under = under, .plan = *p, .h = h, .d = h / p->finer, .least = HUGE_VAL, .most = -HUGE_VAL};
    if (under->along == ALONG_PLANE)
        return crests_plane(w, a);
    w->line.along = ALONG_PATH;
    relief_add(&w->line, crest_part(a, under, &line));
    return (struct grid){kept_make(a, LINE, 64, crests_row, w), {LINE, 1}};
}

/* See crests.h. Two memories of blocks on lattices through 0, each made from the one before when it is asked for:

     heights   z of the surface at multiples of d = h / finer, read every 2 d, and between by Taylor's formula. In one
   coordinate crest_part.c keeps them, at a pitch of their own crests    E at multiples of h = patch / 4

   Errors. In one coordinate those of crest.c. In the plane the ball touches between samples too: E is too low by at
   most d^2/8 (1/R + |z''|) at the places of contact (in each direction; Taylor's formula adds d^3/17 |z'''|). */
#include "surface/crests.h"

#include <math.h>

#include "num/lanes.h"
#include "surface/envelope.h"

enum { LINE = 1024, CREST = 32, READ = 64, EIGHT = 8 };

struct crests {
    const struct relief *under;
    struct rolling_plan plan;
    double h, d;        /* m; d: of the plane */
    double least, most; /* m, of the heights read so far */
    bool warned;
    long reach; /* in d */
    struct grid heights;
    struct envelope *envelope; /* of the plane */
    struct relief line;        /* the envelope in one coordinate */
};

/* ------------------------------------------------------------------ heights */

/* The least and most of n numbers, a multiple of LANES. */
LANES_CLONES
static void extremes(const double *z, long n, double found[2])
{
    double least[LANES], most[LANES];
    for (int l = 0; l < LANES; l++)
        least[l] = most[l] = z[l];
    for (long i = LANES; i < n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            least[l] = lanes_select(z[i + l] < least[l], z[i + l], least[l]);
            most[l] = lanes_select(z[i + l] > most[l], z[i + l], most[l]);
        }
    found[0] = least[0];
    found[1] = most[0];
    for (int l = 1; l < LANES; l++) {
        found[0] = least[l] < found[0] ? least[l] : found[0];
        found[1] = most[l] > found[1] ? most[l] : found[1];
    }
}

static void heights_watch(struct crests *w, const double *z, long n)
{
    double found[2];
    extremes(z, n, found);
    w->least = fmin(w->least, found[0]);
    w->most = fmax(w->most, found[1]);
    if (!w->warned && w->most - w->least > w->plan.span) {
        w->warned = true;
        if (w->plan.exceeded) w->plan.exceeded(w->plan.self);
    }
}

struct reading {
    double z[READ], x[READ], y[READ], xx[READ], xy[READ], yy[READ];
};

/* Heights, `stride` to a row, of the 2 x 2 places about each of EIGHT x EIGHT points, s away from it in both
 * directions. */
LANES_CLONES
static void squares_put(const struct reading *r, double s, double *out, long stride)
{
    for (long j = 0; j < EIGHT; j++) {
        double *low = out + 2 * j * stride, *high = low + stride;
#pragma omp simd
        for (long i = 0; i < EIGHT; i++) {
            long k = j * EIGHT + i;
            double even = r->z[k] + 0.5 * s * s * (r->xx[k] + r->yy[k]), cross = s * s * r->xy[k], a = s * r->x[k],
                   b = s * r->y[k];
            low[2 * i] = even + cross - (a + b);
            low[2 * i + 1] = even - cross + (a - b);
            high[2 * i] = even - cross - (a - b);
            high[2 * i + 1] = even + cross + (a + b);
        }
    }
}

/* Parts work out all derivatives anyway: one point is read for each square of 2 x 2 heights, in its middle, and they
   are its Taylor polynomial of second degree. 64 points are read at a time, in a square of the lattice, as parts that
   keep patches of coefficients like it. */
static void heights_fill(void *self, long column, long row, double *out)
{
    struct crests *w = self;
    struct reading r;
    double x[READ], y[READ];
    long side = w->heights.side[0], first_x = column * side, first_y = row * side;
    for (long at = 0; at < side * side / (2 * EIGHT * 2 * EIGHT); at++) {
        long left = at % (side / (2 * EIGHT)) * 2 * EIGHT, below = at / (side / (2 * EIGHT)) * 2 * EIGHT;
        for (long k = 0; k < READ; k++) {
            x[k] = ((double)(first_x + left + 2 * (k % EIGHT)) + 0.5) * w->d;
            y[k] = ((double)(first_y + below + 2 * (k / EIGHT)) + 0.5) * w->d;
        }
        relief_at(w->under, &(struct relief_points){READ, x, y},
                  &(struct relief_values){r.z, r.x, r.y, r.xx, r.xy, r.yy});
        squares_put(&r, w->d / 2, out + below * side + left, side);
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
    grid_gather(&w->heights, (long[]){column * CREST * finer - w->reach, row * CREST * finer - w->reach},
                (long[]){side, side}, heights, stride);
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

/* Blocks held: of heights, what one block of crests needs, and as much again; of crests, what one of splines does, many
 * times. */
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
    if (under->along == ALONG_PLANE) return crests_plane(w, a);
    w->line.along = ALONG_PATH;
    relief_add(&w->line, crest_part(a, under, &line));
    return (struct grid){kept_make(a, LINE, 64, crests_row, w), {LINE, 1}};
}

/* A round tip: the surface is replaced by the way of a ball of radius R that slides over it without tilting, read by its lowest point,

     E(p) = max over |d| <= R of z(p + d) + sqrt(R^2 - |d|^2) - R

   the upper envelope (grey-scale dilation) that drives a rolling ball in papers/002, fig. 1 (there with the ball's centre, E + R). It has kinks
   where the ball comes to rest on the next asperity, on which a curvature limiter does not converge: no contact is a point, and E is smoothed by
   a Gaussian of standard deviation scraper.patch in m, in the coordinates that the surface follows. The rest, and its errors: surface/rolling.c.

   Departures. Along a path (or x) the surface is extruded and the ball a disc. The ball looks beyond the edge of a map, up to R, by
   surface.off_map; for `error` as `mirror` does.

   Heights are taken every patch / 4 or half the surface's finest scale, whichever is less, twice as densely in one coordinate, where it
   costs little, and accuracy.tip_heights times as densely in all; each doubling brings the force some 10 dB nearer (from 37 to 47 and 60 dB
   for a patch of 20 um on ridges, tests/unit/test_tip_accuracy.c). In one coordinate they are read as far as R; in the plane, where that
   would be most of the work, as far as sqrt(2 R H), beyond which nothing touches on a surface whose heights span H. For H, 16 384 places in the
   box of the motion are read, R (at most 1 mm) beyond it included; H is half as much again, or that span and the map's own together if that
   is more. Should heights turn up that span more, the render says so. */
#include "scene/rules.h"
#include "stage.h"
#include "surface/height_map.h"
#include "surface/relief.h"
#include "surface/rolling.h"
#include "trajectory/trajectory.h"

#include <math.h>

enum { SCOUTS = 16384, SCOUT_BATCH = 1024, SIDE_MOST = 2048 };
#define LINE_MOST (1L << 22) /* heights held at a time: 32 MB, as SIDE_MOST^2 are */

/* ------------------------------------------------------------------ how far heights span */

/* Additive recurrence with the plastic number, whose points fill a square evenly (Roberts 2018). */
static double share(long i, double step)
{
    double s = 0.5 + (double)i * step;
    return s - floor(s);
}

static double tip_scouted(const struct relief *r, const struct trajectory *tr, double beyond)
{
    double x[SCOUT_BATCH], y[SCOUT_BATCH], z[SCOUT_BATCH], least = HUGE_VAL, most = -HUGE_VAL;
    for (long first = 0; first < SCOUTS; first += SCOUT_BATCH) {
        for (long i = 0; i < SCOUT_BATCH; i++) {
            x[i] = tr->box[0][0] - beyond + share(first + i, 0.75487766624669276) * (tr->box[1][0] - tr->box[0][0] + 2 * beyond);
            y[i] = tr->box[0][1] - beyond + share(first + i, 0.56984029099805327) * (tr->box[1][1] - tr->box[0][1] + 2 * beyond);
        }
        relief_at(r, &(struct relief_points){SCOUT_BATCH, x, y}, &(struct relief_values){.z = z});
        for (long i = 0; i < SCOUT_BATCH; i++) {
            least = fmin(least, z[i]);
            most = fmax(most, z[i]);
        }
    }
    return most - least;
}

static double tip_map_span(const struct height_map *m)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t i = 0; m && i < m->columns * m->rows; i++) {
        least = fmin(least, m->z[i]);
        most = fmax(most, m->z[i]);
    }
    return most > least ? most - least : 0;
}

/* ------------------------------------------------------------------ the stage */

static void tip_exceeded(void *self)
{
    struct stage_run *r = self;
    board_warn(r->board, arena_format(r->arena, "%s: the surface is higher in places than its first look told; a round tip may have missed a "
                                      "peak at the edge of its reach", r->contact->name));
}

static struct rolling_plan tip_plan(struct stage_run *r, const struct relief *under)
{
    const struct scraper *s = &r->contact->scraper;
    bool plane = under->along == ALONG_PLANE;
    double coarse = s->patch / ROLLING_PER_PATCH, wanted = fmin(coarse, relief_finest(under) / 2) / (plane ? 1 : 2) / r->scene->accuracy.tip_heights;
    double finer = ceil(coarse / wanted * (1 - 1e-12));
    struct rolling_plan p = {.radius = s->radius, .patch = s->patch, .reach = s->radius, .span = HUGE_VAL, .exceeded = tip_exceeded, .self = r,
                             .finer = finer > 1 ? (int)fmin(finer, 1e6) : 1};
    if (!plane)
        return p;
    double scouted = tip_scouted(under, r->board->trajectory, fmin(s->radius, 1e-3)), map = tip_map_span(r->board->height_map);
    p.span = fmax(1.5 * scouted, scouted + map);
    p.reach = fmin(s->radius, sqrt(2 * s->radius * p.span));
    return p;
}

static bool tip_affordable(const struct stage_run *r, const struct rolling_plan *p, const struct relief *under, struct err *e)
{
    long size[2];
    rolling_size(p, under->along, size);
    bool plane = under->along == ALONG_PLANE, fine = relief_finest(under) / 2 < p->patch / ROLLING_PER_PATCH;
    if (size[0] <= (plane ? SIDE_MOST : LINE_MOST))
        return true;
    return err_set(e, ERR_SCENE,
                   "contact '%s': a tip of %g m radius reaches %g m over this surface, which is read every %g m: %ld x %ld heights at a time, and "
                   "at most %ld x %d are held; lower scraper.radius, or %s",
                   r->contact->name, p->radius, p->reach, p->patch / ROLLING_PER_PATCH / p->finer, size[0], size[1],
                   plane ? (long)SIDE_MOST : LINE_MOST, plane ? SIDE_MOST : 1,
                   fine ? "take a coarser surface (its finest scale decides)" : "raise scraper.patch (a quarter of it decides)");
}

static bool tip_open(struct stage_run *r, struct err *e)
{
    struct relief *relief = r->board->relief, *under = ARENA_TAKE(r->arena, struct relief, 1);
    relief_settle(relief, r->contact);
    *under = *relief;
    struct rolling_plan p = tip_plan(r, under);
    under->origin[0] = under->origin[1] = 0; /* the tip's own lattice lies in the surface's coordinates too */
    if (!tip_affordable(r, &p, under, e))
        return false;
    relief->first = NULL;
    relief_add(relief, rolling_part(r->arena, under, &p));
    return true;
}

static bool tip_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return !isnan(c->scraper.radius);
}

/* Measured: cycles per lattice point of path, along a line and for the strip that a path in the plane needs. Going over it again costs nothing. */
static double tip_work(const struct contact *c, const struct scene *s)
{
    const struct motion *m = &c->motion;
    double speed = rules_speed(m), dense = s->accuracy.tip_heights;
    double times = m->path == PATH_CIRCLE ? fabs(m->turns) : m->path == PATH_BACK_AND_FORTH ? 2 * m->rate * m->duration : 1;
    return speed / fmax(times, 1) / s->output.sample_rate / (c->scraper.patch / ROLLING_PER_PATCH) * (rules_along(c) == ALONG_PLANE ? 3e5 * dense * dense : 8e2 * dense);
}

const struct stage tip_stage = {
    .name = "tip",
    .does = "round tip: upper envelope of a ball, smoothed over the contact patch",
    .paper = "002 fig. 1",
    .idle = "no scraper.radius",
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = tip_wanted,
    .work = tip_work,
    .open = tip_open,
};

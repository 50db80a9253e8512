/* A round tip: the surface is replaced by the way of a ball of radius R that slides over it without tilting, read by
   its lowest point,

     E(p) = max over |d| <= R of z(p + d) + sqrt(R^2 - |d|^2) - R

   the upper envelope (grey-scale dilation) that drives a rolling ball in papers/002, fig. 1 (there with the ball's
   centre, E + R). It has kinks where the ball comes to rest on the next asperity, on which a curvature limiter does not
   converge: no contact is a point, and E is smoothed by a Gaussian of standard deviation scraper.patch (ball.patch) in
   m, in the coordinates that the surface follows. The rest, and its errors: surface/contact_patch.c. A ball whose
   flight and contact are computed (roll_coupled) needs no derivative, and takes E itself where ball.patch is 0
   (surface/rolling_envelope.c).

   Departures. Along a path (or x) the surface is extruded and the ball a disc. The ball looks beyond the edge of a map,
   up to R, by surface.off_map; for `error` as `mirror` does.

   In one coordinate smooth ground is read as polynomials of fifth degree between places (surface/rolling_envelope.c),
   and E is the ball's exact way over these. Of cubic splines (measured profiles, fractal ground) the places are the
   knots, and nothing is lost; else they lie as far apart as the surface's finest scale, accuracy.tip_heights times as
   densely: the force under a marble on wood is then off by -99 dB, and by -137 dB where it is 2. A surface with kinks
   is read by its heights alone: E then dips by d^2 / (8 R) between two of them, d apart, even on level ground; d is so
   small that this is a thousandth of the span H of heights, and a whole share of the kinks' pitch, so that they are
   met. In the plane heights are taken every patch / 4 or half the surface's finest scale, whichever is less, and
   accuracy.tip_heights times as densely, and the surface itself is read where the ball touches between them; each
   doubling brings the force 10 to 35 dB nearer (from 61 to 91 and 128 dB for a patch of 20 um on ridges,
   tests/unit/test_tip_accuracy.c).

   Heights are read as far as R; in the plane, where that would be most of the work, and in one coordinate where it is
   more than 65 536 of them, as far as sqrt(2 R H), beyond which nothing touches on a surface whose heights span H. For
   H, 16 384 places in the box of the motion are read, R (at most 1 mm) beyond it included; H is half as much again, or
   that span and the map's own together if that is more. Should heights turn up that span more, the render says so. */
#include <math.h>

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/contact_patch.h"
#include "surface/envelope.h"
#include "surface/height_map.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/motion.h"
#include "trajectory/trajectory.h"

#define TIP_DIP 1e-3 /* of the span of heights: what the way of a tip without a patch may dip between two of them */

enum { SCOUTS = 16384, SCOUT_BATCH = 1024, SIDE_MOST = 2048, LINE_MOST = 1 << 21, REACH_ALL = 65536 }; /* heights */

/* ------------------------------------------------------------------ how far heights span */

/* Additive recurrence with the plastic number, whose points fill a square evenly (Roberts 2018). */
static double share(long i, double step)
{
    double s = 0.5 + (double)i * step;
    return s - floor(s);
}

static double tip_scouted(const struct relief *r, const struct trajectory *tr, double beyond)
{
    double x[SCOUT_BATCH], y[SCOUT_BATCH], z[SCOUT_BATCH], box[2][2], least = HUGE_VAL, most = -HUGE_VAL;
    for (int k = 0; k < 2; k++) {
        box[k][0] = (r->along == ALONG_PATH ? tr->reach[k] : tr->box[k][0]) + (k ? beyond : -beyond);
        box[k][1] = tr->box[k][1] + (k ? beyond : -beyond);
    }
    for (long first = 0; first < SCOUTS; first += SCOUT_BATCH) {
        for (long i = 0; i < SCOUT_BATCH; i++) {
            double along = share(
                first + i, 0.75487766624669276); /* of one coordinate in rising order: parts are read cheaply so */
            x[i] = box[0][0] +
                   (r->along == ALONG_PLANE ? along : ((double)(first + i) + along) / SCOUTS) * (box[1][0] - box[0][0]);
            y[i] = box[0][1] + share(first + i, 0.56984029099805327) * (box[1][1] - box[0][1]);
        }
        relief_at(r, &(struct relief_points){SCOUT_BATCH, x, r->along == ALONG_PLANE ? y : NULL},
                  &(struct relief_values){.z = z});
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

/* ------------------------------------------------------------------ predicted work */

/* Cycles per metre of ground that the tip has not been over. In the plane (surface/contact_patch.c) a way of the ball
   that goes along an axis takes, every h = patch / 4,

     WIDE points of its envelope     POINT cycles of search each, and NODE for each square of heights that a square of
                                     its points looks at
     a row of heights d apart        over WIDE points' width, the reach on both sides, and a square's own side;
                                     HEIGHT cycles each, the surface's and its coefficients' in it

   and one that goes aslant |cos| + |sin| times as many squares. HEIGHT was fitted to 15 lines over roughness of 0.1 to
   10 um from 5 to 100 um on, under balls of 0.5 mm to 2 cm with patches of 5 to 100 um (one CPU with AVX-512;
   tests/bench/planned.py has other scenes). The reach is sqrt(2 R H), H 1.5 times what heights are likely to span. */
enum {
    SQUARE = ENVELOPE_POINTS,
    WIDE = 13 + 3 + 2 * 28 + SQUARE - 1
}; /* a block of splines, what their kernel reads beyond, and what a square of the envelope has too many */

#define POINT 2000
#define NODE 100
#define HEIGHT 45

/* m, between places where the ground under a tip without a patch is read. */
static double likely_pitch(const struct contact *c)
{
    double kinked = params_kinked_span(c),
           dips = kinked > 0 ? sqrt(8 * c->scraper.radius * TIP_DIP * kinked) : HUGE_VAL;
    return fmin(params_finest(c) / 4, dips);
}

/* |cos| + |sin| of the motion's heading; in the mean where it turns. */
static double aslant(const struct motion *m)
{
    double dx = fabs(m->to[0] - m->from[0]), dy = fabs(m->to[1] - m->from[1]), length = sqrt(dx * dx + dy * dy);
    return motion_straight(m) && length > 0 ? (dx + dy) / length : 4 / REAL_PI;
}

static double plane_metre(const struct contact *c, double dense)
{
    const struct scraper *s = &c->scraper;
    double h = s->patch / PATCH_POINTS, finer = ceil(h / fmin(h, params_finest(c) / 2) * dense * (1 - 1e-12)),
           d = h / finer;
    double reach = fmin(s->radius, sqrt(2 * s->radius * 1.5 * params_span(c)));
    struct rolling_plan p = {
        .radius = s->radius, .patch = s->patch, .reach = reach, .finer = finer > 1 ? (int)fmin(finer, 1e6) : 1};
    double across = (double)contact_patch_side(&p) / ENVELOPE_HEIGHTS + 1,
           envelope = WIDE * (POINT + NODE * across * across / (SQUARE * SQUARE));
    double heights = finer * (WIDE * finer + 2 * reach / d + ENVELOPE_HEIGHTS) * HEIGHT;
    return aslant(&c->motion) * (envelope + heights) / h;
}

/* ------------------------------------------------------------------ the stage */

static void tip_exceeded(void *self)
{
    struct stage_run *r = self;
    board_warn(
        r->board,
        arena_format(r->arena,
                     "%s: the surface is higher in places than its first look told; a round tip may have missed a "
                     "peak at the edge of its reach",
                     r->contact->name));
}

/* The ground is read no further apart than this, m. */
static double tip_wanted_pitch(const struct stage_run *r, const struct relief *under)
{
    double patch = r->contact->scraper.patch, finest = relief_finest(under) / 2,
           coarse = patch > 0 ? patch / PATCH_POINTS : finest;
    bool smooth = under->along != ALONG_PLANE && relief_kinks(under) == 0 && isfinite(finest);
    return (smooth ? 2 * finest : fmin(coarse, finest)) / r->scene->accuracy.tip_heights;
}

/* m: the pitch of a lattice through 0 on which all knots of a surface of cubic splines lie; 0: it is none, or they lie
 * on no such lattice. */
static double tip_knots(const struct relief *under)
{
    double knots = HUGE_VAL;
    for (const struct relief_part *p = under->first; p; p = p->next)
        knots = p->linear && p->pitch[0] > 0 ? fmin(knots, p->pitch[0]) : 0;
    for (const struct relief_part *p = under->first; p && knots > 0; p = p->next)
        if (fabs(remainder(p->pitch[0], knots)) > 1e-12 * p->pitch[0] ||
            fabs(remainder(p->origin[0], knots)) > 1e-9 * knots)
            return 0;
    return isfinite(knots) ? knots : 0;
}

/* In one coordinate. Of splines at their knots, which is exact; of what has kinks as the dip and these ask for. */
static double tip_pitch(const struct stage_run *r, const struct relief *under, const struct rolling_plan *p,
                        double scouted)
{
    double kinks = relief_kinks(under),
           dip = scouted > 0 ? sqrt(8 * p->radius * TIP_DIP * scouted) / r->scene->accuracy.tip_heights : HUGE_VAL;
    double knots = kinks > 0 ? kinks : tip_knots(under),
           most = knots > 0 && kinks == 0 ? p->radius : fmin(tip_wanted_pitch(r, under), p->radius);
    most = kinks > 0 ? fmin(most / 2, dip) : most;
    return knots > 0 ? knots / ceil(knots / most * (1 - 1e-12)) : most;
}

static struct rolling_plan tip_plan(struct stage_run *r, const struct relief *under)
{
    const struct scraper *s = &r->contact->scraper;
    bool plane = under->along == ALONG_PLANE;
    double wanted = tip_wanted_pitch(r, under),
           finer = s->patch > 0 ? ceil(s->patch / PATCH_POINTS / wanted * (1 - 1e-12)) : 1;
    bool look = plane || s->patch == 0 || relief_kinks(under) > 0 || s->radius > REACH_ALL * wanted / 2;
    double scouted = look ? tip_scouted(under, r->board->trajectory, fmin(s->radius, 1e-3)) : 0,
           map = tip_map_span(r->board->height_map);
    struct rolling_plan p = {.radius = s->radius,
                             .patch = s->patch,
                             .reach = s->radius,
                             .span = HUGE_VAL,
                             .exceeded = tip_exceeded,
                             .self = r,
                             .finer = finer > 1 ? (int)fmin(finer, 1e6) : 1,
                             .points = relief_kinks(under) > 0};
    p.pitch = plane ? p.patch / PATCH_POINTS / p.finer : tip_pitch(r, under, &p, scouted);
    if (!plane && p.reach / p.pitch <= REACH_ALL) return p;
    p.span = fmax(1.5 * scouted, scouted + map);
    p.reach = fmin(s->radius, sqrt(2 * s->radius * p.span));
    return p;
}

static bool tip_affordable(const struct stage_run *r, const struct rolling_plan *p, const struct relief *under,
                           struct err *e)
{
    bool plane = under->along == ALONG_PLANE,
         fine = !(relief_finest(under) / 2 >= p->patch / PATCH_POINTS && p->patch > 0);
    const char *tool = contact_tool(r->contact);
    long side = plane ? contact_patch_side(p) : rolling_envelope_window(p), most = plane ? SIDE_MOST : LINE_MOST;
    if (side <= most) return true;
    err_about(e, r->contact->name, contact_rolls(r->contact) ? "ball.radius" : "scraper.radius");
    return err_set(e, ERR_SCENE,
                   "contact '%s': a %s of %g m radius reaches %g m over this surface, which is read every %g m: %ld x "
                   "%ld heights at a time, and "
                   "at most %ld x %ld are held; lower %s.radius, or %s%s",
                   r->contact->name, contact_rolls(r->contact) ? "ball" : "tip", p->radius, p->reach, p->pitch, side,
                   plane ? side : 1, most, plane ? most : 1, tool,
                   fine ? "take a coarser surface (its finest scale decides)" : "raise ",
                   fine ? "" : arena_format(r->arena, "%s.patch (a quarter of it decides)", tool));
}

/* What has a patch of 0, a disc's own way, is read by its heights alone. */
static bool tip_smoothed(const struct stage_run *r, const struct relief *under, struct err *e)
{
    const struct contact *c = r->contact;
    if (c->scraper.patch > 0) return true;
    if (c->contact.model != CONTACT_ROLL_COUPLED)
        return err_set(
            e, ERR_SCENE,
            "contact '%s': %s.patch is 0, and only contact.model roll_coupled takes the rolling curve with its kinks; "
            "set it to the radius of the contact patch, for instance 20 um",
            c->name, contact_tool(c));
    return under->along != ALONG_PLANE || err_set(e, ERR_SCENE,
                                                  "contact '%s': ball.patch is 0, and a surface in the plane is rolled "
                                                  "over with a contact patch only; set ball.patch, for instance to "
                                                  "20 um, or surface.along to path or x",
                                                  c->name);
}

/* m of new surface per audio sample: going over it again costs nothing. */
static double fresh(const struct motion *m, double speed, double rate)
{
    double times = m->path == PATH_CIRCLE           ? fabs(m->turns)
                   : m->path == PATH_BACK_AND_FORTH ? 2 * m->rate * m->duration
                                                    : 1;
    return speed / fmax(times, 1) / rate;
}

/* Cycles of what is there already: 40 a point. */
static double read_again(const struct contact *c, const struct scene *s, double pitch)
{
    return 40 * relief_readings(c, s, pitch);
}

/* Cycles of a piece of ground in one coordinate, which is looked at twice, and of the patch's spline. */
#define PIECE 4000.0
#define PLAIN 300.0 /* a piece that is a point alone */
#define KNOT 300.0
#define LINE_POINTS 1024.0 /* of a block of the patch's splines */

static double tip_work(const struct contact *c, const struct scene *s)
{
    double length = fresh(&c->motion, motion_speed(&c->motion), s->output.sample_rate);
    double dense = s->accuracy.tip_heights, patch = c->scraper.patch;
    double metre = patch == 0                       ? 2e2 * dense / likely_pitch(c)
                   : relief_along(c) == ALONG_PLANE ? plane_metre(c, dense)
                                                    : 8e2 * dense / (patch / PATCH_POINTS);
    return read_again(c, s, patch > 0 ? patch / PATCH_POINTS : likely_pitch(c)) + (length > 0 ? length * metre : 0);
}

/* Now that the way is known. Ground is made in blocks: the shortest way takes one, and what is within reach of it. */
static double planned_work(const struct stage_run *r, const struct rolling_plan *p, bool plane)
{
    struct contact own = *r->contact;
    double h = own.scraper.patch / PATCH_POINTS, dense = r->scene->accuracy.tip_heights,
           metre = plane ? plane_metre(&own, dense) : (p->points ? PLAIN : PIECE) / p->pitch + (h > 0 ? KNOT / h : 0),
           block = plane ? WIDE * h + 2 * p->reach : (double)rolling_envelope_window(p) * p->pitch + LINE_POINTS * h;
    own.motion.made = r->board->trajectory;
    return read_again(&own, r->scene, h > 0 ? h : p->pitch) +
           metre * (fresh(&own.motion, motion_speed(&own.motion), r->board->rate) +
                    block / fmax((double)r->board->moving, 1));
}

static bool tip_open(struct stage_run *r, struct err *e)
{
    struct relief *relief = r->board->relief, *under = ARENA_TAKE(r->arena, struct relief, 1);
    relief_decide(relief, r->contact);
    *under = *relief;
    if (!tip_smoothed(r, under, e)) return false;
    struct rolling_plan p = tip_plan(r, under);
    under->origin[0] = under->origin[1] = 0; /* the tip's own lattice lies in the surface's coordinates too */
    if (!tip_affordable(r, &p, under, e)) return false;
    r->work = planned_work(r, &p, under->along == ALONG_PLANE);
    relief->first = NULL;
    relief->under = under;
    relief_add(relief,
               p.patch > 0 ? contact_patch_part(r->arena, under, &p) : rolling_envelope_part(r->arena, under, &p));
    return true;
}

static void tip_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    if (c->scraper.patch >= c->scraper.radius)
        scene_part_contradiction(p, "scraper.patch", "scraper.radius", "must be less than",
                                 "lower scraper.patch, or raise scraper.radius");
}

static bool scrapes(const struct contact *c) { return c->contact.model == CONTACT_SCRAPE; }

#define SCRAPES "contact.model=scrape|strike|given|impacts|playback"

static const struct key keys[] = {
    {ROW_NUMBER(contact, scraper.radius, "scraper.radius"), KEY_LENGTH, 1e-6, 1, "", SCRAPES,
     "radius of the tip: a scraper's follows the upper envelope of a sphere on the surface, and an impact's stiffness "
     "may follow from it; left out: a point",
     .shown = "1 mm"},
    {ROW_NUMBER(contact, scraper.patch, "scraper.patch"), KEY_LENGTH, 1e-7, 1e-3, "20 um", "scraper.radius",
     "radius of the contact patch: the envelope, which has kinks, is smoothed by a Gaussian of this standard "
     "deviation"},
    {.path = NULL}};

static const struct params tip_params = {.section = "scraper", .keys = keys, .check = tip_check, .given = scrapes};

static bool tip_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return relief_tipped(c);
}

const struct stage tip_stage = {
    .name = "tip",
    .params = &tip_params,
    .does = "round tip: upper envelope of a ball, smoothed over the contact patch",
    .paper = "002 fig. 1",
    .idle = "no scraper.radius or ball.radius, or contact.roll.follows is point",
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .knobs = KNOB_BIT(tip_heights),
    .wanted = tip_wanted,
    .work = tip_work,
    .open = tip_open,
};

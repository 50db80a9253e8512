/* See tip_work.h. In the plane (surface/rolling.c, crests.c) a way of the ball that goes along an axis takes, every h =
   patch / 4,

     WIDE points of its envelope     POINT cycles of search each, and GATHER for each of the heights that a block of
   CREST x CREST points looks at, over these a row of heights d apart        WIDE points' width, the reach on both
   sides, and a block's own side; HEIGHT cycles each, the surface's and its coefficients' in it

   and one that goes aslant |cos| + |sin| times as many blocks. Fitted to 15 lines over roughness of 0.1 to 10 um from 5
   to 100 um on, under balls of 0.5 mm to 2 cm with patches of 5 to 100 um, of 1.6e10 to 2.2e11 cycles a metre: within
   20 % of all (one CPU with AVX-512; tests/bench/planned.py has other scenes). The reach is sqrt(2 R H), H 1.5 times
   what heights are likely to span. */
#include "surface/tip_work.h"

#include <math.h>

#include "num/real.h"
#include "scene/rules.h"
#include "surface/crests.h"
#include "surface/reading.h"

enum {
    CREST = 32,
    BLOCK = 64,
    WIDE = 16 + 3 + 2 * 28 + CREST - 1
}; /* a block of splines, what their kernel reads beyond, and what a block of crests has too many */

#define POINT 1500
#define GATHER 3.5
#define HEIGHT 45

#define MAP_SPAN 20e-6 /* m, of any map */

/* m, the surface's finest scale, as far as the scene tells. */
static double likely_finest(const struct surface *s)
{
    double finest = s->height_map ? isnan(s->pitch) ? READING_MAP_PITCH : s->pitch : HUGE_VAL;
    finest = fmin(finest, s->roughness.given ? reading_roughness(&s->roughness) : HUGE_VAL);
    finest = fmin(finest, s->continuation.given ? s->continuation.shortest / 4 : HUGE_VAL);
    finest = fmin(finest, s->ridges.given ? s->ridges.spacing / 8 : HUGE_VAL);
    return fmin(finest, s->grit.given ? s->grit.diameter / 8 : HUGE_VAL);
}

/* m, between places where the ground under a tip without a patch is read. */
static double likely_pitch(const struct contact *c)
{
    const struct surface *s = &c->surface;
    double finest = likely_finest(s);
    if (!s->fractal.given) return finest / 4;
    return fmin(fmin(finest, s->fractal.pitch) / 4, sqrt(8 * c->scraper.radius * TIP_DIP * 2 * s->fractal.maximum));
}

/* m between the greatest and least height: of what is random 8 times the rms. */
static double likely_span(const struct surface *s)
{
    double span = s->height_map ? MAP_SPAN : 0;
    span += s->roughness.given ? 8 * (s->roughness.like ? MAP_SPAN / 8 : s->roughness.rms) : 0;
    span += s->ridges.given ? s->ridges.height * (1 + 4 * s->ridges.variation) : 0;
    return span + (s->grit.given ? s->grit.height * real_exp(4 * s->grit.spread) : 0);
}

/* |cos| + |sin| of the motion's heading; in the mean where it turns. */
static double aslant(const struct motion *m)
{
    double dx = fabs(m->to[0] - m->from[0]), dy = fabs(m->to[1] - m->from[1]), way = sqrt(dx * dx + dy * dy);
    return rules_straight(m) && way > 0 ? (dx + dy) / way : 4 / REAL_PI;
}

static double plane_metre(const struct contact *c, double dense)
{
    const struct scraper *s = &c->scraper;
    double h = s->patch / ROLLING_PER_PATCH,
           finer = ceil(h / fmin(h, likely_finest(&c->surface) / 2) * dense * (1 - 1e-12)), d = h / finer;
    double reach = fmin(s->radius, sqrt(2 * s->radius * 1.5 * likely_span(&c->surface)));
    struct rolling_plan p = {
        .radius = s->radius, .patch = s->patch, .reach = reach, .finer = finer > 1 ? (int)fmin(finer, 1e6) : 1};
    double side = (double)crests_side(&p), envelope = WIDE * (POINT + GATHER * side * side / (CREST * CREST));
    double heights = finer * (WIDE * finer + 2 * reach / d + BLOCK) * HEIGHT;
    return aslant(&c->motion) * (envelope + heights) / h;
}

/* Measured along a line: cycles per point of the lattice, or per place that is read. */
double tip_work_metre(const struct contact *c, double dense)
{
    double patch = c->scraper.patch;
    if (patch == 0) return 2e2 * dense / likely_pitch(c);
    return rules_along(c) == ALONG_PLANE ? plane_metre(c, dense) : 8e2 * dense / (patch / ROLLING_PER_PATCH);
}

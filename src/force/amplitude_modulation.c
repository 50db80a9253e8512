/* A sinusoidal modulation of the contact force, of whatever it is made,

     f_out(t) = (1 + m sin(2 pi nu t)) f_in(t)           papers/002 eq. 7; m: contact.modulation.depth
     nu = |v| / (2 pi R)                                 of contact.modulation.radius, eq. 8, which prints nu ~ v/R

   where nu follows the contact's speed, 2 pi nu t is the turn of what rolls, u/R, u the signed distance along the
   path: a ball that turns back turns its modulation back, too. Rath and Rocchesso, and Hermes, modulate the force of
   rolling so, since no ball is round and even; with contact.model: given and output.quantity: force it modulates a
   recorded sound (papers/002, section II-B). contact.impacts.modulation is another: of the impacts' amplitudes, from
   which their durations follow. Half a turn of a sine in which 1 - m would be below 0 does not occur: m <= 1. */
#include <math.h>
#include <string.h>

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/contact.h"

struct modulation {
    bool given;
    double depth, rate, radius; /* 1; Hz, NAN: 5; m, NAN: rate counts */
};

static const struct key keys[] = {
    {ROW_NUMBER(modulation, depth, "contact.modulation.depth"), KEY_NONE, 0, 1, "0.3", NULL,
     "m, by what share of itself the force swells and fades"},
    {ROW_NUMBER(modulation, rate, "contact.modulation.rate"), KEY_FREQUENCY, 1e-3, 1e4, "", NULL,
     "how often a second; 5 Hz where neither it nor a radius is given", .shown = "5 Hz"},
    {ROW_NUMBER(modulation, radius, "contact.modulation.radius"), KEY_LENGTH, 1e-4, 10, "", NULL,
     "once in each turn of a wheel of that radius, in place of a steady rate", .shown = "1 cm"},
    {.path = NULL}};

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct modulation *m = own;
    if (!isnan(m->radius) && c->motion.path == PATH_STILL && scene_part_known(p, "motion.path"))
        scene_part_refuse(p, "motion.path", "contact.modulation.radius",
                          "give contact.modulation.rate in place of radius, or let it move",
                          " is still and contact.modulation.radius is given: what does not move turns no wheel");
}

#define USUAL 5.0 /* Hz */

static double instead(const struct key *k, const void *owner)
{
    (void)owner;
    return strcmp(k->path, "contact.modulation.rate") == 0 ? USUAL : NAN;
}

static const struct params modulation_params = {
    .section = "contact.modulation",
    .meaning = "the force swells and fades as a sine, whatever it is made of (Conan et al. 2014a, equation 7)",
    .size = sizeof(struct modulation),
    .keys = keys,
    .alternative = {.most = 1, .paths = {"contact.modulation.rate", "contact.modulation.radius"}},
    .check = check,
    .instead = instead,
};

static bool modulation_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return params_given(c, &modulation_params);
}

static unsigned modulation_asks(const struct contact *c, const struct scene *s)
{
    const struct modulation *m = params_of(c, &modulation_params);
    (void)s;
    return isnan(m->radius) ? 0 : ITEM_BIT(ITEM_POSITION);
}

static bool modulation_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->state = (void *)params_of(r->contact, &modulation_params);
    return true;
}

static bool modulation_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    const struct modulation *m = r->state;
    bool turns = !isnan(m->radius);
    double rate = isnan(m->rate) ? USUAL : m->rate;
    const double *u = turns ? board_at(b, ITEM_POSITION, from) : NULL;
    double *force = board_at(b, ITEM_FORCE, from);
    (void)e;
    for (long n = from; n < to; n++)
        force[n - from] *= 1 + m->depth * (turns ? real_sin(u[(n - from) * b->over] / m->radius)
                                                 : real_sinpi(2 * rate * ((double)n / b->rate)));
    return true;
}

const struct stage amplitude_modulation_stage = {
    .name = "modulation",
    .does = "a sinusoidal modulation of the force",
    .paper = "002 eq. 7, 8",
    .idle = "no contact.modulation",
    .params = &modulation_params,
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_FORCE),
    .asks = modulation_asks,
    .wanted = modulation_wanted,
    .cycles = 50,
    .open = modulation_open,
    .run = modulation_run,
};

/* The stage that lays impacts on the board. The mean of a sub-interval is the momentum handed over in it, exactly
   (pulse.c), so that all of it arrives at any sample rate and oversampling, also when an impact is over within a
   fraction of a sub-interval. Times are counted from the sub-interval in which an impact begins: an hour into a scene
   they are as fine as at its start.

   The decimator spreads what is shorter than a sample to both sides, and folds what would come before the contact's
   start into the first samples (num/lead.h): an impact hands over all of its momentum wherever it begins. strike.first
   is 20 ms unless the scene says otherwise, so that output.ramp does not fade it in. */
#include <math.h>

#include "force/onset.h"
#include "force/strike.h"
#include "stage.h"
#include "trajectory/trajectory.h"

struct striking {
    struct strike_train train;
    struct strike_impact now;
    bool any;           /* `now` is still to come, or going on               */
    double from, after; /* number of the sub-interval in which it begins; when in it, 0 to 1 */
    double length;      /* sub-intervals                                     */
    double share;       /* of its momentum handed over so far                */
};

static void striking_next(struct striking *s, double per_second)
{
    s->any = strike_next(&s->train, &s->now);
    s->from = floor(s->now.start * per_second);
    s->after = s->now.start * per_second - s->from;
    s->length = s->now.lasts * per_second;
    s->share = 0;
}

static bool stage_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_STRIKE;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 4 * s->accuracy.oversampling;
}

/* Impacts that were asked for and do not take place. */
static void striking_told(struct stage_run *r, const struct strike_train *whole)
{
    struct strike_train s = *whole;
    struct strike_impact i;
    while (s.most > 0 && strike_next(&s, &i))
        continue;
    if (s.number < s.most)
        board_warn(r->board,
                   arena_format(r->arena, "contact '%s': %ld of %ld impacts take place: %s", r->contact->name, s.number,
                                s.most,
                                s.over == STRIKE_RESTS ? "what bounces has then come to rest"
                                                       : "the next one would not be over by the motion's end"));
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct striking *s = ARENA_TAKE(r->arena, struct striking, 1);
    if (!strike_make(r->contact, r->board->trajectory->duration, &s->train, e)) return false;
    striking_told(r, &s->train);
    onset_told(r, "the first impact", s->train.first);
    striking_next(s, r->board->rate * r->board->over);
    r->state = s;
    return true;
}

/* Momentum over sub-interval k times the sub-rate: its mean force. */
static double striking_mean(struct striking *s, double k, double per_second)
{
    double force = 0;
    while (s->any) {
        double q = (k + 1 - s->from - s->after) / s->length, share = pulse_share(&s->train.shape, q);
        force += s->now.momentum * per_second * (share - s->share);
        s->share = share;
        if (q < 1) break;
        striking_next(s, per_second);
    }
    return force;
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct striking *s = r->state;
    const struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from), first = (double)(from * b->over);
    (void)e;
    for (long i = 0; i < (to - from) * b->over; i++)
        force[i] =
            s->any && first + (double)i + 1 > s->from ? striking_mean(s, first + (double)i, b->rate * b->over) : 0;
    return true;
}

const struct stage strike_stage = {
    .name = "strike",
    .does = "contact force of impacts",
    .paper = "",
    .idle = "contact.model is not strike",
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = stage_wanted,
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};

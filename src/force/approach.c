/* The scraper is lowered at the start and raised at the end, so that contact does not begin with a click: the force of
   each sub-interval (of each B-spline, where the force is means by those) times the share at its middle to which the
   scraper is lowered (trajectory/load.h: a minimum-jerk step, 10 u^3 - 15 u^4 + 6 u^5, over load.approach and
   load.release). Papers/000 has no such thing: its sounds begin and end with a ramp of the whole. Under contact.gesture
   it comes after the low-pass, in gesture.c. */
#include "force/approach.h"

#include "force/gesture.h"
#include "trajectory/load.h"

void approach_warn(struct stage_run *r, const char *what, double at)
{
    const struct contact *c = r->contact;
    double ramp = r->scene->output.ramp;
    if (c->start + at < ramp)
        board_warn(
            r->board,
            arena_format(
                r->arena,
                "contact '%s': %s comes %.4g s after the scene's start and is faded in by output.ramp, %.4g s: let it "
                "come later, or shorten the ramp",
                c->name, what, c->start + at, ramp));
}

static bool approach_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return !gesture_follows(c) && (load_approach(c, false) > 0 || load_approach(c, true) > 0);
}

static double approach_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return s->accuracy.oversampling;
}

static bool approach_open(struct stage_run *r, struct err *e)
{
    struct load_law *l = ARENA_TAKE(r->arena, struct load_law, 1);
    r->state = l;
    if (load_approach(r->contact, true) > 0) r->ends = r->board->moving;
    if (r->board->load) *l = *r->board->load;
    return r->board->load || load_make(r->contact, r->board->trajectory, r->arena, l, e);
}

static bool approach_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct load_law *l = r->state;
    struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from), rate = b->rate * b->over, t = (double)from / b->rate,
           end = (double)to / b->rate;
    double middle = b->bspline ? 0 : 0.5;
    (void)e;
    if (t >= l->approach && end <= l->duration - l->release) return true;
    for (long i = 0; i < (to - from) * b->over; i++)
        force[i] *= load_lowered(l, ((double)(from * b->over + i) + middle) / rate);
    return true;
}

const struct stage approach_stage = {
    .name = "approach",
    .does = "the scraper (or ball) is lowered at the start and raised at the end",
    .paper = "",
    .idle = "the force begins and ends by itself, load.approach and load.release are 0, or contact.gesture does it",
    .needs = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = approach_wanted,
    .work = approach_work,
    .open = approach_open,
    .run = approach_run,
};

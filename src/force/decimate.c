/* From means over sub-intervals, or means weighted by linear B-splines (board->bspline), to samples of the force at the
   audio rate: a linear-phase low-pass that also undoes the means' droop (num/filter.h, filter_decimator). Delay is
   compensated: sample n is the force at n / rate.

   A smoothing of constant width before it (force/smooth.c) is joined to its kernel. Of the two together hardly more is
   left than of the Gaussian alone, since the long ends of a low-pass are those of its edge, where the Gaussian has let
   nothing through: at 4 sub-intervals a sample and 50 us 100 taps a sample in place of 349 and 4 times 117. One of
   varying width is joined the same way, to the kernels of a table of widths (num/spread.h): cycles a sample of both
   stages at 4 sub-intervals, scenes/basswood_scrape 538 -> 160, recorded 524 -> 190, circle 561 -> 190.

   What the kernel spreads to before frame 0 is folded into the first frames (num/filter.h), whatever the contact: the
   momentum of any force, the sum of the samples over the rate, is what the sub-intervals hold, within 2e-7 (the
   kernel's phases do not have quite the same sum). Contacts that start later than the scene begin as causally: nothing
   is heard of them before. */
#include <limits.h>
#include <string.h>

#include "base/stopwatch.h"
#include "force/given.h"
#include "force/smooth.h"
#include "num/filter.h"
#include "num/phases.h"
#include "stage.h"

static bool decimate_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model != CONTACT_GIVEN || given_is_table(c);
}

static double decimate_work(const struct contact *c, const struct scene *s)
{
    bool varies;
    double frames = smooth_sigma(c, &varies) * s->output.sample_rate, over = s->accuracy.oversampling;
    return (frames == 0 ? 19 : varies ? 33 + 4 * frames : 1 + 3.3 * frames) * over;
}

struct decimate {
    struct smooth *varying; /* a smoothing of varying width, which does all; NULL: none */
    struct phases kernel;
    bool smooths; /* one of constant width is joined */
    double *room; /* what phases_run needs */
    long leads;   /* frames before 0 that the kernel reaches */
    double *lead; /* [leads] what the first frames are raised by */
    double *head; /* what the kernel reads there: zeros, and the first `reach` inputs */
};

static void decimate_make(struct decimate *d, const struct filter *f, int over, struct arena *a)
{
    d->kernel = phases_make(a, f, over, STAGE_BLOCK);
    d->room = ARENA_TAKE(a, double, phases_room(&d->kernel));
    d->leads = f->reach / over + 2;
    d->lead = ARENA_TAKE(a, double, d->leads);
    d->head = ARENA_TAKE(a, double, (d->leads + 2) * over + f->taps + f->reach);
}

static bool decimate_open(struct stage_run *r, struct err *e)
{
    struct decimate *d = ARENA_TAKE(r->arena, struct decimate, 1);
    struct arena *scratch = arena_open();
    struct smoothing *s = r->board->smoothing;
    int over = r->board->over;
    struct filter f = r->board->bspline ? filter_decimator_bspline(scratch, over) : filter_decimator(scratch, over);
    (void)e;
    stopwatch_spend(60000 + 150.0 * f.taps);
    if (s) s->taken = d->smooths = true;
    d->varying = s ? s->varying : NULL;
    if (s && !d->varying) f = filter_joined(scratch, &s->kernel, &f);
    int reach = d->varying ? smooth_join(d->varying, &f, over, STAGE_BLOCK, r->arena) : f.reach;
    if (!d->varying) decimate_make(d, &f, over, r->arena);
    r->back = r->ahead = reach / over + 1;
    r->state = d;
    arena_close(scratch);
    return true;
}

/* Of the inputs x from frame 0 on. The kernel reads `reach` inputs to either side, and so from frame -leads on nothing
   but zeros and these. */
static void decimate_lead(struct decimate *d, const double *x)
{
    int over = d->kernel.each, reach = d->kernel.reach;
    memcpy(d->head + d->leads * over + reach, x, (size_t)reach * sizeof *x);
    for (long i = 0, n; i < d->leads; i += n) {
        n = d->leads - i < STAGE_BLOCK ? d->leads - i : STAGE_BLOCK;
        phases_run(&d->kernel, d->head + i * over, 0, LONG_MAX / 2, n, false, d->lead + i, d->room);
    }
    for (long i = 0, end = d->leads - 1; i < end; i++, end--) {
        double swap = d->lead[i];
        d->lead[i] = d->lead[end];
        d->lead[end] = swap;
    }
    filter_fold_lead(d->lead, d->leads, d->smooths ? 0 : 1);
}

static bool decimate_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct decimate *d = r->state;
    (void)e;
    if (d->varying) {
        smooth_spread(d->varying, r->board, to, to - from, board_at(r->board, ITEM_FORCE, from));
        return true;
    }
    if (from == 0) decimate_lead(d, board_at(r->board, ITEM_SUBFORCE, 0));
    for (long n; from < to; from += n) {
        double *force = board_at(r->board, ITEM_FORCE, from);
        n = to - from < STAGE_BLOCK ? to - from : STAGE_BLOCK;
        phases_run(&d->kernel, board_at(r->board, ITEM_SUBFORCE, from) - d->kernel.reach, 0, LONG_MAX / 2, n, false,
                   force, d->room);
        for (long i = from; i < from + n && i < d->leads; i++)
            force[i - from] += d->lead[i];
    }
    return true;
}

const struct stage decimate_stage = {
    .name = "decimate",
    .does = "force at the audio rate",
    .paper = "",
    .idle = "contact.given.file holds samples",
    .needs = ITEM_BIT(ITEM_SUBFORCE),
    .asks = smooth_joined_asks,
    .gives = ITEM_BIT(ITEM_FORCE),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = decimate_wanted,
    .work = decimate_work,
    .open = decimate_open,
    .run = decimate_run,
};

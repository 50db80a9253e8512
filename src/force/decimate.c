/* From means over sub-intervals, or means weighted by linear B-splines (board->bspline), to samples of the force at the
   audio rate: a linear-phase low-pass that also undoes the means' droop (num/filter.h, filter_decimator). Delay is
   compensated: sample n is the force at n / rate.

   A smoothing of constant width before it (force/smooth.c) is joined to its kernel. Of the two together hardly more is
   left than of the Gaussian alone, since the long ends of a low-pass are those of its edge, where the Gaussian has let
   nothing through: at 4 sub-intervals a sample and 50 us 100 taps a sample in place of 349 and 4 times 117. What is cut
   off is a twentieth of what the low-pass's gain is allowed to be off by.

   What the kernel spreads to before frame 0 is folded into the first frames (num/filter.h), whatever the contact: the
   momentum of any force, the sum of the samples over the rate, is what the sub-intervals hold, within 2e-7 (the
   kernel's phases do not have quite the same sum). Contacts that start later than the scene begin as causally: nothing
   is heard of them before. */
#include <string.h>

#include "base/stopwatch.h"
#include "force/given.h"
#include "force/smooth.h"
#include "num/filter.h"
#include "num/lanes.h"
#include "stage.h"

#define JOINED_LEFT 1e-7 /* of a sum of 1: -140 dB */

static bool decimate_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model != CONTACT_GIVEN || given_is_table(c);
}

static double decimate_work(const struct contact *c, const struct scene *s)
{
    double frames = smooth_still(c) * s->output.sample_rate, over = s->accuracy.oversampling;
    return (frames > 0 ? 1 + 3.3 * frames : 19) * over;
}

enum { WIDE = 4 * LANES }; /* outputs whose sums stay in registers */

struct decimate {
    int over, reach, taps; /* taps of each phase */
    double *tap;           /* [over][taps]: phase r has every over-th tap from tap r on, and zeros at the end */
    double *x;             /* [over][room]: every over-th input from input r on                                */
    long room;
    bool smooths; /* a smoothing is joined */
    long leads;   /* frames before 0 that the kernel reaches */
    double *lead; /* [leads] what the first frames are raised by */
    double *head; /* what the kernel reads there: zeros, and the first `reach` inputs */
};

static void decimate_phases(struct decimate *d, const struct filter *f, int over, struct arena *a)
{
    d->over = over;
    d->reach = f->reach;
    d->taps = (f->taps + over - 1) / over;
    d->room = STAGE_BLOCK + d->taps + WIDE;
    d->tap = ARENA_TAKE(a, double, d->taps *over);
    d->x = ARENA_TAKE(a, double, d->room *over);
    for (int i = 0; i < f->taps; i++)
        d->tap[i % over * d->taps + i / over] = f->tap[i];
    d->leads = f->reach / over + 2;
    d->lead = ARENA_TAKE(a, double, d->leads);
    d->head = ARENA_TAKE(a, double, (d->leads + d->taps + 1) * over + f->reach);
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
    if (s) {
        s->taken = true;
        f = filter_joined(scratch, &s->kernel, &f, JOINED_LEFT);
        d->smooths = true;
    }
    decimate_phases(d, &f, over, r->arena);
    r->back = r->ahead = d->reach / over + 1;
    r->state = d;
    arena_close(scratch);
    return true;
}

/* The inputs of n outputs, phase by phase. */
static void decimate_sort(const struct decimate *d, const double *x, long n)
{
    long each = n + d->taps;
    for (int r = 0; r < d->over; r++)
        for (long i = 0; i < each; i++)
            d->x[r * d->room + i] = x[i * d->over + r];
}

/* y[i] = sum over phases r and their taps k of tap[r][k] x[r][i + k], one addition after another; WIDE outputs at a
   time, so that inputs and taps are loaded once for all and no sum over lanes is left: with a sum over the lanes of
   each output it took half as long again. */
static void decimate_all(const struct decimate *d, double *y, long n)
{
    for (int r = 0; r < d->over; r++)
        smooth_taps(d->tap + r * d->taps, d->taps, d->x + r * d->room, n, r > 0, y);
}

/* Of the inputs x from frame 0 on. The kernel reads `reach` inputs to either side, and so from frame -leads on nothing
   but zeros and these. */
static void decimate_lead(struct decimate *d, const double *x)
{
    memcpy(d->head + d->leads * d->over + d->reach, x, (size_t)d->reach * sizeof *x);
    for (long i = 0, n; i < d->leads; i += n) {
        n = d->leads - i < STAGE_BLOCK ? d->leads - i : STAGE_BLOCK;
        decimate_sort(d, d->head + i * d->over, n);
        decimate_all(d, d->lead + i, n);
    }
    for (long i = 0, k = d->leads - 1; i < k; i++, k--) {
        double swap = d->lead[i];
        d->lead[i] = d->lead[k];
        d->lead[k] = swap;
    }
    filter_fold_lead(d->lead, d->leads, d->smooths ? 0 : 1);
}

static bool decimate_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct decimate *d = r->state;
    (void)e;
    if (from == 0) decimate_lead(d, board_at(r->board, ITEM_SUBFORCE, 0));
    for (long n; from < to; from += n) {
        double *force = board_at(r->board, ITEM_FORCE, from);
        n = to - from < STAGE_BLOCK ? to - from : STAGE_BLOCK;
        decimate_sort(d, board_at(r->board, ITEM_SUBFORCE, from) - d->reach, n);
        decimate_all(d, force, n);
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
    .gives = ITEM_BIT(ITEM_FORCE),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = decimate_wanted,
    .work = decimate_work,
    .open = decimate_open,
    .run = decimate_run,
};

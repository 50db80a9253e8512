/* The stage that lays a series of impacts on the board: f(t) = sum over n of A_n phi_n(t - T_n) (papers/002 equation 5,
   papers/004 equation 2), phi_n a raised cosine (pulse.h) that lasts t0_n. The mean of a sub-interval is the momentum
   handed over in it, exactly, by all impacts that touch it:

     mean = (1/h) sum over n of A_n t0_n / 2 (p((t + h - T_n) / t0_n) - p((t - T_n) / t0_n)),   h the sub-interval, p
       the share of pulse.h

   so that all momentum arrives at any sample rate and oversampling. Times are counted from the sub-interval in which an
   impact begins: an hour into a scene impacts have the same shapes as at its start.

   The series is drawn until its time is half the longest impact ahead of the block; what is not over waits in a queue,
   in the series' order. So the force does not depend on how frames fall into blocks, and the queue's length on the law
   alone. Of an impact that is under way at time 0 the rest takes place; one that is under way at the motion's end is
   faded by load.release, and without it goes on until it is over. */
#include <math.h>
#include <string.h>

#include "force/impact_series.h"
#include "force/pulse.h"

struct impact_waiting {
    double from, after; /* number of the sub-interval in which it begins; when in it, 0 to 1 */
    double length;      /* sub-intervals                                                     */
    double momentum;    /* N sub-intervals                                                   */
    double share;       /* of it handed over so far                                          */
};

struct impact_queue {
    struct impact_train train;
    struct impact_waiting *waiting;
    size_t n, room;
};

struct impact_block { /* the sub-intervals being filled */
    double first, end;
    double *force;
};

/* About how many impacts a second, from the keys alone: of papers/002 table I, and of the middle of the disk, some 200.
 */
static double stage_density(const struct impacts *m)
{
    if (m->prototype == PROTOTYPE_RUB) return 1 / m->rub.interval;
    if (m->prototype == PROTOTYPE_SCRATCH) return 1 / m->scratch.interval;
    return m->interval.mean > 0 ? 1 / m->interval.mean : 200;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    const struct impacts *m = impact_law_given(c);
    double rate = s->output.sample_rate, lasts = m->prototype == PROTOTYPE_RUB       ? m->rub.duration
                                                 : m->prototype == PROTOTYPE_SCRATCH ? m->scratch.duration
                                                                                     : 5e-4;
    return s->accuracy.oversampling +
           stage_density(m) / rate * (500 + 17 * (1 + lasts * rate * s->accuracy.oversampling));
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct impact_queue *q = ARENA_TAKE(r->arena, struct impact_queue, 1);
    r->state = q;
    q->room = 64;
    q->waiting = ARENA_TAKE(r->arena, struct impact_waiting, q->room);
    return impact_series_train(r, &q->train, e);
}

/* Room doubles: what the arena keeps of smaller ones is less than the last. */
static void queue_add(struct impact_queue *q, const struct impact_waiting *w, struct arena *a)
{
    if (q->n == q->room) {
        struct impact_waiting *more = ARENA_TAKE(a, struct impact_waiting, 2 * q->room);
        memcpy(more, q->waiting, q->n * sizeof *more);
        q->waiting = more;
        q->room *= 2;
    }
    q->waiting[q->n++] = *w;
}

/* Its share at the end of sub-interval k - 1. */
static double waiting_share(const struct impact_waiting *w, double k)
{
    return pulse_cosine((k - w->from - w->after) / w->length - 0.5);
}

/* Adds what it does in the block; true when it is over then. */
static bool waiting_lay(struct impact_waiting *w, const struct impact_block *b)
{
    double k = fmax(w->from, b->first), last = fmin(b->end, w->from + ceil(w->after + w->length) + 1),
           share[PULSE_COSINES];
    while (k < last && w->share < 1) {
        double *force = b->force + (long)(k - b->first);
        int n = (int)fmin(last - k, PULSE_COSINES);
        for (int i = 0; i < n; i++)
            share[i] = (k + (i + 1) - w->from - w->after) / w->length - 0.5;
        pulse_cosines(n, share);
        for (int i = 0; i < n; i++) {
            force[i] += w->momentum * (share[i] - w->share);
            w->share = share[i];
        }
        k += n;
    }
    return w->share >= 1;
}

static struct impact_waiting waiting_make(const struct impact *i, double per_second, double first)
{
    double begins = (i->time - 0.5 * i->duration) * per_second, from = floor(begins);
    struct impact_waiting w = {from, begins - from, i->duration * per_second,
                               0.5 * i->amplitude * i->duration * per_second, 0};
    if (from < first) /* only at the contact's start */
        w.share = waiting_share(&w, first);
    return w;
}

/* Those that have waited come first, in their order, then the new ones. */
static void queue_lay(struct impact_queue *q, const struct impact_block *b, double per_second, struct arena *a)
{
    size_t left = 0;
    for (size_t i = 0; i < q->n; i++)
        if (!waiting_lay(&q->waiting[i], b)) q->waiting[left++] = q->waiting[i];
    q->n = left;
    while (q->train.any && (q->train.next.time - 0.5 * q->train.law.longest) * per_second < b->end) {
        struct impact now = impact_series_take(&q->train);
        struct impact_waiting w = waiting_make(&now, per_second, b->first);
        if (!waiting_lay(&w, b)) queue_add(q, &w, a);
    }
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct impact_queue *q = r->state;
    struct board *b = r->board;
    long over = b->over;
    struct impact_block block = {(double)(from * over), (double)(to * over), board_at(b, ITEM_SUBFORCE, from)};
    (void)e;
    memset(block.force, 0, (size_t)((to - from) * over) * sizeof *block.force);
    queue_lay(q, &block, b->rate * (double)over, r->arena);
    return true;
}

static struct stage_report stage_reports(const struct stage_run *r, struct arena *a)
{
    const struct impact_queue *q = r->state;
    return impact_series_report(&q->train.report, a);
}

const struct stage impacts_stage = {
    .name = "impacts",
    .does = "contact force of a series of impacts drawn from its statistics",
    .paper = "002 eq. 5, 6, 9, 12, 13, 16, 17; 004 eq. 2 to 11",
    .idle = "contact.model is not impacts",
    .params = &impact_law_params,
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
    .report = stage_reports,
};

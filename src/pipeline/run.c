/* The runner. Stage k reads up to ahead_k frames beyond those it makes, so whatever makes its inputs must lead it by
   that much:

     offset(stage) = max over later stages c that read what it gives of offset(c) + ahead(c)

   and each call of run_block(to) runs every stage, in the order of the plan, up to frame to + offset. A signal holds
   the frames from offset(giver) back to the slowest reader's first. Every item that is given is checked to be
   finite. */
#include "pipeline/run.h"

#include <assert.h>
#include <fenv.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "num/lanes.h"
#include "num/real.h"
#include "pipeline/stages.h"
#include "response/listener.h"
#include "surface/relief.h"

/* The set of items that a stage reads. */
static unsigned run_reads(const struct stage_run *r)
{
    return r->stage->needs | r->stage->takes | (r->stage->asks ? r->stage->asks(r->contact, r->scene) : 0);
}

#define NO_SIGNALS (ITEM_BIT(ITEM_MOTION) | ITEM_BIT(ITEM_SURFACE) | ITEM_BIT(ITEM_TABLE) | ITEM_BIT(ITEM_LISTING))

/* Frames before its own that the slowest reader looks back to. */
static long run_behind(const struct run *r, enum item item)
{
    long behind = 0;
    for (int i = 0; i < r->n; i++)
        if (run_reads(&r->stages[i]) & ITEM_BIT(item) && r->stages[i].back > behind) behind = r->stages[i].back;
    return behind;
}

/* Frames that a signal must hold: from the first that a reader looks back to (all of them begin at frame 0) to the end
   of its giver's block. */
static void run_signal(struct run *r, enum item item)
{
    struct signal *s = &r->board.signals[item];
    long lead = 0, behind = run_behind(r, item);
    int per_frame = r->board.channels;
    if (ITEM_BIT(item) & NO_SIGNALS)
        per_frame = 0;
    else if (item == ITEM_ROLL)
        per_frame = ROLL_VALUES;
    else if (item == ITEM_FOLLOWED)
        per_frame = FOLLOWED_VALUES;
    else if (item <= ITEM_FORCE)
        per_frame = item < ITEM_FORCE ? r->board.over : 1;
    if (!(r->plan.alive & ITEM_BIT(item)) || !per_frame) return;
    for (int i = 0; i < r->n; i++)
        if (r->stages[i].stage->gives & ITEM_BIT(item) && r->stages[i].offset > lead) lead = r->stages[i].offset;
    s->per_frame = per_frame;
    s->first = -behind;
    s->capacity = behind + 2 * STAGE_BLOCK + lead + 1;
    s->x = ARENA_TAKE(r->arena, double, s->capacity *per_frame + 8);
}

#define OPENING 3000.0 /* cycles of any stage's */
#define BLOCK 300.0    /* a stage and block: its clock, its signals */

static bool run_open_stages(struct run *r, struct err *e)
{
    for (int i = 0; i < r->plan.n; i++) {
        const struct stage *st = r->plan.rows[i].stage;
        if (r->plan.rows[i].verdict != PLAN_RUNS) continue;
        struct stage_run *one = &r->stages[r->n];
        *one = (struct stage_run){.stage = st,
                                  .scene = r->scene,
                                  .contact = r->plan.contact,
                                  .board = &r->board,
                                  .arena = r->arena,
                                  .work = NAN,
                                  .works = LONG_MAX,
                                  .ends = LONG_MAX};
        size_t before = arena_bytes(r->arena);
        double start = stopwatch_cpu(), spent = stopwatch_cycles();
        r->board.n_stages = ++r->n;
        if (!st->open(one, e)) return false;
        one->seconds += stopwatch_cpu() - start; /* open may have put to it what was done for the stage before */
        one->opened = one->seconds;
        one->bytes = arena_bytes(r->arena) - before;
        stopwatch_spend(OPENING);
        one->once = stopwatch_cycles() - spent;
    }
    return true;
}

/* Until when each stage of a run need work. */

/* A finished tail costs nothing before the modes: a force is zero behind its motion, so that nobody need tell there
   where the contact is, what the surface is like, nor bring zeros down to the audio rate.

   What stage i gives is zero from frame zero(i) on: where it said so as it was opened (stage_run.ends), or, if it only
   spreads (stage.spreads), as far behind the end of what it reads as it reads. It is needed until limit(c) + ahead(c)
   of the readers c behind it in the plan. It works until limit(i), the lesser of the two. A stage that refines an item
   in place and says that zeros follow relies on what it no longer touches being zero: the givers before it stop with
   it. Measured on a glass plate scraped at draft, 28 s after the motion: 235 instructions a sample without limits, 121
   with them. */

static long later(long frame, long by) { return frame > LONG_MAX - by ? LONG_MAX : frame + by; }

static void find_zeros(struct run *r)
{
    long zero[ITEM_COUNT];
    for (int item = 0; item < ITEM_COUNT; item++)
        zero[item] = LONG_MAX;
    for (int i = 0; i < r->n; i++) {
        struct stage_run *st = &r->stages[i];
        long end = 0; /* of what it reads */
        for (int item = 0; item < ITEM_COUNT; item++)
            if (st->stage->needs & ITEM_BIT(item) && zero[item] > end) end = zero[item];
        st->limit = st->stage->spreads ? later(end, st->back + st->ahead + 1) : st->ends;
        for (int item = 0; item < ITEM_COUNT; item++)
            if (st->stage->gives & ITEM_BIT(item)) zero[item] = st->limit;
    }
}

/* Frames that readers want of what stage i gives; all, where something else than stages reads it. */
static long wanted_until(const struct run *r, int i)
{
    const struct stage *st = r->stages[i].stage;
    long until = 0;
    if (st->gives & (ITEM_BIT(ITEM_SOUND) | ITEM_BIT(ITEM_FORCE)) || !(st->gives & ~NO_SIGNALS)) return LONG_MAX;
    for (int k = i + 1; k < r->n; k++) {
        long last = later(r->stages[k].limit, r->stages[k].ahead + 1);
        if (run_reads(&r->stages[k]) & st->gives & ~NO_SIGNALS && last > until) until = last;
    }
    return until;
}

/* Sets the `limit` of all stages, which are open and have their leads (offset): the frame from which what a stage
   gives is zero, or is read by nobody. The runner makes zeros of it there. LONG_MAX: none is known. */
static void run_limits(struct run *r)
{
    find_zeros(r);
    for (int i = r->n - 1; i >= 0; i--) {
        long until = wanted_until(r, i);
        struct stage_run *by = &r->stages[i];
        if (until < by->limit) by->limit = until;
        unsigned refined = by->stage->gives & by->stage->needs & ~NO_SIGNALS;
        if (by->stage->spreads || by->limit != by->ends) continue;
        assert(!refined || by->ends == LONG_MAX || by->ahead == 0);
        for (int k = 0; k < i; k++) /* what gives the same before one that makes zeros of it stops */
            if (r->stages[k].stage->gives & refined && by->limit < r->stages[k].limit) r->stages[k].limit = by->limit;
    }
}

/* What the stages cost a sample, where they have not said so themselves, now that the motion is known; at this run's
 * knobs, which need not be the plan's. */
static void run_work(struct run *r)
{
    struct contact own = *r->plan.contact;
    own.motion.made = r->board.trajectory ? r->board.trajectory : own.motion.made;
    if (r->board.relief && isfinite(relief_finest(r->board.relief)))
        own.surface.finest = relief_finest(r->board.relief);
    for (int i = 0, k = 0; i < r->plan.n; i++) {
        if (r->plan.rows[i].verdict != PLAN_RUNS) continue;
        struct stage_run *st = &r->stages[k++];
        if (isnan(st->work)) st->work = r->plan.rows[i].work > 0 ? stages_work(st->stage, &own, r->scene) : 0;
    }
}

bool run_open(struct run *r, const struct plan *p, const struct scene *s, const struct run_sinks *sinks, struct err *e)
{
    static const struct run_sinks none = {NULL, NULL};
    const struct run_sinks *to = sinks ? sinks : &none;
    *r = (struct run){.scene = s, .plan = *p, .arena = arena_open()};
    r->board = (struct board){.rate = s->output.sample_rate,
                              .over = (int)s->accuracy.oversampling,
                              .channels = listener_channels(&s->output),
                              .alive = p->alive,
                              .quantity = -1,
                              .table = to->table,
                              .listing = to->listing};
    r->board.stages = r->stages = ARENA_TAKE(r->arena, struct stage_run, p->n);
    if (!run_open_stages(r, e)) {
        run_close(r);
        return false;
    }
    for (int i = r->n - 1; i >= 0; i--)
        for (int k = i + 1; k < r->n; k++)
            if (run_reads(&r->stages[k]) & r->stages[i].stage->gives) {
                long lead = r->stages[k].offset + r->stages[k].ahead;
                r->stages[i].offset = lead > r->stages[i].offset ? lead : r->stages[i].offset;
            }
    run_limits(r);
    run_work(r);
    for (int i = 0; i < ITEM_COUNT; i++)
        run_signal(r, (enum item)i);
    return true;
}

/* Makes room for frames up to `end` by dropping the oldest. What no stage has worked on for as long as the signal is
 * holds zeros already. */
static void signal_slide(struct signal *s, long end)
{
    long drop = end - (s->first + s->capacity);
    if (!s->per_frame || drop <= 0) return;
    if (s->worked <= s->first) {
        s->first += drop;
        return;
    }
    size_t dropped = (size_t)(drop * s->per_frame), all = (size_t)(s->capacity * s->per_frame);
    memmove(s->x, s->x + dropped, (all - dropped) * sizeof *s->x);
    memset(s->x + (all - dropped), 0, dropped * sizeof *s->x);
    s->first += drop;
}

/* In registers of the CPU's width and four sums that do not wait for each other: a sixth of the time, which was 10
 * cycles a frame of four sub-intervals. */
LANES_CLONES
static int all_finite(const double *x, long n)
{
    double sum[4][LANES] = {{0}}, all = 0; /* stay 0 unless some x is not finite */
    long i = 0;
    for (; i + 4 * LANES <= n; i += 4 * LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            sum[0][l] += x[i + l] * 0;
            sum[1][l] += x[i + LANES + l] * 0;
            sum[2][l] += x[i + 2 * LANES + l] * 0;
            sum[3][l] += x[i + 3 * LANES + l] * 0;
        }
    for (; i < n; i++)
        all += x[i] * 0;
    for (int l = 0; l < LANES; l++)
        all += sum[0][l] + sum[1][l] + sum[2][l] + sum[3][l];
    return all == 0;
}

static bool run_finite(const struct stage_run *r, long from, long to, struct err *e)
{
    for (int item = 0; item < ITEM_COUNT; item++) {
        const struct signal *s = &r->board->signals[item];
        if (!(r->stage->gives & ITEM_BIT(item)) || !s->per_frame) continue;
        const double *x = board_at(r->board, (enum item)item, from);
        if (!all_finite(x, (to - from) * s->per_frame))
            return err_set(e, ERR_NUMBERS, "contact '%s': stage '%s' made a %s that is not finite, at about %.6g s",
                           r->contact->name, r->stage->name, plan_item((enum item)item), (double)from / r->board->rate);
    }
    return true;
}

static bool traps;

void run_traps(void) { traps = true; }

static bool run_valid(const struct stage_run *r, long from, long to, struct err *e)
{
    int raised = fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    return !raised ||
           err_set(e, ERR_NUMBERS, "contact '%s': stage '%s' %s, between %.9g and %.9g s", r->contact->name,
                   r->stage->name,
                   raised & FE_OVERFLOW /* of which what has no result may follow */
                       ? "overflowed: lower the forces, heights or gains that make such numbers"
                       : raised & FE_DIVBYZERO ? "divided by 0, a fault of rasp's own"
                                               : "did an operation that has no result, a fault of rasp's own",
                   (double)from / r->board->rate, (double)to / r->board->rate);
}

/* The force rises from 0 where the run began (run_skip). */
static void run_fade(const struct stage_run *r, long from, long to)
{
    const long *fade = r->board->fade;
    if (from >= fade[1] || !(r->stage->gives & ~r->stage->needs & ITEM_BIT(ITEM_FORCE))) return;
    double *x = board_at(r->board, ITEM_FORCE, from);
    for (long n = from; n < to && n < fade[1]; n++) {
        double s = real_sinpi(0.5 * (double)(n - fade[0]) / (double)(fade[1] - fade[0]));
        x[n - from] *= s * s;
    }
}

/* *clock: CPU time when the stage before was done. A reading asks the system: two for each block were 2 % of a draft.
 */
static bool stage_block(struct stage_run *st, long to, double *clock, struct err *e)
{
    while (st->done < to) {
        long end = st->done + STAGE_BLOCK < to ? st->done + STAGE_BLOCK : to;
        for (int i = 0; i < ITEM_COUNT; i++)
            if (st->stage->gives & ITEM_BIT(i) && !(st->stage->needs & ITEM_BIT(i)))
                signal_slide(&st->board->signals[i], end + 1);
        if (st->done < st->limit) {
            long until = st->limit < end ? st->limit : end;
            for (int i = 0; i < ITEM_COUNT; i++)
                if (st->stage->gives & ITEM_BIT(i))
                    st->board->signals[i].worked = st->board->signals[i].first + st->board->signals[i].capacity;
            st->blocks++;
            if (traps) feclearexcept(FE_ALL_EXCEPT);
            if (!st->stage->run(st, st->done, until, e) || (traps && !run_valid(st, st->done, until, e)) ||
                !run_finite(st, st->done, until, e))
                return false;
            run_fade(st, st->done, until);
        }
        st->done = end;
        double now = stopwatch_cpu();
        st->seconds += now - *clock;
        *clock = now;
    }
    return true;
}

/* Spends what is predicted; of what reads the surface with what that has cost, as it is made where it is read. */
bool run_block(struct run *r, long to, struct err *e)
{
    double clock = stopwatch_cpu();
    bool ok = true;
    for (int i = 0; ok && i < r->n; i++) {
        struct stage_run *st = &r->stages[i];
        long end = to + st->offset, until = run_works(r, i) < end ? run_works(r, i) : end;
        double spent = stopwatch_cycles(), work = until > st->done ? st->work * (double)(until - st->done) : 0;
        if (!st->stage->run) continue;
        ok = stage_block(st, end, &clock, e);
        if (run_reads(st) & ITEM_BIT(ITEM_SURFACE)) work += stopwatch_cycles() - spent;
        stopwatch_spend(BLOCK + work + spent - stopwatch_cycles());
    }
    return ok;
}

void run_skip(struct run *r, long frame, long fade)
{
    r->board.fade[0] = frame;
    r->board.fade[1] = frame + fade;
    for (int i = 0; i < r->n; i++) {
        struct stage_run *st = &r->stages[i];
        st->done = frame;
        if (st->stage->skip) st->stage->skip(st, frame);
    }
    for (int i = 0; i < ITEM_COUNT; i++) {
        struct signal *s = &r->board.signals[i];
        if (!s->per_frame) continue;
        s->first = s->worked = frame - run_behind(r, (enum item)i);
        memset(s->x, 0, (size_t)(s->capacity * s->per_frame) * sizeof *s->x);
    }
}

long run_works(const struct run *r, int i)
{
    const struct stage_run *st = &r->stages[i];
    long limit = st->stage->run ? st->limit : r->board.moving;
    return st->works < limit ? st->works : limit;
}

void run_close(struct run *r)
{
    for (int i = r->n - 1; i >= 0; i--)
        if (r->stages[i].stage->close) r->stages[i].stage->close(&r->stages[i]);
    arena_close(r->arena);
    r->arena = NULL;
    r->n = 0;
}

/* Sub-band ESPRIT in rounds. Each round takes what the fit so far has left of the response, splits it into bands (ringing_band.c), finds the poles of each band's central half
   (ringing_poles.c), adds them to the fit, polishes all (ringing_fit.c) and drops what is no more than noise (ringing_select.c). The first rounds have the finest bands and
   the whole length: close and long modes; then bands twice as wide over half of the length, and so on to the undecimated beginning: a mode that decays in a few milliseconds is lost
   in the noise of a long window, and never passes a narrow filter.

   The response of a real strike is not all modes. What strikes do not agree on is an error of the response that stands under the modes and is no noise (ringing_noise.c): components
   are held against it too, by DOUBT of it, as tests that ask for some 60 times the level, so that nothing comes of noise among n samples, ask for 6 times an error that stands
   where the modes are; in the standard errors it counts whole. And the fit has a bound (ringing_bound.c): one and a half times the modes that are asked for, or
   that are asked for by default, if these are more: what is there and not in the fit makes the rest of it wrong. The strongest of it are told of; only where they by themselves leave far
   more than a fit of no more does (modes that overlap), that fit is. What still moves in the end is told of (ringing_settle.c). */
#include <math.h>
#include <string.h>

#include "analysis/ringing_apart.h"
#include "analysis/ringing_blocks.h"
#include "analysis/ringing_bound.h"
#include "analysis/ringing_candidates.h"
#include "analysis/ringing_fit.h"
#include "analysis/ringing_hums.h"
#include "analysis/ringing_report.h"
#include "analysis/ringing_select.h"
#include "analysis/ringing_settle.h"
#include "analysis/ringing_slopes.h"
#include "num/real.h"

enum {
    FINEST = 1024,     /* decimation */
    OUTPUTS = 300,     /* of the first round, at least */
    FOLLOWING = 200,   /* of the others */
    SPARE = 20,        /* components over one and a half times the modes that are asked for */
    MANY = 8,          /* that are offered at least in a round */
    AGAIN = 3,         /* times each decimation, while something is found */
    LAST = 2,          /* looks at what the last test leaves */
    STEPS = 60,        /* sweeps of a round: without noise, what is not settled would be taken for modes */
    SETTLE = 2        /* ... of the end */
};

#define DOUBT 0.1      /* share of the response's error that the tests hold components against */
#define FALLS 1e-5     /* share of the residual's energy by which a round's steps still matter */
#define STILL 1e-3     /* squared deviations by which all poles of a part together may be off in the end */
#define ALMOST 1e-6    /* test of the rounds; the last is the one that is asked for */

struct search {
    const struct ringing *r;
    const struct ringing_options *o;
    struct ringing_fit fit;
    struct ringing_noise noise;
    double low, high;      /* rad/s */
    int bound;             /* components, at most, between rounds */
    int finest;            /* decimation of the first round */
    int gone;              /* components that the test took out */
};

static void search_open(struct search *s, const struct ringing *r, const struct ringing_options *o, struct arena *a)
{
    *s = (struct search){.r = r, .o = o};
    long room = r->n / 8, wanted = 8L * (o->most > ringing_options.most ? o->most : ringing_options.most) + 200;
    ringing_fit_open(&s->fit, r, (int)(room < wanted ? room : wanted), a);
    ringing_noise_open(r, a, &s->noise);
    s->noise.doubt = DOUBT;
    int most = o->most > ringing_options.most ? o->most : ringing_options.most, bound = most + most / 2 + SPARE;
    s->bound = bound < s->fit.most / 2 ? bound : s->fit.most / 2;
    double low = fmax(o->low, r->low), high = r->high > 0 ? r->high : r->rate / 2;
    if (o->high > 0)
        high = fmin(high, o->high);
    s->low = 2 * REAL_PI * fmax(0.9 * low, 0.25 * r->rate / (double)r->n);
    s->high = 2 * REAL_PI * fmin(1.1 * high, 0.49999 * r->rate);
}

static int own_count(const struct ringing_fit *part, bool fresh)
{
    int n = 0;
    for (int i = 1; i < part->m; i++)
        n += part->fresh[i] == fresh && !part->guest[i];
    return n;
}

/* What is no more than noise goes; whether anything that came stays, or anything that was there goes. */
static bool part_drop(struct ringing_fit *part, void *context)
{
    const struct search *s = context;
    int before = own_count(part, false);
    ringing_select_drop(part, &s->noise, &(struct ringing_select){ALMOST, 1});
    return own_count(part, true) > 0 || own_count(part, false) < before;
}

static bool part_step(struct ringing_fit *part, void *context)
{
    (void)context;
    double before = 0, after = 0;
    for (int p = 0; p < part->r->places; p++)
        before += part->energy[p];
    ringing_fit_polish(part, 4);
    for (int p = 0; p < part->r->places; p++)
        after += part->energy[p];
    return after < (1 - FALLS) * before;
}

/* One round: how many components it has added. What is in blocks with theirs is fresh after it. */
static int round_run(struct search *s, int decimation, long length)
{
    int before = s->fit.m, room = s->bound + s->bound / 4 + 1 - before;
    struct ringing_candidates c = {.low = s->low, .high = s->high, .decimation = decimation, .length = length};
    struct arena *a = arena_open();
    memset(s->fit.fresh, 0, sizeof(bool) * (size_t)s->fit.m);
    ringing_candidates_find(&s->fit, &s->noise, &c, a);
    ringing_candidates_strongest(&c, room > MANY ? room : MANY);
    for (int i = 0; i < c.n; i++)
        ringing_fit_add(&s->fit, c.list[i].decay, c.list[i].omega);
    int n = c.n;
    arena_close(a);
    if (n == 0)
        return 0;
    ringing_blocks_gains(&s->fit);
    ringing_blocks_run(&s->fit, 1, part_drop, s);
    ringing_bound(&s->fit, &s->noise, s->bound);
    ringing_blocks_settle(&s->fit, STEPS, part_step, s);
    ringing_blocks_run(&s->fit, 1, part_drop, s);
    return s->fit.m - before;
}

static void rounds_run(struct search *s)
{
    int decimation = FINEST;
    while (decimation > 1 && s->r->n / decimation < OUTPUTS)
        decimation /= 2;
    s->finest = decimation;
    for (bool first = true; decimation >= 1; decimation /= 2, first = false) {
        long length = first ? s->r->n : (long)FOLLOWING * decimation;
        length = length < s->r->n ? length : s->r->n;
        for (int i = 0; i < AGAIN && round_run(s, decimation, length) > 0; i++) {
        }
    }
}

static bool part_polish(struct ringing_fit *part, void *context)
{
    (void)context;
    return ringing_fit_polish(part, 5) > STILL;
}

/* The test that was asked for. */
static bool part_judge(struct ringing_fit *part, void *context)
{
    struct search *s = context;
    struct ringing_select strict = {s->o->confidence / (double)s->r->n, 1};
    int gone = 0;
    bool moved = ringing_fit_polish(part, 5) > STILL;
    for (int now = 1; now > 0; gone += now) {
        now = ringing_select_drop(part, &s->noise, &strict);
        if (now > 0)
            ringing_fit_polish(part, 5);
        now += ringing_apart(part, &s->noise, s->o->confidence);
    }
    s->gone += gone;
    return moved || gone > 0;
}

/* What the test takes out may have hidden something. */
static void finish(struct search *s)
{
    ringing_blocks_renew(&s->fit);
    if (ringing_blocks_many(&s->fit))
        ringing_blocks_run(&s->fit, SETTLE, part_polish, s);
    ringing_blocks_renew(&s->fit);
    for (int i = 0; i < LAST; i++) {
        s->gone = 0;
        ringing_blocks_run(&s->fit, 1, part_judge, s);
        if (ringing_blocks_many(&s->fit))
            ringing_blocks_run(&s->fit, SETTLE, part_polish, s);
        if (i == LAST - 1 || s->gone == 0 || round_run(s, s->finest, s->r->n) <= 0)
            break;
    }
}

/* The fit as it is, and what of it still moves. */
static void told_make(struct search *s, struct arena *a, struct ringing_modes *m)
{
    const char *moving = ringing_settle(&s->fit, &s->noise, (const double[]){s->low, s->high}, a);
    ringing_report(&s->fit, &s->noise, s->o, a, m);
    if (moving)
        m->note = m->note ? arena_format(a, "%s\n%s", m->note, moving) : moving;
}

static bool holds(const struct ringing_modes *m, int places)
{
    bool all = true;
    for (int p = 0; p < places; p++)
        all = all && m->explained[p] >= 0;
    return all;
}

/* Where more were found than are asked for: a fit of no more, if it leaves far less than the strongest of all, as where modes lie so near each other that one does not stand by itself. */
static void reduced_make(struct search *s, struct arena *a, struct ringing_modes *m)
{
    struct ringing_modes fewer;
    double left = 0, before = 0;
    if (!ringing_bound_modes(&s->fit, &s->noise, s->o))
        return;
    ringing_blocks_renew(&s->fit);
    ringing_blocks_settle(&s->fit, STEPS, part_polish, s);
    ringing_hums_drop(&s->fit, &s->noise, false);
    told_make(s, a, &fewer);
    for (int p = 0; p < s->r->places; p++) {
        left += 1 - fewer.explained[p];
        before += 1 - m->explained[p];
    }
    if (before < 2 * left + 0.01 * s->r->places)
        return;
    *m = fewer;
    const char *note = arena_format(a, "more modes were found than the %d that are told of, so near each other that these are a fit of %d to all: a greater --modes tells them apart", m->modes, m->modes);
    m->note = m->note ? arena_format(a, "%s\n%s", note, m->note) : note;
}

bool ringing_esprit(const struct ringing *r, const struct ringing_options *o, struct arena *a, struct ringing_modes *m, struct err *e)
{
    struct search s;
    bool silent;
    if (!ringing_report_check(r, o, &silent, e))
        return false;
    if (silent) {
        ringing_report_silent(r, a, m);
        return true;
    }
    struct arena *inner = arena_open();
    search_open(&s, r, o, inner);
    rounds_run(&s);
    if (o->slope_test > 0)
        ringing_slopes_find(&s.fit, &s.noise, ALMOST);
    finish(&s);
    ringing_slopes_tie(&s.fit, &s.noise, o->slope_test);
    if (ringing_blocks_many(&s.fit))
        ringing_blocks_run(&s.fit, SETTLE, part_polish, &s);
    ringing_hums_drop(&s.fit, &s.noise, false);
    told_make(&s, a, m);
    if (s.fit.m > 1 && !holds(m, r->places) && ringing_hums_drop(&s.fit, &s.noise, true) > 0)
        told_make(&s, a, m);
    reduced_make(&s, a, m);
    ringing_noise_close(&s.noise);
    arena_close(inner);
    return true;
}

/* From exact means over sub-intervals to samples of the force at the audio rate: a linear-phase low-pass that also undoes the means'
   droop (num/filter.h, filter_decimator). Delay is compensated: sample n is the force at n / rate. */
#include "force/given.h"
#include "num/filter.h"
#include "num/lanes.h"
#include "stage.h"

static bool decimate_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model != CONTACT_GIVEN || given_is_table(c);
}

static double decimate_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 40 * s->accuracy.oversampling;
}

static bool decimate_open(struct stage_run *r, struct err *e)
{
    struct filter *f = ARENA_TAKE(r->arena, struct filter, 1);
    (void)e;
    *f = filter_decimator(r->arena, r->board->over);
    r->back = r->ahead = f->reach / r->board->over + 1;
    r->state = f;
    return true;
}

LANES_CLONES
static double decimate_dot(const double *tap, const double *x, int n)
{
    double sum[LANES] = {0}, rest = 0;
    int i = 0;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            sum[l] += tap[i + l] * x[i + l];
    for (; i < n; i++)
        rest += tap[i] * x[i];
    return (((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]))) + rest;
}

static bool decimate_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct filter *f = r->state;
    const double *x = board_at(r->board, ITEM_SUBFORCE, from);
    double *y = board_at(r->board, ITEM_FORCE, from);
    (void)e;
    for (long n = 0; n < to - from; n++)
        y[n] = decimate_dot(f->tap, x + n * r->board->over - f->reach, 2 * f->reach);
    return true;
}

const struct stage decimate_stage = {
    .name = "decimate",
    .does = "force at the audio rate",
    .paper = "",
    .idle = "contact.given.file holds samples",
    .needs = ITEM_BIT(ITEM_SUBFORCE),
    .gives = ITEM_BIT(ITEM_FORCE),
    .wanted = decimate_wanted,
    .work = decimate_work,
    .open = decimate_open,
    .run = decimate_run,
};

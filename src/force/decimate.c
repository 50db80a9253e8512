/* From means over sub-intervals, or means weighted by hats (board->hats), to samples of the force at the audio rate: a linear-phase low-pass that
   also undoes the means' droop (num/filter.h, filter_decimator). Delay is compensated: sample n is the force at n / rate. */
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
    return 28 * s->accuracy.oversampling;
}

static bool decimate_open(struct stage_run *r, struct err *e)
{
    struct filter *f = ARENA_TAKE(r->arena, struct filter, 1);
    (void)e;
    *f = r->board->hats ? filter_decimator_hats(r->arena, r->board->over) : filter_decimator(r->arena, r->board->over);
    r->back = r->ahead = f->reach / r->board->over + 1;
    r->state = f;
    return true;
}

static inline double decimate_fold(const double *sum)
{
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
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
    return decimate_fold(sum) + rest;
}

enum { FOUR = 4 };

/* The same of FOUR outputs, which do not wait for each other's additions: half the time. */
LANES_CLONES
static void decimate_four(const struct filter *f, const double *x, int over, double *y)
{
    double sum[FOUR][LANES] = {{0}}, rest[FOUR] = {0};
    const double *tap = f->tap, *x1 = x + over, *x2 = x1 + over, *x3 = x2 + over;
    int i = 0, n = f->taps;
    for (; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double t = tap[i + l];
            sum[0][l] += t * x[i + l];
            sum[1][l] += t * x1[i + l];
            sum[2][l] += t * x2[i + l];
            sum[3][l] += t * x3[i + l];
        }
    for (; i < n; i++)
        for (int k = 0; k < FOUR; k++)
            rest[k] += tap[i] * x[i + k * over];
    for (int k = 0; k < FOUR; k++)
        y[k] = decimate_fold(sum[k]) + rest[k];
}

static bool decimate_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct filter *f = r->state;
    const double *x = board_at(r->board, ITEM_SUBFORCE, from);
    double *y = board_at(r->board, ITEM_FORCE, from);
    (void)e;
    long n = 0;
    for (; n + FOUR <= to - from; n += FOUR)
        decimate_four(f, x + n * r->board->over - f->reach, r->board->over, y + n);
    for (; n < to - from; n++)
        y[n] = decimate_dot(f->tap, x + n * r->board->over - f->reach, f->taps);
    return true;
}

const struct stage decimate_stage = {
    .name = "decimate",
    .does = "force at the audio rate",
    .paper = "",
    .idle = "contact.given.file holds samples",
    .needs = ITEM_BIT(ITEM_SUBFORCE),
    .gives = ITEM_BIT(ITEM_FORCE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = decimate_wanted,
    .work = decimate_work,
    .open = decimate_open,
    .run = decimate_run,
};

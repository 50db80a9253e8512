/* A toy stage, to prove that an effect is one file and one line: this file, and the line in stages_with_toy.def. It
   adds to the sound what was there 100 samples ago, at half its level. */
#include "stage.h"

enum { TOY_DELAY = 100 };

static bool toy_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->gain < 0; /* any property of the scene may call for an effect */
}

static double toy_work(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return 2;
}

static bool toy_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->state = ARENA_TAKE(r->arena, double, STAGE_BLOCK + TOY_DELAY);
    return true;
}

static bool toy_run(struct stage_run *r, long from, long to, struct err *e)
{
    double *y = board_at(r->board, ITEM_SOUND, from), *past = r->state;
    (void)e;
    for (long n = 0; n < to - from; n++) {
        past[TOY_DELAY + n] = y[n];
        y[n] += 0.5 * past[n];
    }
    for (long n = 0; n < TOY_DELAY; n++)
        past[n] = past[to - from + n];
    return true;
}

const struct stage toy_echo_stage = {
    .name = "toy_echo",
    .does = "an echo",
    .paper = "",
    .idle = "the gain is not negative",
    .needs = ITEM_BIT(ITEM_SOUND),
    .gives = ITEM_BIT(ITEM_SOUND),
    .wanted = toy_wanted,
    .work = toy_work,
    .open = toy_open,
    .run = toy_run,
};

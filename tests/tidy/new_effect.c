/* A toy effect for new_effect.sh, to prove that an effect is this file and one line of pipeline/stages.def: the force
   swells and fades,

     f(t) (1 + depth sin(2 pi t / period)),   at most `most` times f. */
#include <jansson.h>
#include <math.h>

#include "num/real.h"
#include "scene/rows.h"
#include "stage.h"

struct swell {
    bool given;
    double period; /* s */
    double depth, most;
};

static const struct key keys[] = {
    {ROW_NUMBER(swell, period, "contact.swell.period"), KEY_TIME, 1e-3, 10, "0.1 s", NULL, "time from swell to swell"},
    {ROW_NUMBER(swell, depth, "contact.swell.depth"), KEY_NONE, 0, 1, "0.5", "contact.model=scrape|roll",
     "how far the force swells and fades, as a share of it"},
    {ROW_NUMBER(swell, most, "contact.swell.most"), KEY_NONE, 1, 2, "2", NULL, "greatest factor on the force"},
    {.path = NULL}};

static const struct params_rule rules[] = {
    {"contact.swell.period", 0.5, "motion.duration", "lower the period, or let the motion last longer"},
    {.path = NULL}};

static double gain(const struct swell *p, double t)
{
    return fmin(p->most, 1 + p->depth * real_sin(2 * REAL_PI * t / p->period));
}

static double gain_at(const struct stage_run *r, double t) { return gain(r->state, t); }

static const struct params_column columns[] = {{"swell_gain", "factor by which the force swells", gain_at},
                                               {.name = NULL}};

static const struct params swell_params = {.section = "contact.swell",
                                           .meaning = "the force swells and fades",
                                           .size = sizeof(struct swell),
                                           .keys = keys,
                                           .rules = rules,
                                           .columns = columns,
                                           .gives = ITEM_BIT(ITEM_FORCE)};

static bool swell_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return params_given(c, &swell_params);
}

static double swell_work(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return 30;
}

static bool swell_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->state = (void *)params_of(r->contact, &swell_params);
    return true;
}

static bool swell_run(struct stage_run *r, long from, long to, struct err *e)
{
    double *force = board_at(r->board, ITEM_FORCE, from);
    (void)e;
    for (long n = from; n < to; n++)
        force[n - from] *= gain(r->state, (double)n / r->board->rate);
    return true;
}

static struct stage_report swell_report(const struct stage_run *r, struct arena *a)
{
    const struct swell *p = r->state;
    double swells = (double)r->board->moving / r->board->rate / p->period;
    return (struct stage_report){
        "swell", json_pack("{s:f}", "swells", swells), arena_format(a, "the force swells %.4g times", swells), {NULL}};
}

const struct stage swell_stage = {
    .name = "swell",
    .does = "the force swells and fades",
    .paper = "",
    .idle = "no contact.swell",
    .params = &swell_params,
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_FORCE),
    .wanted = swell_wanted,
    .work = swell_work,
    .open = swell_open,
    .run = swell_run,
    .report = swell_report,
};

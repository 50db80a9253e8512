/* The stage that writes the series of impacts of a contact: those that take place (force/impact_series.h), at the times
   at which they sound, so that with the contact's start to the nearest audio sample. Interval is that to the next one.
   No time depends on the sample rate but by that start. */
#include "output/impact_rows.h"

#include "force/impact_series.h"
#include "scene/rows.h"
#include "stage.h"
#include "trajectory/contact.h"

static bool rows_wanted(const struct contact *c, const struct scene *s) { return impact_rows_listed(c, &s->output); }

static double rows_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 200 * 15000 / s->output.sample_rate; /* of some 200 impacts a second */
}

static bool rows_open(struct stage_run *r, struct err *e)
{
    struct impact_train *t = ARENA_TAKE(r->arena, struct impact_train, 1);
    r->state = t;
    return impact_series_train(r, t, e) &&
           (fputs("time_s,amplitude_n,interval_s,duration_s\n", r->board->listing->stream) >= 0 ||
            err_set(e, ERR_IO, "the series of impacts cannot be written (is the disk full?)"));
}

static bool rows_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct impact_train *t = r->state;
    double rate = r->board->rate, start = (double)contact_first_frame(r->contact, rate) / rate;
    (void)from;
    while (t->any && t->next.time < (double)to / rate) {
        struct impact i = impact_series_take(t);
        if (fprintf(r->board->listing->stream, "%.17g,%.17g,%.17g,%.17g\n", start + i.time, i.amplitude, i.interval,
                    i.duration) < 0)
            return err_set(e, ERR_IO, "the series of impacts cannot be written (is the disk full?)");
    }
    return true;
}

static struct stage_report rows_report(const struct stage_run *r, struct arena *a)
{
    const struct impact_train *t = r->state;
    return impact_series_report(&t->report, a);
}

static const struct choice listings[] = {
    [LISTING_NONE] = {"none", "no"},
    [LISTING_TABLE] = {"table", "NAME.impacts.csv (of several contacts NAME.CONTACT.impacts.csv): time, amplitude, "
                                "interval and duration of each"},
    {NULL, NULL}};

static const struct key keys[] = {{ROW_CHOICE(scene, output.impacts, "output.impacts"), KEY_NONE, 0, 0, "none", NULL,
                                   "is the series of a contact of model impacts written?", listings},
                                  {.path = NULL}};

static const struct params impact_rows_params = {.section = "output.impacts", .keys = keys};

const struct stage impact_rows_stage = {
    .name = "impact_rows",
    .params = &impact_rows_params,
    .does = "the series of impacts, one row each",
    .paper = "",
    .idle = "no output.impacts, or contact.model is not impacts",
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_LISTING),
    .wanted = rows_wanted,
    .work = rows_work,
    .open = rows_open,
    .run = rows_run,
    .report = rows_report,
};

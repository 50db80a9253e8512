/* A force given as a table over time (CSV: time_s, and the column contact.given.column), taken as piecewise linear
   between its times, which may lie at any distances; times two rows of which are near make a step. Times are those of a
   recorded motion's file, else they count from the contact's start. Before the first and after the last row the force
   is 0.

   Means over sub-intervals are exact: each piece of the table within one adds its value at the middle of what it shares
   with it. Times are turned into sub-intervals once, so that pieces meet where they should. */
#include "force/given.h"
#include "force/onset.h"
#include "stage.h"
#include "trajectory/series.h"
#include "trajectory/trajectory.h"

struct given_table {
    size_t n, piece;    /* rows; the piece in which the last sub-interval ended */
    double *at, *force; /* [n] sub-intervals after the contact's start; N       */
};

static bool table_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_GIVEN && given_is_table(c);
}

static double table_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 12 * s->accuracy.oversampling;
}

static bool table_open(struct stage_run *r, struct err *e)
{
    const struct given_force *given = &r->contact->contact.given;
    const struct trajectory *tr = r->board->trajectory;
    const char *const columns[2] = {given->column, NULL};
    struct given_table *g = ARENA_TAKE(r->arena, struct given_table, 1);
    struct series s;
    if (!given_fits(r->contact, "CSV", e) || !series_read(given->file, columns, r->arena, &s, e)) return false;
    *g = (struct given_table){
        .n = s.n, .at = ARENA_TAKE(r->arena, double, s.n), .force = ARENA_TAKE(r->arena, double, s.n)};
    double first = s.time[0] - tr->clock, last = s.time[s.n - 1] - tr->clock;
    if (first < -1e-9)
        return err_set(e, ERR_SCENE,
                       "%s:%d: column 'time_s': %.9g s lies before the motion's start, %.9g s: take away the rows "
                       "before it, or let "
                       "motion.file begin earlier",
                       given->file, s.lines[0], s.time[0], tr->clock);
    if (!given_ends(r->contact, last, tr->duration, e)) return false;
    onset_told(r, "the largest force", s.time[onset_largest(s.n, s.x[0])] - tr->clock);
    for (size_t i = 0; i < s.n; i++) {
        g->at[i] = (s.time[i] - tr->clock) * r->board->rate * r->board->over;
        g->force[i] = given_scale(r->contact) * s.x[0][i];
    }
    r->state = g;
    return true;
}

/* Mean over sub-interval k; k does not fall from call to call. */
static double table_mean(struct given_table *g, double k)
{
    double sum = 0;
    for (; g->piece + 1 < g->n; g->piece++) {
        const double *at = g->at + g->piece, *force = g->force + g->piece;
        double lo = fmax(at[0] - k, 0), hi = fmin(at[1] - k, 1), middle = 0.5 * (lo + hi);
        if (hi > lo) sum += (hi - lo) * (force[0] + (force[1] - force[0]) * ((middle - (at[0] - k)) / (at[1] - at[0])));
        if (at[1] - k > 1) break;
    }
    return sum;
}

static bool table_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct given_table *g = r->state;
    const struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from), first = (double)(from * b->over);
    (void)e;
    for (long i = 0; i < (to - from) * b->over; i++)
        force[i] = table_mean(g, first + (double)i);
    return true;
}

const struct stage given_table_stage = {
    .name = "given_table",
    .does = "contact force from a table over time",
    .paper = "",
    .idle = "contact.model is not given, or contact.given.file holds samples",
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .wanted = table_wanted,
    .work = table_work,
    .open = table_open,
    .run = table_fill,
};

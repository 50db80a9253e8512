/* The budget is shared in tenths of its square between the knobs that are free; the shares whose values cost the least,
 * by the plans' predicted work, are taken. Where tenths are too coarse to keep the error, every knob is as fine as
 * helps. */
#include <math.h>
#include <string.h>

#include "num/real.h"
#include "pipeline/promise_parts.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

enum { SOURCES = 4, TENTHS = 10 };

struct sources { /* what is free to be chosen */
    int n, knob[SOURCES], tenths[SOURCES], best[SOURCES];
    double cost, left; /* left: of the budget's square, share that what is said does not use */
};

/* The plans' predicted work. */
static double cost_of(const struct promise_making *m, const struct accuracy *set)
{
    struct scene s = *m->kept;
    double all = 0;
    s.accuracy = *set;
    for (int i = 0; i < s.n_contacts; i++) {
        const struct plan *p = &m->parts.parts[i].plan;
        for (int k = 0; k < p->n; k++)
            all += p->rows[k].verdict == PLAN_RUNS ? p->rows[k].stage->work(p->contact, &s) : 0;
    }
    return all;
}

/* Sets the knobs for shares of what is left; false: one has no such value. */
static bool take(const struct promise_making *m, const struct sources *s, const int *tenths, struct accuracy *set,
                 double *spent)
{
    *spent = 0;
    for (int i = 0; i < s->n; i++) {
        double square = s->left * tenths[i] / TENTHS;
        double value = promise_curve_least(&m->curves[s->knob[i]], m->whole * sqrt(square));
        if (isnan(value)) return false;
        double error = promise_curve_error(&m->curves[s->knob[i]], value) / m->whole;
        *spent += error * error;
        accuracy_turn(set, (enum knob)s->knob[i], value);
    }
    return true;
}

static void try_shares(const struct promise_making *m, struct sources *s)
{
    struct accuracy set = m->kept->accuracy;
    double spent;
    if (!take(m, s, s->tenths, &set, &spent)) return;
    double cost = cost_of(m, &set);
    if (cost < s->cost) {
        s->cost = cost;
        memcpy(s->best, s->tenths, sizeof s->best);
    }
}

/* All ways to share out what is left among the sources from i on, a tenth at least to each. */
static void share(const struct promise_making *m, struct sources *s, int i, int left)
{
    if (i == s->n - 1) {
        s->tenths[i] = left;
        try_shares(m, s);
        return;
    }
    for (s->tenths[i] = 1; s->tenths[i] <= left - (s->n - 1 - i); s->tenths[i]++) {
        int kept = s->tenths[i];
        share(m, s, i + 1, left - kept);
        s->tenths[i] = kept;
    }
}

/* Of the budget's square, the share that knobs which are said leave. */
static double left_over(const struct promise_making *m)
{
    double left = 1;
    for (int k = 0; k < KNOBS; k++)
        if (promise_used(m, k) && promise_said(m, k)) {
            double error =
                promise_curve_error(&m->curves[k], accuracy_knob(&m->asked->accuracy, (enum knob)k)) / m->whole;
            left -= error * error;
        }
    return left;
}

/* Every knob as fine as helps, however the budget is then shared. */
static bool take_best(const struct promise_making *m, const struct sources *s, struct accuracy *set, double *spent)
{
    *spent = 0;
    for (int i = 0; i < s->n; i++) {
        const struct promise_curve *c = &m->curves[s->knob[i]];
        double value = promise_curve_best(c), error = promise_curve_error(c, value) / m->whole;
        *spent += error * error;
        accuracy_turn(set, (enum knob)s->knob[i], value);
    }
    return *spent < s->left;
}

bool promise_share(struct promise_making *m)
{
    struct sources s = {.cost = HUGE_VAL, .left = left_over(m)};
    double spent = 0;
    for (int k = 0; k < KNOBS; k++)
        if (!promise_said(m, k) && promise_used(m, k) && s.n < SOURCES) s.knob[s.n++] = k;
    if (s.n == 0) /* nothing is free: the margin is no matter */
        return s.left >= 1 - real_exp10(PROMISE_MARGIN / 10);
    if (s.left > 0) share(m, &s, 0, TENTHS);
    struct accuracy set = m->kept->accuracy;
    if (!(isfinite(s.cost) ? take(m, &s, s.best, &set, &spent) : take_best(m, &s, &set, &spent))) return false;
    m->kept->accuracy = set;
    return true;
}

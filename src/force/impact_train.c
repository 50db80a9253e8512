/* An impact takes place if its middle comes before the motion's end and it is not over before the contact's start. */
#include "force/impact_train.h"

#include <math.h>

#include "trajectory/trajectory.h"

#define IMPACT_LONGEST 10.0 /* s: half of it is how far the force must look ahead */

static void train_look(struct impact_train *t)
{
    impact_series_next(&t->series, &t->next);
    t->any = t->next.time < t->end;
}

bool impact_train_open(const struct stage_run *r, struct impact_train *t, struct err *e)
{
    const struct contact *c = r->contact;
    *t = (struct impact_train){.end = r->board->trajectory->duration};
    if (!impact_law_make(c, t->end, r->arena, &t->law, e)) return false;
    if (!(t->law.longest <= IMPACT_LONGEST))
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.impacts.duration.zeta: an impact of the least amplitude would last %.4g "
                       "s, and at most %g s make sense: lower "
                       "zeta or theta, or raise contact.impacts.floor.amplitude",
                       c->name, t->law.longest, IMPACT_LONGEST) ||
               err_about(e, c->name, "contact.impacts.duration.zeta");
    t->report.time = t->end;
    t->before[0] = HUGE_VAL;
    impact_series_open(&t->law, r->scene->seed, c->name, r->arena, &t->series);
    train_look(t);
    return true;
}

static void train_report(struct impact_train *t, const struct impact *i)
{
    struct impact_report *o = &t->report;
    o->count++;
    o->limited_amplitude += (i->limited & IMPACT_LIMITED_AMPLITUDE) != 0;
    o->limited_interval += (i->limited & IMPACT_LIMITED_INTERVAL) != 0;
    o->overlaps += impact_series_overlap(t->before[0], t->before[1], i->duration, 0);
    o->longest = fmax(o->longest, i->duration);
    t->sums[0] += i->amplitude;
    t->sums[1] += i->interval;
    o->mean_amplitude = t->sums[0] / (double)o->count;
    o->mean_interval = t->sums[1] / (double)o->count;
    t->before[0] = i->interval;
    t->before[1] = i->duration;
}

struct impact impact_train_take(struct impact_train *t)
{
    struct impact now = t->next;
    train_report(t, &now);
    train_look(t);
    return now;
}

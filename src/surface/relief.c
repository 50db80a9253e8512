/* See relief.h. */
#include "surface/relief.h"

#include <math.h>
#include <string.h>

#include "scene/rules.h"

void relief_add(struct relief *r, struct relief_part *part)
{
    struct relief_part **end = &r->first;
    while (*end)
        end = &(*end)->next;
    *end = part;
}

void relief_at(const struct relief *r, const struct relief_points *p, const struct relief_values *v)
{
    double *all[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    for (int k = 0; k < 6; k++)
        if (all[k])
            memset(all[k], 0, p->n * sizeof(double));
    for (struct relief_part *part = r->first; part; part = part->next)
        part->add(part, p, v);
}

void relief_settle(struct relief *r, const struct contact *c)
{
    if (r->along == ALONG_AUTO)
        r->along = rules_along(c);
}

double relief_finest(const struct relief *r)
{
    double finest = HUGE_VAL;
    for (const struct relief_part *p = r->first; p; p = p->next) {
        finest = fmin(finest, p->finest);
        for (int k = 0; k < 2; k++)
            finest = p->pitch[k] > 0 ? fmin(finest, p->pitch[k]) : finest;
    }
    return finest;
}

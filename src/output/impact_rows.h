/* The series of impacts as a CSV: time_s,amplitude_n,interval_s,duration_s, one row an impact, %.17g; impact_rows.c is
 * the stage that writes it. */
#ifndef OUTPUT_IMPACT_ROWS_H
#define OUTPUT_IMPACT_ROWS_H
#include <stdio.h>

#include "base/err.h"
#include "scene/scene.h"

struct impact_sink {
    FILE *stream;
};

/* Is its series of impacts written? */
static inline bool impact_rows_listed(const struct contact *c, const struct output *o)
{
    return o->impacts == LISTING_TABLE && c->contact.model == CONTACT_IMPACTS;
}

#endif

/* A distribution whose density is given in a CSV, straight between its rows, with closed forms of everything. */
#ifndef FORCE_IMPACT_TABLE_H
#define FORCE_IMPACT_TABLE_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct impact_table {
    int n;                   /* rows, at least 2                                                    */
    double *value, *density; /* [n] rising; scaled so that the whole probability is 1               */
    double *below, *above;   /* [n] probability below and above a row's value                       */
    double mean, variance;
};

/* Columns value and density. ERR_INPUT, ERR_SCENE with file and line: fewer than 2 rows, values that do not rise, a
 * density below 0, no area. */
bool impact_table_read(const char *file, struct arena *a, struct impact_table *t, struct err *e);

/* x with P(X <= x) = w, 0 < w < 1. */
double impact_table_quantile(const struct impact_table *t, double w);

/* P(X < x), P(X > x), density at x. */
double impact_table_below(const struct impact_table *t, double x);
double impact_table_above(const struct impact_table *t, double x);
double impact_table_density(const struct impact_table *t, double x);

#endif

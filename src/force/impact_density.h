/* Distributions of the white processes that drive a series of impacts, and mixtures of them. */
#ifndef FORCE_IMPACT_DENSITY_H
#define FORCE_IMPACT_DENSITY_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum impact_density_kind {
    IMPACT_DENSITY_POINT,
    IMPACT_DENSITY_GAUSSIAN,
    IMPACT_DENSITY_EXPONENTIAL,
    IMPACT_DENSITY_TABLE
};

/* A density given in a CSV, straight between its rows. */
struct impact_table {
    int n;                   /* rows, at least 2                                                    */
    double *value, *density; /* [n] rising; scaled so that the whole probability is 1               */
    double *below, *above;   /* [n] probability below and above a row's value                       */
    double mean, variance;
};

struct impact_density {
    int kind; /* enum impact_density_kind                     */
    double mean, variance;
    double deviation; /* sqrt(variance)                               */
    struct impact_table table;
};

/* Always `value`; normal about 0 (deviation 0: always 0); exponential from 0 up (mean 0: always 0); of a CSV (errors:
 * file, line: fewer than 2 rows, values that
 * do not rise, a density below 0, no area). */
struct impact_density *impact_density_point(double value, struct arena *a);
struct impact_density *impact_density_gaussian(double deviation, struct arena *a);
struct impact_density *impact_density_exponential(double mean, struct arena *a);
struct impact_density *impact_density_table(const char *file, struct arena *a, struct err *e);

/* x with P(X <= x) = w, 0 < w < 1: closed forms. */
double impact_density_quantile(const struct impact_density *d, double w);

/* P(X > x) (`upper`) or P(X < x), and the density there. */
double impact_density_beyond(const struct impact_density *d, bool upper, double x, double *density);

enum { IMPACT_DENSITY_PARTS = 3 };

struct impact_mixture { /* with probability share[k] a draw is one of part[k]; shares add up to 1 */
    int n;
    double share[IMPACT_DENSITY_PARTS];
    const struct impact_density *part[IMPACT_DENSITY_PARTS];
};

void impact_density_moments(const struct impact_mixture *m, double *mean, double *variance);

/* The least x with P(X <= x) >= w, 0 < w < 1; absolute error 1e-12 of the mixture's standard deviation. */
double impact_density_mixed(const struct impact_mixture *m, double w);

#endif

/* Impacts found in a force, or read from a table of them. */
#ifndef ANALYSIS_IMPACT_EVENTS_H
#define ANALYSIS_IMPACT_EVENTS_H
#include <float.h>
#include <math.h>
#include <stdbool.h>

struct impact_events {
    int n;
    double *time;      /* [n] s, of the greatest force; rising                                       */
    double *amplitude; /* [n] N                                                                      */
    double *duration;  /* [n] s; NAN where it is not known                                           */
    bool *alone;       /* [n] the force is 0 before and after it: its duration is a contact time      */
    long fewer;        /* how many local maxima were left out, below the threshold                   */
    double blur[2]; /* how far amplitudes that are alike may be apart, as a share of them, and intervals, in s, as they
                       were measured; 0: in a table */
};

/* How far a difference of times may be off by rounding, in s. */
static inline double impact_events_grain(const struct impact_events *v)
{
    return 4 * DBL_EPSILON * fmax(fabs(v->time[0]), fabs(v->time[v->n - 1]));
}

#endif

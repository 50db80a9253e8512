/* Impacts found in a force, or read from a table of them. */
#ifndef ANALYSIS_IMPACT_EVENTS_H
#define ANALYSIS_IMPACT_EVENTS_H
#include <stdbool.h>

struct impact_events {
    int n;
    double *time;       /* [n] s, of the greatest force; rising                                       */
    double *amplitude;  /* [n] N                                                                      */
    double *duration;   /* [n] s; NAN where it is not known                                           */
    bool *alone;        /* [n] the force is 0 before and after it: its duration is a contact time      */
    long fewer;         /* how many local maxima were left out, below the threshold                   */
};

#endif

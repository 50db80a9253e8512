/* Impacts in a force: when, how strong, how long. */
#ifndef ANALYSIS_IMPACT_FIND_H
#define ANALYSIS_IMPACT_FIND_H
#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

/* Impacts found in a force, or read from a table of them. */
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

enum { IMPACT_FEET_MANY = 20 }; /* impacts whose ends are known from which their median tells `stretch` */

struct impact_signal {
    const double *force; /* [n] N, at start + i / rate                                              */
    long n;
    double rate, start; /* Hz, s                                                                   */
};

struct impact_options {
    double threshold;  /* least force, as a share of the greatest                                 */
    double prominence; /* least prominence, as a share of the greatest force within 24 samples    */
    double quiet;      /* share of an impact's force below which the force counts as 0            */
    bool both;         /* impacts in both directions: maxima of |force|                           */
};

extern const struct impact_options impact_find_options; /* 0.001, 0.02, 0.01, false */

struct impact_found {
    struct impact_events events; /* fewer: ripples + low                                               */
    double *from, *to;      /* [n] samples: where the force has fallen to `quiet`, or is least before the next impact */
    long ripples, low;      /* local maxima left out: not prominent; below the threshold               */
    long merged;            /* impacts with a shoulder: two that made one maximum                      */
    long touching;          /* that do not stand alone                                                 */
    long alone;             /* that do                                                                 */
    long feet;              /* of these, those whose two ends tell `stretch`                           */
    long unknown;           /* whose duration is not known                                             */
    double stretch;         /* contact time over width at half height, median over `feet`; 2: none     */
    double greatest, least; /* N, of the force                                                         */
};

/* ERR_SCENE: no local maximum is left. */
bool impact_find(const struct impact_signal *s, const struct impact_options *o, struct arena *a, struct impact_found *f,
                 struct err *e);

/* How long impacts last, as a law of their amplitude: t0 = zeta A^-theta (papers/002 equation 12), A in newtons. */
enum {
    IMPACT_DURATION_LEAST = 5,
    IMPACT_DURATION_MANY = 20
}; /* impacts from which theta is told; of a series, from which a law is believed */

struct impact_duration {
    double theta;
    double theta_single, theta_error; /* on single impacts, and its standard error; NAN where theta is given */
    double zeta_single;               /* s, on single impacts                                          */
    double r2_single, r2_single_log;  /* of t0, and of its logarithm                              */
    long singles;                     /* impacts that theta is from; 0: given                          */
    double zeta;                      /* s, of the series                                              */
    double r2, r2_log;
    long n; /* impacts of the series whose duration is known                 */
};

/* First step: theta and zeta by linear regression of log t0 on log |A|, over the impacts that stand alone, or over all.
   False, with nothing set but `singles`: fewer than IMPACT_DURATION_LEAST, or amplitudes all alike (their logarithms'
   deviation is below 0.02). */
bool impact_find_duration_single(const struct impact_events *v, bool only_alone, struct impact_duration *d);

/* Second step: with d->theta as it is, zeta alone, over all impacts whose duration is known. False: there is none. */
bool impact_find_duration_series(const struct impact_events *v, struct impact_duration *d);

/* In its place where no law holds: theta 0, zeta the median of the durations that are known. False: there is none. */
bool impact_find_duration_constant(const struct impact_events *v, struct arena *a, struct impact_duration *d);

#endif

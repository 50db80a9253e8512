/* Impacts in a force: when, how strong, how long. */
#ifndef ANALYSIS_IMPACT_FIND_H
#define ANALYSIS_IMPACT_FIND_H
#include "analysis/impact_events.h"
#include "base/arena.h"
#include "base/err.h"

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

#endif

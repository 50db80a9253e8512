/* Which shape impacts have: a raised cosine (papers/002 equation 9) or a Meixner window, by least squares. */
#ifndef ANALYSIS_IMPACT_SHAPE_H
#define ANALYSIS_IMPACT_SHAPE_H
#include "analysis/impact_find.h"

enum impact_shape_kind { IMPACT_SHAPE_COSINE, IMPACT_SHAPE_MEIXNER, IMPACT_SHAPE_KINDS };
enum { IMPACT_SHAPE_POINTS = 97, IMPACT_SHAPE_LEAST = 6, IMPACT_SHAPE_LONGEST = 4000, IMPACT_SHAPE_MOST = 500 };

struct impact_shape_fit {
    double r2;
    double gain;     /* N: of the raised cosine its height                                 */
    double at;       /* samples: the raised cosine's middle; the Meixner window's n = 0    */
    double duration; /* samples: of the raised cosine                                      */
    double b, xi;    /* of the Meixner window                                              */
};

/* To samples y[n] at 0, 1, ..., n - 1; begins at a fit whose `at`, and duration or b and xi, are near. model[n]: the
 * fitted shape; NULL: not asked. */
void impact_shape_fit(const double *y, int n, enum impact_shape_kind kind, struct impact_shape_fit *fit, double *model);

/* A fit to begin with, from the greatest value and the second moments of y^2. */
void impact_shape_guess(const double *y, int n, enum impact_shape_kind kind, struct impact_shape_fit *fit);

struct impact_shape {
    long fitted, brief, lengthy; /* impacts that were fitted; that stand alone but have fewer than IMPACT_SHAPE_LEAST
                                    samples; more than _LONGEST */
    double r2[IMPACT_SHAPE_KINDS][3]; /* over those fitted: 5 %, median, 95 %                         */
    double b, xi;                     /* medians                                                            */
    double stretch;                   /* median ratio of the fitted raised cosine's duration to the contact time */
    double q[IMPACT_SHAPE_POINTS];    /* time from the maximum over duration, -0.75 to 0.75               */
    double mean[IMPACT_SHAPE_POINTS], deviation[IMPACT_SHAPE_POINTS]; /* of force over amplitude        */
    double model[IMPACT_SHAPE_KINDS][IMPACT_SHAPE_POINTS];
    struct impact_shape_fit of_mean[IMPACT_SHAPE_KINDS]; /* in points, 64 to a duration                */
};

/* Over the impacts that stand alone; at most IMPACT_SHAPE_MOST of them, evenly spread. `fitted` 0: none, and nothing
 * else is set. */
void impact_shape_make(const struct impact_signal *s, const struct impact_found *f, struct arena *a,
                       struct impact_shape *h);

#endif

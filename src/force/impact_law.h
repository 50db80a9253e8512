/* What the impacts of a series are like, at any instant: the set P of papers/004 ("Intuitive Sound-Synthesis Control")
   of a prototype, of a place on its disk of actions, or of a place that moves; and the distributions that the white
   processes are drawn from. */
#ifndef FORCE_IMPACT_LAW_H
#define FORCE_IMPACT_LAW_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"

enum impact_anchor { IMPACT_RUB, IMPACT_SCRATCH, IMPACT_ROLL, IMPACT_ANCHORS }; /* IMPACT_ROLL: also what is custom */
enum impact_series_of { IMPACT_AMPLITUDE, IMPACT_INTERVAL, IMPACT_SERIES };

struct impact_parameters {        /* at one instant. Amplitudes without unit, times in s */
    double share[IMPACT_ANCHORS]; /* of the anchors in the densities; sum 1                              */
    double zeta, theta;           /* an impact lasts zeta max(|A|, shortest)^-theta                        */
    double mean[IMPACT_SERIES];
    double a1[IMPACT_SERIES], b1[IMPACT_SERIES];
    double depth, rate;     /* 1, Hz: modulation                                                     */
    double least_amplitude; /* draws are raised to it; -HUGE_VAL: they keep their sign               */
    double shortest;        /* |A| counts as at least this where durations are taken                 */
};

struct impact_density;

struct impact_law {
    struct impact_density *density[IMPACT_ANCHORS][IMPACT_SERIES]; /* of the white processes */
    struct impact_parameters anchor[IMPACT_ANCHORS];
    double *walk; /* [steps][3]: s, rad, radius (may be negative), of the disk; one row: it stays; NULL: alone */
    int steps;
    int alone;             /* enum impact_anchor of a prototype by itself; -1: on the disk          */
    double unit_force;     /* N of an amplitude of 1                                                */
    double least_interval; /* s                                                                     */
    bool lognormal, two;   /* marginal, processes                                                   */
    double longest;        /* s, duration of the longest impact that there can be                   */
};

/* `duration`: s, of the motion (for angle_to and radius_to). Errors: ERR_MISSING, ERR_SCENE of files (table, walk),
 * with file and line. */
bool impact_law_make(const struct contact *c, double duration, struct arena *a, struct impact_law *l, struct err *e);

/* Shares of rub, scratch and roll at a place: papers/004 equations 8 to 11; any angle, radius in [-1, 1]. */
void impact_law_shares(double angle, double radius, double share[IMPACT_ANCHORS]);

/* At t in s after the contact's start; before 0 as at 0. */
void impact_law_at(const struct impact_law *l, double t, struct impact_parameters *p);

/* A draw of the white process: F^-1(w), 0 < w < 1, of the density that lies between the anchors'; relative error 1e-12
 * of the distribution's width. */
double impact_law_draw(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                       double w);

/* Mean and variance of that white process. */
void impact_law_moments(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                        double *mean, double *variance);

/* Mean and variance of the stationary series at P, floors, modulation and marginal apart: mean + white mean (1 + b1)/(1
   + a1), and variance (1 + b1^2 - 2 a1 b1)/(1 - a1^2). */
void impact_law_stationary(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                           double *mean, double *variance);

#endif

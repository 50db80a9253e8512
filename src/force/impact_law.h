/* What the impacts of a series are like, at any instant: the set P of papers/004 ("Intuitive Sound-Synthesis Control")
   of a prototype, of a place on its disk of actions, or of a place that moves; and the distributions that the white
   processes are drawn from. */
#ifndef FORCE_IMPACT_LAW_H
#define FORCE_IMPACT_LAW_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/params.h"
#include "scene/scene.h"

enum impact_prototype { PROTOTYPE_ROLL, PROTOTYPE_RUB, PROTOTYPE_SCRATCH, PROTOTYPE_SPACE, PROTOTYPE_CUSTOM };
enum impact_distribution { DISTRIBUTION_GAUSSIAN, DISTRIBUTION_EXPONENTIAL, DISTRIBUTION_TABLE };
enum impact_marginal { MARGINAL_AS_DRAWN, MARGINAL_LOGNORMAL };
enum impact_processes { PROCESSES_ONE, PROCESSES_TWO };

struct impact_draws {  /* one series, of amplitudes (no unit) or intervals (s); NAN: the prototype's   */
    double mean;       /* added to what the filter makes of the white process               */
    double deviation;  /* standard deviation of the white process; of an exponential one its mean too */
    double a1, b1;     /* of the filter (1 + b1/z) / (1 + a1/z)                             */
    int distribution;  /* enum impact_distribution, of the white process                    */
    const char *table; /* CSV of value, density                                             */
};

struct impact_grain { /* rub and scratch: impacts that know nothing of each other          */
    double deviation; /* of the amplitudes, whose mean is 0                                */
    double interval;  /* s, of rub from impact to impact; of scratch the mean              */
    double duration;  /* s, of an impact                                                   */
};

struct impacts {                      /* keys contact.impacts.* */
    int prototype;                    /* enum impact_prototype                                             */
    double size, velocity, roughness; /* papers/002's controls S, V and rho                      */
    double unit_force;                /* N of an amplitude of 1                                            */
    struct impact_draws amplitude, interval;
    double zeta, theta;     /* duration zeta |A|^-theta, s; NAN: the prototype's                 */
    double depth, rate;     /* m and nu (Hz) of the amplitudes' modulation; NAN: the prototype's */
    double least_amplitude; /* share of the mean; NAN: the prototype's                           */
    double least_interval;  /* s                                                                 */
    int marginal;           /* enum impact_marginal                                              */
    int processes;          /* enum impact_processes                                             */
    struct impact_grain rub, scratch;
    double angle, radius;       /* rad, 1: place on the disk of actions                              */
    double angle_to, radius_to; /* at the motion's end; NAN: it stays                            */
    const char *walk;           /* CSV of time_s, angle_deg, radius; NULL: none                      */
};

/* Keys, rules: of the stage impacts. */
extern const struct params impact_law_params;
const struct impacts *impact_law_given(const struct contact *c);

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

/* What may be asked of a series of impacts, and of the filters that a force goes through: part of scene.h. */
#ifndef SCENE_IMPACTS_H
#define SCENE_IMPACTS_H
#include <stdbool.h>

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

struct impacts {                      /* a series of impacts: force/impact_law.h, force/impact_series.h    */
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

#endif

/* How fast a response moves: what hops and nodes are chosen from. */
#ifndef CONVOLUTION_RING_SURVEY_H
#define CONVOLUTION_RING_SURVEY_H
#include "base/arena.h"
#include "response/modes.h"
#include "trajectory/trajectory.h"

struct ring_survey {
    int n, instants;
    double duration;            /* s that the instants stand for                              */
    double *pole, *gain;        /* [instants][n]: |ds/dt| in rad/s^2; |dA/dt| over |A|, 1/s   */
    double *sigma, *weight;     /* [instants][n]: decay in 1/s; |A|^2 / sigma (A as in gain)  */
    double *loud;               /* [instants] power of the force, relative                    */
    double *energy;             /* [n] sum of |A|^2 / sigma over the instants                 */
    double *kinks;              /* [n] likewise of what kinks come to, 1/s^3                   */
};

struct ring_survey_ask {
    const struct modes *modes;
    bool by_speed;              /* the force is taken to grow with the speed of the contact   */
    bool stops;                 /* the response stays at the motion's end, and is still needed: a kink (of readout) */
};

void ring_survey(const struct ring_survey_ask *ask, const struct trajectory *tr, struct arena *a, struct ring_survey *s);

/* Relative rms error that interpolation of that order at a hop of `hop` seconds makes (hop.h's formula, with the gains' movement), all modes
   together. */
double ring_survey_error(const struct ring_survey *s, int order, double hop);

/* The longest hop (s) that keeps the error, and no longer than `most`. */
double ring_survey_hop(const struct ring_survey *s, int order, double error, double most);

/* The same of each mode by itself: hop[n], s. */
void ring_survey_hops(const struct ring_survey *s, int order, double error, double most, double *hop);

#endif

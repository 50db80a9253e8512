/* A motion and what rings along it, looked over once: where the response moves, where it bends, where the force is loud. From that, instants at which the
   error of interpolation is measured (ring_error.h). */
#ifndef CONVOLUTION_RING_SURVEY_H
#define CONVOLUTION_RING_SURVEY_H
#include "base/arena.h"
#include "convolution/ring_along.h"

struct ring_survey_ask {
    const struct modes *modes;
    const struct trajectory *trajectory;
    bool by_speed;              /* the force is taken to grow with the speed of the contact     */
    bool stays;                 /* as in struct ring_along                                      */
    bool slopes;                /* slope and turned are wanted                                  */
};

struct ring_survey {
    struct ring_along along;
    double duration, cycle;     /* s; the motion repeats itself after a cycle                   */
    long cells;                 /* of a cycle                                                   */
    double step;                /* s, of a cell                                                 */
    double *loud;               /* [cells] power of the force, relative                         */
    double *moved;              /* [cells + 1] cumulated share of the movement, 0 to 1          */
    int *bent;                  /* [cells + 1] how many cells before have a kink                */
    double *slope;              /* [cells][n][2] of the poles, ds/dt in 1/s^2; NULL: not asked  */
    double *turned;             /* [cells + 1][n][2] int (ds/dt)^2 dt from the cycle's start    */
    double *looked;             /* cycles that this and all errors measured since took, about   */
};

void ring_survey(const struct ring_survey_ask *ask, struct arena *a, struct ring_survey *s);

/* Cycles that it takes, about, to find what rings at an instant. */
double ring_survey_point(const struct ring_survey *s);

/* Power of the force at t, relative; 0 before the start and after the end. */
double ring_survey_loud(const struct ring_survey *s, double t);

enum { RING_SURVEY_INSTANTS = 512 };

struct ring_survey_instant {
    double t, weight;           /* s; s for which it stands: sum weight g(t) is the integral of g */
};

/* Instants of the motion, more of them where the response moves and within `reach` (s) of kinks and ends. Returns how many: at most
   RING_SURVEY_INSTANTS. */
int ring_survey_draw(const struct ring_survey *s, double reach, struct ring_survey_instant *at);

#endif

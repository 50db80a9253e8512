/* A series of impacts, drawn one after the other: amplitudes and intervals from ARMA(1,1) filters (papers/002 equations
   6 and 13; 004 equation 3)

     X_n = -a1 X_(n-1) + E_n + b1 E_(n-1),   A_n = mean_A + X_n,   T_(n+1) = T_n + mean_T + Y_n,

   E_n and its like of the intervals from one uniform process W_n by their inverse distributions. See impact_series.c
   for the start in the stationary state, floors, modulation and durations. */
#ifndef FORCE_IMPACT_SERIES_H
#define FORCE_IMPACT_SERIES_H
#include <stdint.h>

#include "force/impact_law.h"
#include "num/noise.h"
#include "stage.h"

enum { IMPACT_LIMITED_AMPLITUDE = 1, IMPACT_LIMITED_INTERVAL = 2 };

struct impact {
    double time;      /* s after the contact's start, of its middle        */
    double amplitude; /* N, signed                                         */
    double interval;  /* s, to the next one                                */
    double duration;  /* s                                                 */
    unsigned limited; /* which of its draws were raised to their floors    */
};

struct impact_series {
    const struct impact_law *law;
    struct noise noise;
    int64_t number;                                /* of the next impact; drawn numbers depend on it alone */
    double time, phase;                            /* s, of the next impact; of the modulation, in turns  */
    double x[IMPACT_SERIES], white[IMPACT_SERIES]; /* of the one before       */
};

/* A pure function of law, seed and the contact's name. The first impact that impact_series_next gives is the first that
 * is not over at time 0. */
void impact_series_open(const struct impact_law *l, uint64_t seed, const char *contact, struct arena *a,
                        struct impact_series *s);

void impact_series_next(struct impact_series *s, struct impact *i);

/* Does an impact begin before the one before is over? `distance`: s, between their middles, known within `grain`;
   durations in s. Impacts that follow each other without a gap may meet by rounding, and do not overlap: they touch. */
bool impact_series_overlap(double distance, double before, double now, double grain);

struct impact_report {                        /* of a whole render; count 0: no series of impacts                    */
    long count;                               /* impacts laid on the board                                            */
    long limited_amplitude, limited_interval; /* draws raised to their floors                       */
    long overlaps;                            /* impacts that begin before the one before is over                     */
    double time;                              /* s in which they come                                                 */
    double mean_amplitude, mean_interval;     /* N, s                                                   */
    double longest;                           /* s, duration of the longest one                                       */
};

/* The impacts of a contact that take place, and what is to be reported of them. Whoever needs them draws them anew: the
 * force, the listing, the table. */
struct impact_train {
    struct impact_law law;
    struct impact_series series;
    struct impact next; /* the next one, if there is any            */
    bool any;
    double end;       /* s, of the motion                         */
    double before[2]; /* s: interval and duration of the last one */
    double sums[2];   /* of amplitudes, N, and intervals, s       */
    struct impact_report report;
};

/* Of a stage's contact; the motion is on the board. Errors: those of impact_law_make; ERR_SCENE: impacts that last
 * longer than 10 s. */
bool impact_series_train(const struct stage_run *r, struct impact_train *t, struct err *e);

/* Takes `next`, which there is, and looks for the one after it. The report is that of all that have been taken. */
struct impact impact_series_take(struct impact_train *t);

/* What a stage reports of those that it has taken. */
struct stage_report impact_series_report(const struct impact_report *o, struct arena *a);

#endif

/* Short parts of a contact's motion, run up to its force only: how large the sound is that they make, and how far that
 * of two settings is apart. */
#ifndef PIPELINE_SEGMENTS_H
#define PIPELINE_SEGMENTS_H
#include "pipeline/plan.h"

enum { AUDIBLE_BINS = 513 }; /* from 0 to half the sample rate */
enum { SEGMENTS_WINDOW = 2 * (AUDIBLE_BINS - 1), SEGMENTS_LEAST = 5, SEGMENTS_MOST = 9, SEGMENTS_PLACES = 3 };

struct segments_stretch {
    long from, frames; /* of the contact; SEGMENTS_WINDOW or more */
    double weight;     /* by which its energy stands for the motion's */
    double place[2];   /* m, about its middle                     */
    int weighting;     /* which of the powers                     */
};

struct segments {
    struct scene scene;     /* that asks for the force alone           */
    struct contact contact; /* of it                                   */
    struct plan plan;
    unsigned knobs; /* those that the force depends on         */
    struct segments_stretch stretch[SEGMENTS_MOST];
    int n;
    long frames;             /* of all stretches together               */
    long moving;             /* of the whole motion                     */
    long lead;               /* before each stretch                     */
    bool settled;            /* lead is known                           */
    double drift;            /* by which errors may grow beyond what is run: 1, but of a coupled ball */
    double gain;             /* of the contact                          */
    double *power;           /* [SEGMENTS_PLACES][AUDIBLE_BINS]         */
    long bounces, lift_offs; /* of a coupled ball, as far as it was run */
};

/* Which parts: where a force is read from the ground, SEGMENTS_MOST short ones (of a short motion fewer), spread over
   the motion as the square of its speed is, the fastest among them; of impacts, forces from files and coupled balls,
   which come in order, the motion's first `first` seconds. moves: the response changes on the way. */
bool segments_make(const struct scene *s, const struct contact *c, double first, bool moves, struct arena *a,
                   struct segments *x, struct err *e);

/* The force at these settings, [frames] in N, stretch after stretch. */
bool segments_run(struct segments *x, const struct accuracy *set, double *force, struct err *e);

/* Would it be run, as far as stages tell when they are opened? */
bool segments_can(struct segments *x, const struct accuracy *set, struct err *e);

/* Energy of the sound that the force makes, of the whole motion as the stretches stand for it. */
double segments_energy(const struct segments *x, const double *force);

#endif

/* What two settings of a knob make of a contact's force, heard: the energy of their difference, block by block of the
   motion.

   A block is a window of PILOT_WINDOW frames, sin^2, one each PILOT_HOP. Its energy is that of the sound that the force
   makes of it:

     E(x) = sum over bins of |FFT(w x)|^2 |H|^2        H  the contact's response (audible_power)

   Every block of the motion is in a survey; the ones that differ most there, and a few spread evenly, are followed to
   finer settings. So an instant where the force has a kink cannot be missed: it is a block that sticks out. */
#ifndef PIPELINE_ERROR_PILOT_H
#define PIPELINE_ERROR_PILOT_H
#include "pipeline/plan.h"

enum { PILOT_WINDOW = 1024, PILOT_HOP = PILOT_WINDOW / 2, PILOT_BINS = PILOT_HOP + 1, PILOT_PLACES = 3 };
enum { PILOT_WORST = 3, PILOT_SPREAD = 5, PILOT_FOLLOWED = PILOT_WORST + PILOT_SPREAD };

struct pilot_block {
    long number;            /* -1: none */
    double x[PILOT_WINDOW]; /* the force at the last setting */
    double distance[2];     /* between the last two settings, and between the two before */
};

struct error_pilot {        /* of one contact */
    struct scene scene;     /* that asks for the force alone */
    struct contact contact; /* of it */
    struct plan plan;
    unsigned knobs;     /* those that the force depends on */
    long moving, some;  /* frames of the motion; of what is run of it */
    bool follows;       /* blocks are followed; else all are run at each setting, in their order */
    long lead;          /* frames before a block that is begun with; 0: not known yet */
    double gain, drift; /* drift: by which errors may grow beyond what is run: 1, but of a coupled ball */
    double *power;      /* [PILOT_PLACES][PILOT_BINS] |H|^2 */
    int places;
    long blocks;
    int runs;     /* so far */
    double *last; /* [some] the force at the last setting of a survey; NULL: it is too long, and run again */
    double *distance, *older;  /* [blocks] between the last two settings, and between the two before: of a survey */
    double energy;             /* of the whole */
    struct pilot_block *block; /* [PILOT_FOLLOWED] the worst first */
    long bounces, lift_offs;   /* of a coupled ball, as far as it was run */
};

/* some: s that are run of a coupled ball. moves: the response changes on the way. */
bool error_pilot_make(const struct scene *s, const struct contact *c, double some, bool moves, struct arena *a,
                      struct error_pilot *p, struct err *e);

/* The whole motion at a setting and at a finer one (NULL: there is none, and distances are the energies): distances,
   energy, and which blocks are followed from there. going: the last survey ended with `set`. */
bool error_pilot_whole(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, bool going,
                       struct err *e);

/* Energy of the difference between a survey's settings. */
double error_pilot_whole_distance(const struct error_pilot *p);

/* The blocks followed, at the next setting. */
bool error_pilot_follow(struct error_pilot *p, const struct accuracy *set, struct err *e);

/* Energy of the difference between the last two settings, of the whole motion as the blocks stand for it; of a block at
   least a sixteenth of that before, where there was one (history): what agrees by accident is not believed. */
double error_pilot_distance(const struct error_pilot *p, bool history);

/* Would it be run, as far as stages say when they are opened? */
bool error_pilot_can(struct error_pilot *p, const struct accuracy *set, struct err *e);

#endif

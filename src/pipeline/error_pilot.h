/* What two settings of a knob make of a contact's force, heard: the energy of their difference, block by block of the
   motion.

   A block is a window of sin^2, one each half of it: of 4096 frames, whose bins are as narrow as most that rings, or,
   of a sampled pilot, of 1024. Its energy is that of the sound that the force makes of it:

     E(x) = sum over bins of |FFT(w x)|^2 |H|^2        H  the contact's response (audible_power)

   The three coarsest settings of a knob are run over the whole motion. From there on only some blocks are: those whose
   difference will be greatest, if it goes on to fall as it fell between these three, and some spread evenly.

   A sampled pilot runs PILOT_SAMPLED blocks spread evenly, which stand for all, and those of the two ends, where the
   force has kinks: one in between it does not see. Under a round tip it runs half as many, for the ground costs most
   there. A force that cannot begin anywhere is run in its beginning. */
#ifndef PIPELINE_ERROR_PILOT_H
#define PIPELINE_ERROR_PILOT_H
#include "pipeline/plan.h"

enum { PILOT_WINDOW = 4096, PILOT_WINDOW_SAMPLED = 1024, PILOT_BINS = PILOT_WINDOW / 2 + 1, PILOT_PLACES = 3 };
enum { PILOT_WORST = 8, PILOT_SPREAD = 8, PILOT_FOLLOWED = PILOT_WORST + PILOT_SPREAD };
#define PILOT_LONGEST 60.0 /* s of what rings */
enum { PILOT_SAMPLED = 4, PILOT_ENDS = 3, PILOT_SETTINGS = 16, PILOT_STRETCH = 4096 };

struct pilot_block {
    long number;
    double x[PILOT_WINDOW]; /* the force at the last setting */
};

struct pilot_sample { /* what a sampled pilot ran */
    struct accuracy set;
    struct pilot_block *block; /* [followed]; NULL: none */
};

struct error_pilot {        /* of one contact */
    struct scene scene;     /* that asks for the force alone */
    struct contact contact; /* of it */
    struct plan plan;
    struct arena *arena;
    unsigned knobs;        /* those that the force depends on */
    long start;            /* frame of the sound at which the motion begins */
    long moving, some;     /* frames of the motion; of what is run of it */
    double gain, drift;    /* drift: by which errors may grow beyond what is run: 1, but of a coupled ball */
    int window, hop, bins; /* frames of a block; half of them; bins of its spectrum */
    double *taper;         /* [window] sin^2 */
    double *power;         /* [places][bins] |H|^2 */
    int places;
    long blocks;
    bool sampled;
    bool silent;  /* it is the force that is listened to */
    bool follows; /* the force can begin anywhere, and the motion is long enough for that */
    int followed; /* blocks then */
    long lead;    /* frames before a block that is begun with */
    int runs;     /* so far */
    int pairs;    /* of settings that were compared, one going on where the other ended */
    double *last; /* [some] the force at the last setting of a survey; NULL: it is too long, and run again */
    double *distance, *older; /* [blocks] between the last two settings, and between the two before: of a survey */
    double *falls;            /* [blocks] by which the distance is taken to fall at the next doubling */
    double energy, shown;     /* of the whole; of the force under output.ramp, as error_pilot_shown has it */
    struct pilot_sample ran[PILOT_SETTINGS];
    int next;                  /* of ran, the one to take next */
    struct pilot_block *block; /* [PILOT_FOLLOWED] those that are run, in order of their numbers; NULL: all are */
    long bounces, lift_offs;   /* of a coupled ball, as far as it was run */
    long fastest;              /* frame at which the fastest PILOT_STRETCH frames of the motion begin */
};

/* some: s that are run of a coupled ball, and of a sampled pilot that does not follow blocks. moves: the response
   changes on the way. */
bool error_pilot_make(const struct scene *s, const struct contact *c, double some, bool moves, bool sampled,
                      struct arena *a, struct error_pilot *p, struct err *e);

/* The scene with this contact alone, and no files beside the sound. */
void error_pilot_alone(struct scene *s, struct contact *c);

/* Gain of output.ramp at a frame of the sound: where it begins, and where output.duration ends it. */
double error_pilot_shown(const struct scene *s, long frame);

/* The contact without surface.residual. */
void error_pilot_drop_residual(struct contact *c, struct arena *a);

/* The motion at a setting and at a finer one (NULL: there is none, and distances are the energies): distances and
   energy. going: the last run ended with `set`, so that after two pairs only some blocks need be run. */
bool error_pilot_run(struct error_pilot *p, const struct accuracy *set, const struct accuracy *finer, bool going,
                     struct err *e);

/* Energy of the difference between the two settings; of a block at least a sixteenth of that between the two before,
   where there were such (history): what agrees by accident is not believed. */
double error_pilot_distance(const struct error_pilot *p, bool history);

/* Would it be run, as far as stages say when they are opened? */
bool error_pilot_can(struct error_pilot *p, const struct accuracy *set, struct err *e);

#endif

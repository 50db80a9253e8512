/* A listener that is a program: it distinguishes motions by how level and brightness change over time, or materials by
   how fast a sound fades and how bright it is, and chooses among classes of which it knows some sounds, the templates.
   See machine_listener.c. */
#ifndef ANALYSIS_MACHINE_LISTENER_H
#define ANALYSIS_MACHINE_LISTENER_H
#include "base/arena.h"
#include "file/wav.h"

enum machine_listener_cue { MACHINE_LISTENER_MOTION, MACHINE_LISTENER_MATERIAL };
extern const char *const machine_listener_cues[]; /* their words; end with NULL */

struct machine_listener_sound {
    int n;                        /* frames of 25 ms from the first to the last that is above the floor; 0: silent */
    const double *track[2];       /* [n] level, dB re the loudest frame; log2 of the centroid in Hz; smoothed */
    double mean[2], deviation[2]; /* of these, with what of a change is not audible added to the second               */
    double fade, colour; /* log2 of its decay in dB/s, from the loudest frame on, and of its mean centroid in Hz  */
    int class;           /* as the caller numbers them                                                         */
    int cue;             /* what it is compared by, as the caller chooses: of all sounds the same                */
};

/* All channels together. ERR_SCENE: no frame sounds. path: for the message */
bool machine_listener_hear(const char *path, const struct wav *w, struct arena *a, struct machine_listener_sound *s,
                           struct err *e);

/* By motion: mean square difference of the two sounds' normalised tracks; 0: the same, about 2: nothing in common.
   By material: the sum of squares of what lies between them in fade and colour, in octaves. */
double machine_listener_distance(const struct machine_listener_sound *a, const struct machine_listener_sound *b);

/* share[classes] of answers: exp(-d/(2 spread)) of the least distance d to a template of the class, over their sum.
   skip: a template that is left out (the sound itself); -1: none. Every class needs a template besides it. */
void machine_listener_choose(const struct machine_listener_sound *s, const struct machine_listener_sound *templates,
                             int n, int skip, int classes, double spread, double *share);

/* The mean of templates' least distances to others of their class; NAN: a class has one template only. */
double machine_listener_spread(const struct machine_listener_sound *templates, int n);

#endif

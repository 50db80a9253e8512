/* A listener that is a program: it distinguishes motions by how level and brightness change over time, and chooses
   among classes of which it knows some sounds, the templates. See machine_listener.c. */
#ifndef ANALYSIS_MACHINE_LISTENER_H
#define ANALYSIS_MACHINE_LISTENER_H
#include "base/arena.h"
#include "file/wav.h"

struct machine_listener_sound {
    int n;                        /* frames of 25 ms from the first to the last that is above the floor; 0: silent */
    const double *track[2];       /* [n] level, dB re the loudest frame; log2 of the centroid in Hz; smoothed */
    double mean[2], deviation[2]; /* of these, with what of a change is not audible added to the second               */
    int class;                    /* as the caller numbers them */
};

/* All channels together. ERR_SCENE: no frame sounds. path: for the message */
bool machine_listener_hear(const char *path, const struct wav *w, struct arena *a, struct machine_listener_sound *s,
                           struct err *e);

/* Mean square difference of the two sounds' normalised tracks; 0: the same, about 2: nothing in common. */
double machine_listener_distance(const struct machine_listener_sound *a, const struct machine_listener_sound *b);

/* share[classes] of answers: exp(-d/(2 spread)) of the least distance d to a template of the class, over their sum.
   skip: a template that is left out (the sound itself); -1: none. Every class needs a template besides it. */
void machine_listener_choose(const struct machine_listener_sound *s, const struct machine_listener_sound *templates,
                             int n, int skip, int classes, double spread, double *share);

/* The mean of templates' least distances to others of their class; NAN: a class has one template only. */
double machine_listener_spread(const struct machine_listener_sound *templates, int n);

#endif

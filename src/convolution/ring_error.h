/* The error that interpolation of a response over hops makes along a motion, measured on the response itself. */
#ifndef CONVOLUTION_RING_ERROR_H
#define CONVOLUTION_RING_ERROR_H
#include "convolution/ring_survey.h"

enum ring_error_kind {
    RING_ERROR_LAUNCH,  /* nodes share the force: launch.h, overlap_add.h                        */
    RING_ERROR_READOUT, /* nodes share the sound: readout.h                                      */
    RING_ERROR_RAMP,    /* order 2 of gains, nodes one frame early: resonators.h, poles fixed    */
    RING_ERROR_GLIDE    /* ... and of discrete poles                                             */
};

struct ring_error_ask {
    enum ring_error_kind kind;
    int order, hop;      /* 1, 2 or 4; frames                                                    */
    double rate;         /* Hz                                                                   */
    double until;        /* s, of the response that is computed; HUGE_VAL: all                   */
    double end;          /* s after the motion's start nothing is heard any more; HUGE_VAL: that is not known */
    const bool *skip;    /* [n] modes that are not wanted; NULL: all are                         */
};

/* Energies, mode by mode, for a white force: of the error, and of the sound (those of modes that are skipped stay as they are). */
void ring_error(const struct ring_survey *s, const struct ring_error_ask *ask, double *wrong, double *whole);

/* Relative rms error of all modes together. */
double ring_error_all(const struct ring_survey *s, const struct ring_error_ask *ask);

#endif

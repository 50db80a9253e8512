/* Strikes in a recording. */
#ifndef ANALYSIS_STRIKES_H
#define ANALYSIS_STRIKES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct strikes_channel {
    const double *x; /* [n of the recording], quantity per full scale already applied */
    double full;     /* the greatest value that the file can hold, in x's unit: what reaches it is clipped; INFINITY:
                        floating point */
    double offset;   /* that strikes_find took off */
    double clip[2];  /* levels below and above at which it clips all the same; 0: it does not */
};

struct strikes_recording {
    const char *name;                    /* file, for messages */
    struct strikes_channel sound, force; /* force: N; its x NULL: no channel holds it */
    long n;
    double rate;     /* Hz */
    double rounding; /* rms of what the file's steps do to the sound; 0: not known */
};

struct strikes_one {
    long onset; /* sample, of the force's or, without, the sound's beginning */
    long over; /* sample: the force has ended, of a doubled strike that of its second pulse; without force the onset, of
                    a doubled strike the second */
    long clear;            /* sample: the sound does not clip any more */
    long end;              /* sample: next strike's onset less a margin, or the end of the recording */
    double base;           /* N: the force channel's offset just before */
    double peak, momentum; /* of the force: N, N s; else of the sound and NAN */
    bool clipped, doubled;
    const char *left_out; /* why it is not fitted; NULL: it is */
};

struct strikes {
    int n, used;                /* used: are not left out */
    struct strikes_one *strike; /* [n] by onset */
    const char *note;           /* lines; NULL */
};

/* Takes a considerable offset off the channels, turns the force upwards (both in copies), and finds where they clip and
   what strikes there are. threshold: dB by which an onset's short-time level rises above the noise. ERR_SCENE: silent
   (nothing above the noise, or all 0), clipped throughout, no strike, shorter than 10 ms: what is wrong and what to
   do. */
bool strikes_find(struct strikes_recording *r, double threshold, struct arena *a, struct strikes *s, struct err *e);

/* A recording that is an impulse response already, as one strike: its delay (s) is taken off; of NAN what is silent
   before it. ERR_SCENE: it is silent, or shorter than 10 ms. */
bool strikes_response(struct strikes_recording *r, double delay, struct arena *a, struct strikes *s, struct err *e);

/* How long the sound of all strikes rings, s: until the loudest has sunk into the noise, and as much longer as 20 dB
 * more take. */
double strikes_ringing(const struct strikes_recording *r, const struct strikes *s);

/* By which the sound comes after the force, s: the median over strikes. */
double strikes_delay(const struct strikes_recording *r, const struct strikes *s);

#endif

/* Strikes in a recording. */
#ifndef ANALYSIS_STRIKES_H
#define ANALYSIS_STRIKES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct strikes_recording {
    const char *name;    /* file, for messages */
    const double *sound; /* [n], quantity per full scale already applied */
    const double *force; /* [n] N; NULL: no channel holds it */
    long n;
    double rate; /* Hz */
    double full; /* the greatest value that the file can hold, in the sound's and the force's own unit: what reaches it
                    is clipped; INFINITY: floating point */
    double force_full;
    double offset, force_offset; /* that strikes_channel.h took off */
    double clip[2],
        force_clip[2]; /* levels below and above at which a channel clips (strikes_channel.h); 0: it does not */
    double rounding;   /* rms of what the file's steps do to the sound; 0: not known */
};

struct strikes_one {
    long onset;  /* sample, of the force's or, without, the sound's beginning */
    long over;   /* sample: the force has ended (of a doubled strike its second pulse too); without force the onset */
    long end;    /* sample: next strike's onset less a margin, or the end of the recording */
    double base; /* N: the force channel's offset just before */
    double peak, momentum; /* of the force: N, N s; else of the sound and NAN */
    bool clipped, doubled;
    const char *left_out; /* why it is not fitted; NULL: it is */
};

struct strikes {
    int n;
    struct strikes_one *strike; /* [n] by onset */
    double sign;                /* -1: the force channel points down, and is taken the other way round */
    const char *note;           /* lines; NULL */
};

struct strikes_options {
    double threshold; /* onset: rise of the short-time level above the noise, dB; 20 */
    double gap;       /* s, strikes closer than that are one doubled strike (a bouncing hammer); 0.05 */
};
extern const struct strikes_options strikes_options;

/* ERR_SCENE: silent (nothing above the noise, or all 0), clipped throughout, no strike, shorter than 10 ms: what is
 * wrong and what to do. */
bool strikes_find(const struct strikes_recording *r, const struct strikes_options *o, struct arena *a,
                  struct strikes *s, struct err *e);

/* How long the sound of all strikes rings, s: until the loudest has sunk into the noise, and as much longer as 20 dB
 * more take. */
double strikes_ringing(const struct strikes_recording *r, const struct strikes *s, struct arena *a);

/* By which the sound comes after the force, s: the median over strikes. */
double strikes_delay(const struct strikes_recording *r, const struct strikes *s, struct arena *a);

#endif

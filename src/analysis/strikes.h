/* Strikes in a recording, and the response that they have in common. */
#ifndef ANALYSIS_STRIKES_H
#define ANALYSIS_STRIKES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct strikes_recording {
    const char *name;       /* file, for messages */
    const double *sound;    /* [n], quantity per full scale already applied */
    const double *force;    /* [n] N; NULL: no channel holds it */
    long n;
    double rate;            /* Hz */
    double delay;           /* s, by which the sound comes after the force (the way to the microphone); NAN: to be found */
    double full;            /* the greatest value that the file can hold, in the sound's and the force's own unit: what reaches it is clipped; INFINITY: floating point */
    double force_full;
    double offset, force_offset;   /* that strikes_channel.h took off */
    double clip[2], force_clip[2]; /* levels below and above at which a channel clips (strikes_channel.h); 0: it does not */
    double rounding;        /* rms of what the file's steps do to the sound; 0: not known */
};

struct strikes_one {
    long onset;             /* sample, of the force's or, without, the sound's beginning */
    long over;              /* sample: the force has ended (of a doubled strike its second pulse too); without force the onset */
    long end;               /* sample: next strike's onset less a margin, or the end of the recording */
    double base;            /* N: the force channel's offset just before */
    double peak, momentum;  /* of the force: N, N s; else of the sound and NAN */
    bool clipped, doubled;  /* clipped ones are left out, unless all are; so are doubled ones without force (with it, both pulses are divided out) */
};

struct strikes {
    int n;
    struct strikes_one *strike;  /* [n] by onset */
    double sign;            /* -1: the force channel points down, and is taken the other way round */
    double force_noise;     /* N rms */
    const char *note;       /* lines; NULL */
};

struct strikes_options {
    double threshold;       /* onset: rise of the short-time level above the noise, dB; 20 */
    double gap;             /* s, strikes closer than that are one doubled strike (a bouncing hammer); 0.05 */
};
extern const struct strikes_options strikes_options;

/* ERR_SCENE: silent (nothing above the noise, or all 0), clipped throughout, no strike, shorter than 10 ms: what is wrong and what to do. */
bool strikes_find(const struct strikes_recording *r, const struct strikes_options *o, struct arena *a, struct strikes *s, struct err *e);

struct strikes_response {
    long n, noise_n;
    long length;            /* samples that h holds: beyond n it has sunk into the noise */
    double *h;              /* [length] impulse response, sound's unit per N s; without force: of a strike whose sound's peak is 1 */
    double *noise;          /* [noise_n] what the same processing makes of the recording where nothing rings */
    double low, high;       /* Hz, where the force holds enough and the strikes agree; without force: 0, rate/2 */
    double *unsure;         /* [n/2 + 1] |FFT|^2/n of h's own error, as far as strikes disagree; NULL with one strike */
    double *coherence;      /* [n/2 + 1] share of the sound that the response explains, strikes together; NULL with one strike */
    double *explained;      /* [strikes] the same share of each strike's sound over h's length, all frequencies, noise off; 0 where what is left is more than the sound; NAN where the
                               strike is left out */
    int used;
    double delay;           /* s, by which the sound comes after the force, taken off so that h begins at 0 */
    double smear;           /* s, within which h is not sharp, for want of high frequencies: modes are to be fitted to what comes later */
    double regularisation;  /* that was used */
    double rounding;        /* rms of what the recording's rounding does to h, at least */
    const char *note;       /* lines; NULL */
};

/* Divides out the force. Where strikes stand alone, H = sum conj(F) X / (sum |F|^2 + regularisation); where one begins before the last has rung out, the least
   squares of x = f * h over the whole recording (strikes_response.c). The regularisation is a share of the greatest sum |F|^2, so that nothing is raised that the
   hammer does not hold; NAN: that of the force's noise, at least 1e-6. ERR_SCENE: no strike can be used. */
bool strikes_response(const struct strikes_recording *r, const struct strikes *s, double regularisation, struct arena *a, struct strikes_response *h, struct err *e);

#endif

/* Parts of strikes_response: strikes_response.c puts them together. */
#ifndef ANALYSIS_STRIKES_RESPONSE_H
#define ANALYSIS_STRIKES_RESPONSE_H
#include "analysis/strikes.h"
#include "analysis/strikes_solve.h"

struct strikes_job {
    const struct strikes_recording *r;
    const struct strikes *s;
    struct arena *a;
    struct strikes_response *h;
    struct strikes_system system;
    bool *used;              /* [strikes] */
    long size;               /* of the system's transforms */
    double most;             /* the greatest power */
    double floor;            /* the power that the force's noise would have */
    long quiet_from, quiet_to; /* samples of the sound where nothing rings; equal: not known */
    double *left;            /* [n] sound less what the response makes of the force; unit of the sound */
};

/* Sets the system's force, power, weight and lag, and most and floor, by the strikes that are used (strikes_system.c). */
void strikes_system(struct strikes_job *j);

/* Samples that the response may have: until the sound has sunk into the noise where it does between strikes, else the longest pause. */
long strikes_end_length(const struct strikes_job *j);

/* Sets n: until the response has sunk into its noise, and a size that transforms well. */
void strikes_end(const struct strikes_job *j);

/* Sets low, high: the third octaves around that of the strongest sound, with gaps of at most one, in which the force's least power is within 40 dB of
   the greatest and 10 dB above its noise, and the sound's 6 dB above its noise (where that is not known: in which the response explains at least a third of the sound). */
void strikes_band(struct strikes_job *j);

/* x[n] in place, n any even number: what lies above j->h->high is faded out over a third octave, without phase. shape, if not NULL: also multiplied by that, [bins of
   strikes_solve_size] (real). */
void strikes_band_fade(const struct strikes_job *j, double *x, long n, bool shaped);

/* The share of a strike's sound, over the response's length and without what is noise, that the response explains. */
double strikes_response_explained(const struct strikes_job *j, const struct strikes_one *v);

/* Coherence, the response's error and each strike's explained share. */
void strikes_band_coherence(struct strikes_job *j);

#endif

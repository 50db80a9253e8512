/* The modes of an object from recordings of strikes on it. */
#ifndef ANALYSIS_MODAL_H
#define ANALYSIS_MODAL_H
#include <stdbool.h>

#include "analysis/modal_complex.h"
#include "base/arena.h"
#include "base/err.h"

struct modal_pulse { /* a strike's force */
    long at, n;      /* samples of the recording */
    const double *f; /* [n] */
};

struct modal_stretch {        /* part of a recording, after a strike, or before the first (a lead) */
    const double *y;          /* [n] */
    long first, n;            /* samples of the recording; n even and of small factors (modal_length) */
    long ringing;             /* samples into the stretch from which on nothing pushes */
    int place, strike;        /* strike -1: a lead */
    bool fitted;              /* false: its poles are those of the fitted ones, its gains its own; a lead has neither */
    bool idle;                /* not even gains */
    double rounding;          /* rms of the file's steps; no noise is less */
    struct modal_pulse pulse; /* none: n 0 */
};

struct modal_data {
    double rate; /* Hz */
    int places, stretches;
    const struct modal_stretch *stretch;
};

struct modal_options {
    int most;         /* modes */
    double low, high; /* Hz */
    double fastest;   /* 1/s, of decays */
    bool spectrogram; /* candidates from peaks of the power spectrogram (papers/003 section B) instead of sub-band
                         ESPRIT */
};

struct modal_gain { /* h(t) = Im A e^(s t), t from the force's sample, or from the stretch's first */
    cplx a;
    double se, shared; /* of |A|: a strike's own standard error, and by the poles, of all strikes alike */
};

struct modal_mode {
    double frequency, decay;                 /* Hz, 1/s */
    double frequency_se, decay_se;           /* standard errors from noise */
    struct modal_gain *gain;                 /* [stretches] */
    double frequency_between, decay_between; /* standard deviations from strike to strike */
    double share;                            /* of the energy of all modes together */
    int component;                           /* of the fit */
    int mode, slope;                         /* from 1 by falling share; slopes of one mode from 1 */
};

struct modal_result {
    int n, modes, undamped;  /* components, modes, lines that do not decay and are left out */
    struct modal_mode *mode; /* [n] */
    double *explained;       /* [stretches] share of the energy in the band, noise and what is direct taken off */
    double *fitted;   /* [stretches] the same of the fit, with modes that are weaker than those that are wanted */
    double *direct;   /* [stretches] share of what follows the force at once: smooth in frequency but for the force */
    double *noise;    /* [places] rms of the noise in the band */
    double **model;   /* [stretches][n] the modes' sound */
    const char *note; /* lines; NULL */
};

/* Longest stretch of at most n samples that the fit takes; 0: too short. */
long modal_length(long n);

/* Gains of n poles that are given, strike by strike: gain[n][stretches], A as in modal_gain. */
void modal_gains(const struct modal_data *d, const struct modal_options *o, int n, const cplx *pole, cplx *gain);

bool modal_find(const struct modal_data *d, const struct modal_options *o, struct arena *a, struct modal_result *r,
                struct err *e);

#endif

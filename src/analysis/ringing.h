/* Impulse responses of one object, and the modes that are found in them. */
#ifndef ANALYSIS_RINGING_H
#define ANALYSIS_RINGING_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct ringing {              /* h_p(t), sample 0 at t = 0 (the strike), of one object touched or heard at several places */
    int places;
    long n;                   /* samples of each */
    double rate;              /* Hz */
    const double *const *h;   /* [places][n] */
    const double *const *noise; /* [places][noise_n] the same channel where nothing rings (before the strike), NULL or noise_n 0: not known */
    long noise_n;
    const double *const *unsure; /* [places][n/2 + 1] |FFT|^2/n of the error that h has besides noise, as strikes that differ make it; NULL: not known */
    const double *rounding;   /* [places] rms of what the file's steps did to h: no noise is less; NULL: not known */
    double low, high;         /* Hz: the band in which h means anything (a hammer's reach); 0, rate/2: all */
};

enum { RINGING_SLOPES = 2 };

struct ringing_mode {         /* sum over slopes and the place's gain: gain e^(-decay t) sin(2 pi f t + phase) */
    double frequency, decay;  /* Hz, 1/s: the same at every place */
    double *re, *im;          /* [places] complex gain A = gain e^(j phase), h(t) = Im A e^(s t) */
    double frequency_error, decay_error; /* standard errors (linearised: noise variance of its band times the inverse of the Fisher matrix) */
    double *gain_error;       /* [places] of |A|; of the phase it is gain_error / gain rad */
    double energy;            /* sum over places of |A|^2 / (4 decay) */
    int mode, slope;          /* modes are numbered from 1 by falling energy; slopes of one mode (two components of one frequency) from 1 */
};

struct ringing_modes {
    int n;                    /* components, by falling energy of their mode */
    int modes;
    struct ringing_mode *mode;
    double *explained;        /* [places] share of the energy of h (in the band, noise taken off) that they hold together */
    double *noise;            /* [places] rms of what is taken for noise, of the whole band */
    const char *note;         /* lines; NULL */
};

struct ringing_options {
    int most;                 /* modes; 50 */
    double low, high;         /* Hz, to look between */
    double slope_test;        /* a second slope is taken where it lowers the residual of its band by more than chance allows (F test at this level, 1e-6); 0: never */
    double confidence;        /* components whose F test against noise fails at this level are left out; 1e-6 */
    double threshold;         /* of the spectrogram's method: greatest error of the local fit, share of its energy; 0.1 */
};
extern const struct ringing_options ringing_options;

/* Sub-band ESPRIT (shared poles over places), merged, then joint least squares of all gains and Gauss-Newton steps of all poles: ringing_esprit.c. */
bool ringing_esprit(const struct ringing *r, const struct ringing_options *o, struct arena *a, struct ringing_modes *m, struct err *e);

/* papers/003 section B: peaks of the power spectrogram (equation 6), fit of the local shape, threshold on its error; gains and errors by the same joint least squares. */
bool ringing_spectrogram(const struct ringing *r, const struct ringing_options *o, struct arena *a, struct ringing_modes *m, struct err *e);

/* The modes' sound at a place: y[n], and what is left. */
void ringing_sound(const struct ringing_modes *m, int place, double rate, long n, double *y);

#endif

/* The noise around each component. */
#ifndef ANALYSIS_RINGING_NOISE_H
#define ANALYSIS_RINGING_NOISE_H
#include "analysis/ringing_fit.h"
#include "num/fft.h"

struct ringing_noise {
    int places;
    long bins;             /* of the residual's periodogram, width rate/size each */
    double width;          /* Hz */
    struct fft *fft;       /* of the periodogram */
    double *least;         /* [places] of any level: rounding */
    const double *const *unsure; /* [places][unsure_bins + 1] level of the response's error, NULL: not known */
    long unsure_bins;
    double doubt;          /* the share of it that counts: 1 */
    double *given;         /* [places][given_bins + 1] level where nothing rings, NULL: not known */
    long given_bins;
    double given_width;
};

/* Takes r->noise, if there is any. */
void ringing_noise_open(const struct ringing *r, struct arena *a, struct ringing_noise *s);
void ringing_noise_close(struct ringing_noise *s);

/* Of the fit's residual: variance[places][m], as of one sample of white noise that is as strong there; freedom[m] degrees of freedom behind one of them. */
void ringing_noise_levels(const struct ringing_noise *s, const struct ringing_fit *f, double *variance, double *freedom);

/* Level of the noise that is given at a frequency, mean of three bins. */
double ringing_noise_given(const struct ringing_noise *s, int place, double hertz);

/* Energy of x[n] between two frequencies. */
double ringing_noise_energy(const double *x, long n, double rate, const double band[2]);

#endif

/* A sampled envelope A(tau) as a sum of real exponentials: how arbitrary envelopes (papers/000 equation 10) become
 * modes of several slopes. */
#ifndef RESPONSE_SLOPES_H
#define RESPONSE_SLOPES_H

enum { SLOPES_MOST = 6 };

struct slopes_series {              /* one envelope */
    int n;                          /* samples, at least 2 */
    const double *time, *amplitude; /* s, increasing from 0 or later; any sign */
    double gain[SLOPES_MOST];       /* out: A(t) ~ sum gain[k] e^(-decay[k] t), 0 beyond the fit's n */
};

struct slopes_fit {
    int n;                     /* 1 to SLOPES_MOST, at most half the samples of the shortest series */
    double decay[SLOPES_MOST]; /* 1/s, increasing */
    double error;              /* rms of what is left / rms of the amplitudes, over all samples */
};

/* The decays that suit all series at once (their gains differ). As many as bring the error below 1e-3, or as make it
   fall. Amplitudes that are all 0: one slope of gain 0. See slopes.c. */
struct slopes_fit slopes_fit(struct slopes_series *series, int count);

#endif

/* Least squares of all poles and gains over all of a response. */
#ifndef ANALYSIS_RINGING_FIT_H
#define ANALYSIS_RINGING_FIT_H
#include <complex.h>

#include "analysis/ringing.h"
#include "analysis/ringing_basis.h"

#define RINGING_FIT_ROUNDING 1e-10 /* of a response's level: phases omega t of 1e5 rad and more are known to no more than that */
#define RINGING_FIT_FASTEST 0.25 /* decay over the rate: what is gone in four samples is no mode, but the edge of something else */

struct ringing_fit {
    const struct ringing *r;
    struct ringing_basis basis;
    int m, most;               /* components now, and room; component 0 is the constant: omega = decay = 0, held */
    double *decay, *omega;     /* [most] 1/s, rad/s */
    bool *held;                /* [most] the pole is not moved */
    int *tie;                  /* [most] -1, or the component whose omega it shares */
    bool *fresh;               /* [most] added, or moved, since its block was last looked at (ringing_blocks.h) */
    bool part;                 /* one block of a greater fit, r->h what the others leave */
    bool *guest;               /* [most] of a part: lent by the next block, moves, but is not judged here */
    int *origin;               /* [most] of a part: index in the greater fit; -1: new */
    double complex *gain;      /* [places][most] h = Re sum gain e^(s t) */
    double *residual;          /* [places][n] */
    double *energy;            /* [places] of the residual, sum of squares */
    double *least;             /* [places] of what is no more than rounding */
    double *weight;            /* [places] 1/variance of the residual, or of rounding */
    struct arena *a;           /* of what lasts */
};

struct ringing_fit_errors {    /* from one noise variance per place and component */
    double *decay, *omega;     /* [m] standard errors; 0 of a held pole */
    double *gain;              /* [places][m] of |gain| */
    double *energy;            /* [m] what the others, their poles held, leave when this one goes, over the noise: chi squared of 2 places degrees if it is nothing */
    double *apart;             /* [m] the same with all poles free */
};

void ringing_fit_open(struct ringing_fit *f, const struct ringing *r, int most, struct arena *a);
/* False: there is no room. Its gain is 0. */
bool ringing_fit_add(struct ringing_fit *f, double decay, double omega);
void ringing_fit_drop(struct ringing_fit *f, const bool *drop);

/* The residual of poles and gains as they are. */
void ringing_fit_sound(struct ringing_fit *f);

/* Gains of the poles as they are, and the residual. */
void ringing_fit_gains(struct ringing_fit *f);

/* At most `steps` damped steps of Gauss and Newton of poles and gains together, until they are a ten-thousandth of what noise does to a pole; returns how far the first went, in squared
   deviations of the residual, summed over all poles. */
double ringing_fit_polish(struct ringing_fit *f, int steps);

/* variance[places][m]: of the noise around each component, of one sample as if it were white. */
void ringing_fit_covariance(struct ringing_fit *f, const double *variance, struct arena *a, struct ringing_fit_errors *e);

#endif

/* Height distributions other than Gaussian: a smooth increasing function of a Gaussian field. */
#ifndef SURFACE_HEIGHTS_H
#define SURFACE_HEIGHTS_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "surface/relief.h"

struct heights { /* H(g) = scale sinh(e + b asinh g) - shift            */
    double e, b, scale, shift;
    double linear;  /* share of the variance that keeps the field's own spectrum */
    double steeper; /* mean of H'(g)^2: what the density of fine detail is multiplied by */
};

/* H with mean 0, variance 1 and that skewness and (plain) kurtosis, under a standard normal g: exact to 1e-9.
   ERR_SCENE, with the range that can be reached, for a distribution that it does not reach. */
bool heights_make(double skewness, double kurtosis, struct heights *h, struct err *e);

/* H, H' and H'' at g[n]. */
void heights_at(const struct heights *h, size_t n, const double *g, double *z, double *slope, double *bend);

/* The kurtoses that go with a skewness. False: none does. */
bool heights_range(double skewness, double range[2]);

/* z = rms H(g) of a part g of unit variance, with all derivatives by the chain rule. Closing it closes g. */
struct relief_part *heights_part(struct arena *a, struct relief_part *g, const struct heights *h, double rms);

#endif

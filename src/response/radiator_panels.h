/* One coordinate cut into panels for Gauss-Legendre's rule, fine enough for what turns and for what is nearly singular.
 */
#ifndef RESPONSE_RADIATOR_PANELS_H
#define RESPONSE_RADIATOR_PANELS_H
#include <stdbool.h>

enum { RADIATOR_PANELS_MOST = 4096, RADIATOR_PANELS_POINTS = 12 /* most in a panel */ };

struct radiator_panels {
    double low, high;
    double wave;         /* rad per unit of the coordinate, by which the integrand turns        */
    double foot, height; /* where it is singular: real part, imaginary part of the coordinate   */
    int n;               /* panels */
    double ends[RADIATOR_PANELS_MOST + 1];
};

/* Adds the panels between low and high: each no wider than 4 pi of phase, and no wider than twice its distance from the
   singularity. False: too many. */
bool radiator_panels_split(struct radiator_panels *x, double low, double high);

/* Nodes and weights, `points` to a panel; returns how many there are. */
int radiator_panels_points(const struct radiator_panels *x, int points, double *at, double *weight);

#endif

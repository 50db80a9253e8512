/* The simplest radiator: a sphere of the object's size whose whole surface moves as the place that is heard does. See
 * radiator_monopole.c. */
#ifndef RESPONSE_RADIATOR_MONOPOLE_H
#define RESPONSE_RADIATOR_MONOPOLE_H
#include <stdbool.h>

struct radiator_monopole {
    double gain; /* Pa per m/s, K = rho c a / r */
    double pole; /* 1/s, w = c / a              */
};

struct radiator_monopole radiator_monopole(double radius, double distance, double density, double sound_speed);

/* H(s), complex. */
void radiator_monopole_at(const struct radiator_monopole *m, const double s[2], double h[2]);

/* The share w / (s + w) K of a mode's complex velocity gain at pole s that goes to the radiator's own pole. */
void radiator_monopole_own(const struct radiator_monopole *m, const double s[2], double share[2]);

/* Is the own pole slow enough to be sampled? */
bool radiator_monopole_sampled(const struct radiator_monopole *m, double rate);

#endif

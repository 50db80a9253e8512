/* What others ask of the smoothing. */
#ifndef FORCE_SMOOTH_H
#define FORCE_SMOOTH_H
#include <stdbool.h>

#include "scene/scene.h"

/* s, sigma of a smoothing of the force whose width is constant; 0: there is none, or it varies. */
double smooth_still(const struct contact *c);

/* y[i] = sum over j of tap[j] x[i + j], i < n, and what was in y[i] where it adds. x is read up to 32 values further.
 */
void smooth_taps(const double *tap, int taps, const double *x, long n, bool adds, double *y);

#endif

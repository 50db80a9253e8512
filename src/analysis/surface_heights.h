/* What the heights of a map are like (ISO 25178-2; of a profile ISO 21920-2, where S is R): about their mean, missing
 * points left out. */
#ifndef ANALYSIS_SURFACE_HEIGHTS_H
#define ANALYSIS_SURFACE_HEIGHTS_H
#include "file/heightfile.h"

struct surface_heights {
    double mean, low, high;  /* m                                                              */
    double sa, sq, sz;       /* m: mean and root mean square of the distance from the mean; high - low */
    double ssk, sku;         /* skewness, kurtosis (Gaussian: 0, 3); NAN when all are the same  */
    double slope, curvature; /* root mean square of first and second differences along the rows, over pitch and pitch^2:
                                m/m, 1/m */
    double slope_y, curvature_y; /* down the columns; NAN of a profile                            */
};

void surface_heights(const struct heightfile *h, struct surface_heights *s);

/* How finely the heights are stored. */
struct surface_heights_steps {
    size_t looked_at, levels; /* heights looked at (at most a million), different ones among them */
    double step;  /* m: what the file says (integers, float32), or, if larger, the smallest gap between levels when at
                     most half of the heights are different; 0: none                 */
    double noise; /* 1/m: rms curvature that rounding to `step` makes: step sqrt(6/12)/pitch^2; at the knots of the
                     cubic spline it is 2.45 times as much                            */
};

void surface_heights_steps(const struct heightfile *h, struct surface_heights_steps *s);

#endif

/* What limited curvature is in the mean, for each direction in which a way may go over the ground. */
#ifndef FORCE_SLOPE_HEADING_H
#define FORCE_SLOPE_HEADING_H
#include "stage.h"

enum { SLOPE_ALPHAS = 65, SLOPE_HEADINGS = 128 };

/* T(c) = share c + mean by least squares over the ground, at directions evenly over |x| + |y| = 1, half way round, and at alphas evenly by logarithm, at most 1.23 times apart over a range of 4e5. */
struct slope_heading {
    int alphas;             /* so many are in use; 1: alpha is constant */
    bool one;               /* there is but one direction: it stands at all of them */
    double least, step;     /* log(alpha / m) of the first, from one to the next */
    double share[SLOPE_ALPHAS][SLOPE_HEADINGS + 1]; /* 1   */
    double mean[SLOPE_ALPHAS][SLOPE_HEADINGS + 1];  /* 1/m */
};

struct slope_part {
    double share, mean;     /* 1, 1/m */
};

/* Of the ground of r's contact as its relief reads it now; from the arena. NULL where nothing is limited, or alike all along a straight way, as alpha does not vary: then share is 1,
   mean 0. */
const struct slope_heading *slope_heading_make(const struct stage_run *r, struct arena *a);

/* Where among its alphas one of so many m is. */
double slope_heading_row(const struct slope_heading *h, double alpha);

/* Of a way in the direction of ex, ey (a unit vector, of either sign); row: as above. */
struct slope_part slope_heading_at(const struct slope_heading *h, double ex, double ey, double row);

#endif

/* A height profile as a cubic spline on an even grid, read by its B-spline coefficients wherever the contact is:
     z(q) = sum_i c_i B((q - origin)/pitch - i),  z''(q) linear between the knots q = origin + i pitch. */
#ifndef SURFACE_PROFILE_H
#define SURFACE_PROFILE_H
#include <stddef.h>

#include "base/arena.h"

struct profile {
    double pitch;     /* m between knots */
    double from, to;  /* m: where heights are given; -HUGE_VAL, HUGE_VAL when endless */
    void (*read)(struct profile *, long first, long n, double *c); /* coefficients first .. first + n - 1, m */
    void *state;
    void (*close)(struct profile *);
};

/* The spline through n >= 4 samples (m), continued beyond its ends by the rule (enum off_map; error continues as mirror does). */
struct profile *profile_from_samples(struct arena *a, const double *z, size_t n, double pitch, int off_map);

/* Second derivative (1/m), slope and height (m) at knots first .. first + n - 1; any output may be NULL; work has n + 2 numbers. */
struct profile_knots {
    double *height, *slope, *curvature;
};
void profile_knots(struct profile *p, long first, long n, double *work, struct profile_knots out);

#endif

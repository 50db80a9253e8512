/* A height profile as a cubic spline on an even grid, read by its B-spline coefficients wherever the contact is:
     z(q) = sum_i c_i B(q/pitch - i),  z''(q) linear between the knots q = i pitch. */
#ifndef SURFACE_PROFILE_H
#define SURFACE_PROFILE_H
#include <stddef.h>

#include "base/arena.h"
#include "surface/relief.h"

enum off_map { OFF_MAP_MIRROR, OFF_MAP_WRAP, OFF_MAP_ERROR };

struct profile {
    double pitch;    /* m between knots */
    double from, to; /* m: where heights are given; -HUGE_VAL, HUGE_VAL when endless */
    void (*read)(struct profile *, long first, long n, double *c); /* coefficients first .. first + n - 1, m */
    void *state;
    void (*close)(struct profile *); /* may be NULL */
};

/* The spline through n >= 4 samples (m), continued beyond its ends by the rule (enum off_map; error continues as mirror
 * does). */
struct profile *profile_from_samples(struct arena *a, const double *z, size_t n, double pitch, int off_map);

/* The same, of its coefficients, which are kept elsewhere. */
struct profile *profile_from_coefficients(struct arena *a, const double *c, size_t n, double pitch, int off_map);

/* The B-spline coefficients c[n] of the spline through z[n]; two arrays. */
void profile_coefficients(const double *z, double *c, size_t n, int off_map);

/* Index i of n samples brought inside by mirroring (period 2n - 2) or wrapping (period n). */
long profile_folded(long i, long n, int off_map);

/* The profile as a part of a relief of one coordinate, its knot 0 at x = origin. Closing the part closes the profile.
 */
struct relief_part *profile_part(struct arena *a, struct profile *p, const char *name, double origin);

#endif

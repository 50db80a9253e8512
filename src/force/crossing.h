/* Powers of a slope's magnitude over a piece of the way, where the slope may change sign. */
#ifndef FORCE_CROSSING_H
#define FORCE_CROSSING_H

struct crossing {
    double whole, late; /* integrals over 0 <= q <= 1 of |S'|^power, and of q |S'|^power */
};

/* power 1, of a slope that goes from a to b with that mean: a parabola, which has one zero between ends of opposite
   signs. The plain form that slope_terms_crossing (force/slope_terms.h) is held against. */
struct crossing crossing_slope(double a, double b, double mean);

/* Of a slope at the piece's start, middle and end: Simpson's rule, or straight lines to a zero. */
struct crossing crossing_power(const double s[3], double power);

#endif

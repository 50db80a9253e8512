/* The force of a ball that presses a spring-like surface, and its means over a time in which the penetration is known
   at both ends. */
#ifndef FORCE_ROLL_LAW_H
#define FORCE_ROLL_LAW_H
#include <math.h>
#include <stdbool.h>

#include "force/hertz_mean.h"

struct roll_law {
    double stiffness; /* N/m^1.5, k       */
    double mu;        /* s/m, lambda / k  */
};

/* m^1.5, mean of max(0, rho)^1.5 over a time in which rho goes in a straight line from a to b (m), p^2, q^2 = a, b:
   by quotients that lose no digits (hertz_mean.h); where rho passes through 0, one of p, q is 0. */
static inline double roll_law_power(double a, double b)
{
    double p = sqrt(a > 0 ? a : 0), q = sqrt(b > 0 ? b : 0), pp = p * p, qq = q * q;
    bool both = a > 0 && b > 0;
    double width = both ? q + p : b - a, fifth = both ? hertz_mean_quartic(p, q, pp, qq) : qq * qq * q - pp * pp * p;
    return 0.4 * fifth / (width == 0 ? 1 : width);
}

struct roll_end {
    double rho, rate; /* m, m/s: rho and rho' */
};

struct roll_parts {
    double early, late; /* N, as in force/path_integral.h */
};

/* Of max(0, k rho^1.5 (1 + mu rho')) over dt (s), from a to b, where the mean of rho is `mean` (m). */
struct roll_parts roll_law_force(const struct roll_law *l, const struct roll_end *a, const struct roll_end *b,
                                 double mean, double dt);

/* Share of that time in which rho is above 0. */
double roll_law_contact(double a, double b);

#endif

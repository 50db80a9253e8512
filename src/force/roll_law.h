/* The force of a ball that presses a spring-like surface, and its means over a time in which the penetration is known at both ends. */
#ifndef FORCE_ROLL_LAW_H
#define FORCE_ROLL_LAW_H
#include <math.h>

#include "force/hertz_mean.h"

struct roll_law {
    double stiffness;   /* N/m^1.5, k       */
    double mu;          /* s/m, lambda / k  */
};

struct roll_power {
    double mean;        /* m^1.5, of max(0, rho)^1.5                                        */
    double slope;       /* m^0.5, its derivative by what both ends are raised by            */
};

/* Means over a time in which rho goes in a straight line from a to b (m), p^2, q^2 = a, b: by quotients that lose no digits (hertz_mean.h); where rho
   passes through 0, one of p, q is 0. */
static inline struct roll_power roll_law_power(double a, double b)
{
    double p = sqrt(a > 0 ? a : 0), q = sqrt(b > 0 ? b : 0), pp = p * p, qq = q * q, cross = p * q;
    double both = a > 0 && b > 0 ? 1 : 0, width = both > 0 ? q + p : b - a;
    double fifth = both > 0 ? hertz_mean_quartic(p, q, pp, qq) : qq * qq * q - pp * pp * p;
    double third = both > 0 ? qq + cross + pp : qq * q - pp * p;
    width = width == 0 ? 1 : width;
    return (struct roll_power){0.4 * fifth / width, third / width};
}

struct roll_end {
    double rho, rate;   /* m, m/s: rho and rho' */
};

struct roll_parts {
    double early, late; /* N, as in force/hats.h */
};

/* Of max(0, k rho^1.5 (1 + mu rho')) over dt (s), from a to b. */
struct roll_parts roll_law_force(const struct roll_law *l, const struct roll_end *a, const struct roll_end *b, double dt);

/* Share of that time in which rho is above 0. */
double roll_law_contact(double a, double b);

/* m: how deep the ball of stiffness k (N/m^1.5) lies at rest under a normal force (N), (N/k)^(2/3); 0 where nothing presses it. */
double roll_law_rest(double normal, double stiffness);

#endif

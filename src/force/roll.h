/* The force of a ball that presses a spring-like surface, and its means over a time in which the penetration is known
   at both ends. */
#ifndef FORCE_ROLL_H
#define FORCE_ROLL_H
#include <math.h>
#include <stdbool.h>

#include "force/hertz.h"
#include "stage.h"

enum penetration { PENETRATION_DEVIATION, PENETRATION_PAPER };
enum roll_follows { FOLLOWS_BALL, FOLLOWS_POINT };

struct roll {                  /* contact.roll, as far as model roll alone has it             */
    int penetration;           /* enum penetration                                            */
    int follows;               /* enum roll_follows                                           */
    double lambda;             /* N s/m^2.5, of penetration: paper                            */
    double static_penetration; /* m, penetration at rest; NAN: of both bodies and the ground  */
    double damping_ratio;      /* zeta of the ball's mass on the contact, beside mu's part    */
    double scraping;           /* factor on equation 19's scraping terms                      */
};

const struct roll *roll_of(const struct contact *c);

/* What a ball's stage says of the board's `roll`, of either model. */
struct stage_report roll_report(const struct stage_run *r, struct arena *a);

struct roll_law {
    double stiffness; /* N/m^1.5, k       */
    double mu;        /* s/m, lambda / k  */
};

/* m^1.5, mean of max(0, rho)^1.5 over a time in which rho goes in a straight line from a to b (m), p^2, q^2 = a, b:
   by quotients that lose no digits (hertz.h); where rho passes through 0, one of p, q is 0. */
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

/* How far a mass on a damped spring lags behind the ground that it follows, from the ground's vertical acceleration
   alone. */
struct roll_follow {
    double step[3][2]; /* of (y, dt y', mean y) by y and dt y' before              */
    double push[3][2]; /* s^2, of the same by the acceleration at start and end    */
    double dt;         /* s                                                        */
    double y, rate;    /* m, m/s: how deep the ground presses in, and its rate now */
};

/* y'' + damping y' + resonance^2 y = acceleration, in steps of dt (s), from y = y' = 0 on. resonance rad/s, damping
   1/s. */
struct roll_follow roll_follow_make(double resonance, double damping, double dt);

/* One step, in which the acceleration (m/s^2) goes in a straight line from `start` to `end`. Gives the mean of y over
   it, m. */
double roll_follow_step(struct roll_follow *f, double start, double end);

/* How a rolling ball lies in its contact at rest, and the stiffness that follows: from both bodies and the ground,
   never from the motion. */
struct roll_stiffness {
    double normal;    /* N, static normal force, N                                       */
    double rest;      /* m, penetration at rest, delta                                   */
    double stiffness; /* N/m^1.5, k = N / delta^1.5                                      */
    double roughness; /* m, Rq of the ground; NAN: not read, as the scene gives the rest */
    double hertz;     /* m, Hertz's part of delta; 0: a modulus is not known; NAN: as Rq */
    double resonance; /* rad/s, of the ball's mass on the contact, w0                    */
};

/* m, Rq: rms height of the ground by second differences, of waves up to some millimetres. Places are in the ground's
   own coordinates (relief.h, `under` of a tip). */
double roll_stiffness_roughness(const struct relief *ground);

#endif

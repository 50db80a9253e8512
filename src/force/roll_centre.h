/* How high the geometric centre of a rolling ball lies as it follows the surface, and its centre of mass over that. */
#ifndef FORCE_ROLL_CENTRE_H
#define FORCE_ROLL_CENTRE_H
#include "force/slope.h"
#include "trajectory/spin.h"

struct roll_centre {
    struct spin spin;
    bool round;                     /* neither offset nor lobes                         */
    bool printed;                   /* penetration: paper                               */
    double height, lift[SLOPE_LEVELS]; /* m, S at the start of the next sub-interval; m^2, lift (force/slope.h) */
    double at[WAY_CHUNK + 1];       /* m: S at the start of the first sub-interval and at each one's end, */
    double lifts[SLOPE_LEVELS][WAY_CHUNK + 1]; /* m^2: less the levels (force/slope.h) times these */
    double rise[WAY_CHUNK + 1];     /* m, of the same instants: rise + bulge; 0 of what is round */
    double in_rho[WAY_CHUNK + 1];  /* m, where printed: what is added to R + S, -r cos(x/R) + bulge */
};

struct roll_centre roll_centre_make(const struct contact *c);

/* Of the n sub-intervals from number `first` on over which s was just run; at[] is still without its last term. */
void roll_centre_run(struct roll_centre *m, const struct slope *s, const struct board *b, long first, int n);

/* at[] and lifts[] alone. */
void roll_centre_follow(struct roll_centre *m, const struct slope *s, int n);

/* The last term: takes level[] (1/m, slope_level) times lifts off n heights. */
void roll_centre_level(double *at, long n, double *const lifts[SLOPE_LEVELS], const double level[SLOPE_LEVELS]);

#endif

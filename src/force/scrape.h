/* The force of equations 1 and 3 along one limited trajectory: what the stages `scrape` and `roll` share. */
#ifndef FORCE_SCRAPE_H
#define FORCE_SCRAPE_H
#include "force/path_integral.h"

struct scrape {
    struct path_integral path;
    double beta1, beta2, mass;
    double share;    /* factor on both forces                         */
    double momentum; /* m v dS/du at the end of the last sub-interval */
    struct bspline bspline;
};

/* s must be zeroed, and stay where it is. */
bool scrape_make(struct scrape *s, struct stage_run *r, double share, struct err *e);

/* As at the start. */
void scrape_reset(struct scrape *s);

/* To early and late: both forces' parts over the n <= CELLS_CHUNK sub-intervals from number `first` on, which must come
 * in order.
 */
void scrape_force(struct scrape *s, const struct stage_run *r, long first, int n);

#endif

/* The force of equations 1 and 3 along one limited trajectory: what the stages `scrape` and `roll` share. */
#ifndef FORCE_SCRAPE_H
#define FORCE_SCRAPE_H
#include "force/path_integral.h"

enum force_kind { FORCE_DIRECTIONAL, FORCE_PAPER };

struct scrape_law {      /* of what scrapes or rolls       */
    int force;           /* enum force_kind                */
    double beta1, beta2; /* eq. 3                          */
    double leak;         /* m: l of dS'/ds + S'/l = T(c)   */
};

const struct scrape_law *scrape_law(const struct contact *c);

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

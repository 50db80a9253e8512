/* The limited trajectory S that a contact follows along its path: its slope S' and, where asked for, its height S. */
#ifndef FORCE_SLOPE_H
#define FORCE_SLOPE_H
#include "force/slope_terms.h"

#define SLOPE_LEAK                                                                                                     \
    2e-3 /* m, where the scene has no contact.leak: a ball whose scraping terms are as printed (contact.force: paper)  \
          */

struct slope {
    struct way way;
    struct slope_terms terms;
    double leak, power;             /* m, l; |S'|^power is what crossed[] holds     */
    bool crossing, rising;          /* is crossed[] asked for? heights[]? The maker's to set        */
    double slope, across, height;   /* dS/du, dS/dn, S now                          */
    double ex, ey;                  /* e where they are; 0, 0: nowhere yet          */
    double ends[WAY_CHUNK];         /* dS/du at each sub-interval's end             */
    double heights[WAY_CHUNK];      /* m, S there                                   */
    double climbed[WAY_CHUNK];      /* m, integral of S' ds over it                 */
    double crossed[WAY_CHUNK];      /* integral of |S'|^power ds over it            */
    double crossed_late[WAY_CHUNK]; /* m, the same of s |S'|^power, s travelled since its start */
    double travelled[WAY_CHUNK];    /* m; more than |u1 - u0| where it turns        */
    int filled;                     /* ends[] and what is beside it up to here are known */
};

/* Of the contact's surface, from S = S' = 0 on. s must be zeroed, and stay where it is. Errors as of way_make. */
bool slope_make(struct slope *s, struct stage_run *r, struct err *e);

/* From S = S' = 0 on again, wherever the contact is then. */
void slope_forget(struct slope *s);

/* Follows the n <= WAY_CHUNK sub-intervals from number `first` on (since the start), which must come in order. */
void slope_run(struct slope *s, const struct stage_run *r, long first, int n);

#endif

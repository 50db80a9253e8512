/* The limited trajectory S that a contact follows along its path: its slope S' and, where asked for, its height S. */
#ifndef FORCE_SLOPE_H
#define FORCE_SLOPE_H
#include "force/slope_height.h"

#define SLOPE_LEAK 2e-3 /* m, where the scene has no contact.leak: a ball whose scraping terms are as printed (contact.force: paper) */

enum { SLOPE_LEVELS = 2 };

struct slope {
    struct way way;
    struct slope_terms terms;
    double leak, power;              /* m, l; |S'|^power is what crossed[] holds     */
    bool crossing, rising;           /* is crossed[] asked for? heights[] and lifts[]? The maker's to set */
    double slope, across, height;    /* dS/du, dS/dn, S now                          */
    bool by_height;                  /* S is made of heights                                    */
    struct slope_height turned;      /* S of heights; `heading` is the maker's to set           */
    double climb;                    /* dS/du + S/l now: S' where S is not made of heights      */
    double even[SLOPE_LEVELS];       /* dS/du per 1/m that T would make if it were flat[k] / m all the time */
    double lift[SLOPE_LEVELS];       /* m^2, S of the same                           */
    double radius, alpha;            /* m, R; m, alpha last met                      */
    double flat[SLOPE_LEVELS];       /* 1, over 1/R: shapes of the mean of T (force/slope.c) */
    double bent[SLOPE_LEVELS];       /* integral so far of T flat[k] ds              */
    double gone[SLOPE_LEVELS][SLOPE_LEVELS]; /* m, of flat[k] flat[j] ds, j <= k     */
    double ex, ey;                   /* e where they are; 0, 0: nowhere yet          */
    double ends[WAY_CHUNK];          /* dS/du at each sub-interval's end             */
    double heights[WAY_CHUNK];       /* m, S there                                   */
    double climbs[WAY_CHUNK];        /* dS/du + S/l there; where heights are         */
    double lifts[SLOPE_LEVELS][WAY_CHUNK]; /* m^2, lift there                        */
    double climbed[WAY_CHUNK];       /* m, integral of S' ds over it                 */
    double crossed[WAY_CHUNK];       /* integral of |S'|^power ds over it            */
    double crossed_late[WAY_CHUNK];  /* m, the same of s |S'|^power, s travelled since its start */
    double travelled[WAY_CHUNK];     /* m; more than |u1 - u0| where it turns        */
    int filled;                      /* ends[] and what is beside it up to here are known */
};

/* Of the contact's surface, from S = S' = 0 on. s must be zeroed, and stay where it is. Errors as of way_make. */
bool slope_make(struct slope *s, struct stage_run *r, struct err *e);

/* 1/m: what of T goes with flat[] over all that was gone so far, by least squares: S less the lifts times these has no level. */
void slope_level(const struct slope *s, double level[SLOPE_LEVELS]);

/* From S = S' = 0 on again, wherever the contact is then. */
void slope_forget(struct slope *s);

/* Follows the n <= WAY_CHUNK sub-intervals from number `first` on (since the start), which must come in order. */
void slope_run(struct slope *s, const struct stage_run *r, long first, int n);

#endif

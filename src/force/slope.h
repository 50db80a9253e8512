/* The limited trajectory S that a contact follows along its path: its slope S' and, where asked for, its height S. */
#ifndef FORCE_SLOPE_H
#define FORCE_SLOPE_H
#include "force/way.h"

#define SLOPE_LEAK 2e-3 /* m, where the scene has no contact.leak: a ball whose scraping terms are as printed (contact.force: paper) */

struct slope {
    struct way way;
    double leak, power;              /* m, l; |S'|^power is what crossed[] holds     */
    bool crossing, rising;           /* is crossed[] asked for? heights[] and lifts[]? The maker's to set */
    double slope, across, height;    /* dS/du, dS/dn, S now                          */
    double even[2], sideways[2];     /* dS/du, dS/dn per 1/m that T would make if it were flat[k], aside[k] / m all the time */
    double lift[2];                  /* m^2, S of the same                           */
    double radius, alpha;            /* m, R; m, alpha last met                      */
    double flat[2], aside[2];        /* 1, T(c), T(d) over 1/R of H = -1/R: [0] not limited, [1] limited */
    bool ridges;                     /* H is -1/R across the ridges of a profile, which the path meets at changing angles */
    double bent[2], gone[3];         /* integrals so far of T(c) flat[k] + T(d) aside[k] ds; of [0] [0], [0] [1], [1] [1] of those two */
    double ex, ey;                   /* e where they are; 0, 0: nowhere yet          */
    double ends[WAY_CHUNK];          /* dS/du at each sub-interval's end             */
    double heights[WAY_CHUNK];       /* m, S there                                   */
    double lifts[2][WAY_CHUNK];      /* m^2, lift there                              */
    double crossed[WAY_CHUNK];       /* integral of |S'|^power ds over it            */
    double travelled[WAY_CHUNK];     /* m; more than |u1 - u0| where it turns        */
    int filled;                      /* ends[], heights[], lifts[] up to here are known */
};

/* Of the contact's surface, from S = S' = 0 on. s must be zeroed, and stay where it is. Errors as of way_make. */
bool slope_make(struct slope *s, struct stage_run *r, struct err *e);

/* Follows the n <= WAY_CHUNK sub-intervals from number `first` on (since the start), which must come in order. */
void slope_run(struct slope *s, const struct stage_run *r, long first, int n);

/* 1/m: what of T goes with flat[], aside[], by least squares over all that was gone so far: S less the two lifts times these has no level. */
void slope_level(const struct slope *s, double level[2]);

#endif

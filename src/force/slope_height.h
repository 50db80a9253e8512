/* The height S of a limited trajectory on a way that turns, or where alpha varies. */
#ifndef FORCE_SLOPE_HEIGHT_H
#define FORCE_SLOPE_HEIGHT_H
#include "force/slope_heading.h"
#include "force/slope_terms.h"
#include "force/way.h"

struct slope_height {
    const struct slope_heading *heading; /* NULL: nothing is limited                       */
    double rest, sum;                    /* 1, dR/ds + R/l in the direction of travel; m, R */
    double climb, rise;                  /* m, G1, G2                                      */
    double alpha, row;                   /* m, last met; where it is in the table          */
};

/* Piece i from its start to its end. alpha: m, as at the piece; mean: 1/m, of r over it. S is then sum + rise. */
double slope_height_piece(struct slope_height *s, const struct way_pieces *p, const struct slope_terms *t, int i, double alpha);

/* dS/ds + S/l in the direction of travel, where piece i ended, to which slope_height_piece came last. */
double slope_height_climb(const struct slope_height *s, const struct way_pieces *p, int i, double leak);

#endif

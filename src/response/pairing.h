/* Which modes of different places are one and the same: by frequency, as an optimal assignment between neighbouring
 * places. */
#ifndef RESPONSE_PAIRING_H
#define RESPONSE_PAIRING_H
#include "response/places.h"

/* Rows to columns, each at most once, so that the sum of the pairs' cost[rows][columns] and of `alone` for every row
   and every column without a partner is least. HUGE_VAL: no pair. column[row]: its partner, or -1. Costs finite and >=
   0 otherwise. */
void pairing_assign(int rows, int columns, const double *cost, double alone, int *column);

struct pairing_list { /* the modes of a place */
    int n;
    const double *frequency, *decay; /* Hz, 1/s, all above 0 */
};

/* Pairs two places' modes: |log f| costs, with a small part for log decay to tell apart what frequency does not; modes
   whose frequencies differ by more than the share `gate` are never a pair. column[row->n]: the other's index, or -1. */
void pairing_modes(const struct pairing_list *row, const struct pairing_list *other, double gate, int *column);

/* Follows modes from place to place: along the shortest tree of the places' edges (by length), from the place with most
   modes; each next place's modes are paired with what is followed so far, taken where it was last met nearest to that
   place. list[places]; xy [places][2]. track[place][mode]: number of the mode, 0 .. returned number - 1. */
int pairing_tracks(const struct places *p, int places, const double *xy, const struct pairing_list *list, double gate,
                   int *const *track);

#endif

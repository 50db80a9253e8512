/* crest_piece_rest of LANES discs at a time, each on a piece of its own: the same bits (test_crest.c). */
#ifndef SURFACE_CREST_LANES_H
#define SURFACE_CREST_LANES_H
#include "num/lanes.h"
#include "surface/crest_piece.h"

struct crest_lanes {
    _Alignas(64) double terms[CREST_TERMS][LANES];
    double y[LANES];                            /* m: centres, from the pieces' middles        */
    double z[LANES], slope[LANES], bend[LANES]; /* what crest_piece_rest says                  */
};

/* Fills z, slope and bend. For d->half > 0; all lanes must be filled, with anything. */
void crest_lanes_rest(const struct crest_disc *d, struct crest_lanes *at);

#endif

/* A disc over one piece of smooth ground: where it rests, and its lowest point. */
#ifndef SURFACE_CREST_PIECE_H
#define SURFACE_CREST_PIECE_H

enum { CREST_TERMS = 6 };

struct crest_disc {
    double radius;     /* m */
    double half;       /* m: half a piece's length; 0: pieces are points, of which only the height terms[0] counts */
    double over, tall; /* 1/m: 1 / half; radius / half: 0 of points                                                */
};

struct crest_jet {
    double z, slope, bend; /* m, 1, 1/m: height and its derivatives */
};

struct crest_disc crest_piece_disc(double radius, double half);

/* Heights of the piece between a and b, 2 half apart: terms[k] q^k, m, q from -1 to 1. */
void crest_piece_make(const struct crest_disc *d, const struct crest_jet *a, const struct crest_jet *b,
                      double terms[CREST_TERMS]);

/* The lowest point of the disc that rests on the piece, its centre y (m) from the piece's middle: height, and its
   derivatives. For |y| <= radius + half; where rounding puts y beyond, as there. */
struct crest_jet crest_piece_rest(const struct crest_disc *d, const double terms[CREST_TERMS], double y);

/* Where the centre is as the disc rests on a place of that slope, m from that place. */
double crest_piece_centre(const struct crest_disc *d, double slope);

/* Can the disc rest in the midst of ground of that slope and bend? */
int crest_piece_open(const struct crest_disc *d, double slope, double bend);

/* m: by how much a disc that rests between a and b lies at most above one that rests on the point in their middle
 * (about: bends are those at the ends, and half as much again). */
double crest_piece_margin(const struct crest_disc *d, const struct crest_jet *a, const struct crest_jet *b);

#endif

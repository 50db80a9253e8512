/* The rolling curve of papers/002, fig. 1, over ground in one coordinate: the upper envelope of a disc of radius R that
   slides over it, read by its lowest point (the path of its centre, less R),

     E(x) = max over t of z(t) + sqrt(R^2 - (x - t)^2) - R,   |x - t| <= R

   at any x, exact for ground made of polynomials between places where its height, slope and bend are known, or of its
   heights there alone. Time is linear in the number of places. */
#ifndef SURFACE_ROLLING_ENVELOPE_H
#define SURFACE_ROLLING_ENVELOPE_H
#include "num/lanes.h"
#include "surface/relief.h"

/* A disc over one piece of smooth ground: where it rests, and its lowest point. */
enum { ENVELOPE_TERMS = 6 };

struct disc {
    double radius;     /* m */
    double half;       /* m: half a piece's length; 0: pieces are points, of which only the height terms[0] counts */
    double over, tall; /* 1/m: 1 / half; radius / half: 0 of points                                                */
};

struct height_jet {
    double z, slope, bend; /* m, 1, 1/m: height and its derivatives */
};

struct disc rolling_envelope_disc(double radius, double half);

/* Heights of the piece between a and b, 2 half apart: terms[k] q^k, m, q from -1 to 1. */
void rolling_envelope_terms(const struct disc *d, const struct height_jet *a, const struct height_jet *b,
                            double terms[ENVELOPE_TERMS]);

/* The lowest point of the disc that rests on the piece, its centre y (m) from the piece's middle: height, and its
   derivatives. For |y| <= radius + half; where rounding puts y beyond, as there. */
struct height_jet rolling_envelope_rest(const struct disc *d, const double terms[ENVELOPE_TERMS], double y);

struct rest_lanes {
    _Alignas(64) double terms[ENVELOPE_TERMS][LANES];
    double y[LANES];                            /* m: centres, from the pieces' middles        */
    double z[LANES], slope[LANES], bend[LANES]; /* what rolling_envelope_rest says                  */
};

/* rolling_envelope_rest of LANES discs at a time, each on a piece of its own, the same bits: fills z, slope and bend.
 * For d->half > 0; all lanes must be filled, with anything. */
void rolling_envelope_rest_lanes(const struct disc *d, struct rest_lanes *at);

struct rolling_envelope;

struct envelope_ground {
    const double *z;            /* m, at places `pitch` apart                                                     */
    const double *slope, *bend; /* 1, 1/m: first and second derivatives there; NULL: the ground is these points alone */
};

/* For windows of at most `most` places, `pitch` m apart. */
struct rolling_envelope *rolling_envelope_make(struct arena *a, double radius, double pitch, long most);

/* The envelope of the ground at n places, 1 <= n <= most (2 <= n of ground with slopes), the first at x = first *
 * pitch. */
void rolling_envelope_set(struct rolling_envelope *c, const struct envelope_ground *g, long n, long first);

/* E and its slope at x[m] (m; in any order, fastest in rising order); slope may be NULL, and is that on the right at a
   kink. Where no place is within R, values mean nothing (never on a pitch of 2 R or less, between the first place and
   the last). */
void rolling_envelope_at(const struct rolling_envelope *c, size_t m, const double *x, double *e, double *slope);

/* What it is made of: stretches in each of which the disc rests on one piece or point. */
enum {
    STRETCH_FROM,
    STRETCH_AT,
    STRETCH_TERMS,
    STRETCH_NUMBERS = STRETCH_TERMS + 6
}; /* m, where it comes up; m, the piece's middle; its terms, m */

/* The stretches from `from` to `to` (m): how many, and to *first the first, STRETCH_NUMBERS numbers each. */
long rolling_envelope_between(const struct rolling_envelope *c, double from, double to, const double **first);

/* ------------------------------------------------------------------ as a part of a relief */

struct rolling_plan {
    double radius, patch; /* m; patch: standard deviation of the Gaussian                                    */
    double reach;         /* m: heights further from the ball's centre than this are not looked at; <= radius */
    int finer;            /* in the plane heights are read at patch / 4 / finer                              */
    double pitch;         /* m: in one coordinate, at its multiples                                          */
    bool points;          /* in one coordinate: the surface has kinks, and only its heights there count      */
    double span;          /* m between the greatest and least height that reach was made for; HUGE_VAL: any  */
    double read[2];       /* m, least and greatest height read so far, once any is                           */
    bool begun, warned;
    void (*exceeded)(void *); /* called once when the heights read span more; may be NULL                      */
    void *self;
};

/* Of n heights, whole LANES, that have been read: is it more than span now? */
void rolling_envelope_watch(struct rolling_plan *p, const double *z, long n);

/* How many places of the ground are held at a time for a piece of the envelope. */
long rolling_envelope_window(const struct rolling_plan *p);

/* The part of a relief of one coordinate, without contact patch. Heights and, as it has kinks, slopes and second
   derivatives of what is between them, kinks left out: for readers of heights only. `under` is read as it is then, when
   and where it is needed, and must live as long; results do not depend on the order of reading. */
struct relief_part *rolling_envelope_part(struct arena *a, const struct relief *under, const struct rolling_plan *p);

#endif

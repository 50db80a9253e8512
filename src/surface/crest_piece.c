/* See crest_piece.h. Ground between two places where height, slope and bend are known is the polynomial of fifth degree
   that has them: off by (2 half)^6 / 46080 of the sixth derivative; of a cubic spline whose knots are among the places,
   exact.

   A disc of radius R whose centre is at y rests on the place t where z(t) + sqrt(R^2 - (y - t)^2) is largest. There its
   slope is the ground's, p:

     y = t - R p / sqrt(1 + p^2)

   which rises with t where the bend z'' < (1 + p^2)^1.5 / R: elsewhere the ground is too hollow for the disc, which
   touches at a piece's end if at all. The equation is solved by Newton's method between an end and the middle,
   whichever side it points to. */
#include "surface/crest_piece.h"

#include <math.h>

enum { STEPS_MOST = 60 };

#define NEAR 1e-7 /* of half a piece: the step after which Newton's method is at its end, the next being its square */

struct crest_disc crest_piece_disc(double radius, double half)
{
    double over = half > 0 ? 1 / half : 0;
    return (struct crest_disc){radius, half, over, radius * over};
}

void crest_piece_make(const struct crest_disc *d, const struct crest_jet *a, const struct crest_jet *b,
                      double terms[CREST_TERMS])
{
    double w = d->half, even = 0.5 * (a->z + b->z), odd = 0.5 * (b->z - a->z);
    double even_1 = 0.5 * w * (b->slope - a->slope), odd_1 = 0.5 * w * (a->slope + b->slope);
    double even_2 = 0.5 * w * w * (a->bend + b->bend), odd_2 = 0.5 * w * w * (b->bend - a->bend);
    terms[4] = (even_2 - even_1) / 8;
    terms[2] = (even_1 - 4 * terms[4]) / 2;
    terms[0] = even - terms[2] - terms[4];
    terms[5] = (odd_2 - 3 * (odd_1 - odd)) / 8;
    terms[3] = (odd_1 - odd - 4 * terms[5]) / 2;
    terms[1] = odd - terms[3] - terms[5];
}

static double piece_height(const double *c, double q)
{
    return c[0] + q * (c[1] + q * (c[2] + q * (c[3] + q * (c[4] + q * c[5]))));
}

static double piece_slope(const double *c, double q)
{
    return c[1] + q * (2 * c[2] + q * (3 * c[3] + q * (4 * c[4] + q * 5 * c[5])));
}

static double piece_bend(const double *c, double q)
{
    return 2 * c[2] + q * (6 * c[3] + q * (12 * c[4] + q * 20 * c[5]));
}

/* By how much, in half pieces, y lies to the right of where the disc would rest on q; *falls: its derivative, negated.
 */
static double piece_off(const struct crest_disc *d, const double *c, double y, double q, double *falls)
{
    double p = piece_slope(c, q) * d->over, one = 1 / sqrt(1 + p * p), far = d->tall * one;
    *falls = 1 - far * one * one * piece_bend(c, q) * d->over;
    return y - q + far * p;
}

/* Where the cubic over the offset that has both ends' q and derivatives is 0. */
static double piece_guess(double off, double falls, double end, double beyond, double away)
{
    double range = beyond - off, t = -off / range, chord = end / range, a = -1 / falls - chord, b = chord + 1 / away;
    return t * (end + (1 - t) * range * ((1 - t) * a + t * b));
}

/* q of the place that the disc rests on; y in half pieces. */
static double piece_touch(const struct crest_disc *d, const double *c, double y)
{
    double falls, away, off = piece_off(d, c, y, 0, &falls), end = off > 0 ? 1 : -1,
                        beyond = piece_off(d, c, y, end, &away);
    double low = off > 0 ? 0 : -1, high = off > 0 ? 1 : 0, q = 0;
    if (beyond * end >= 0) return end;
    if (falls > 0 && away > 0) {
        q = fmin(fmax(piece_guess(off, falls, end, beyond, away), low), high);
        off = piece_off(d, c, y, q, &falls);
    }
    for (int i = 0; i < STEPS_MOST; i++) {
        double next = q + off / falls, before = q;
        low = off > 0 ? q : low;
        high = off > 0 ? high : q;
        q = falls > 0 && next >= low && next <= high ? next : 0.5 * (low + high);
        if (fabs(q - before) < NEAR) return q;
        off = piece_off(d, c, y, q, &falls);
    }
    return q;
}

/* The second derivative is R^2/s^3 z'' / (R^2/s^3 - z''), and that of the circle where the disc turns about an end. */
struct crest_jet crest_piece_rest(const struct crest_disc *d, const double terms[CREST_TERMS], double y)
{
    double q = d->half > 0 ? piece_touch(d, terms, y * d->over) : 0, u = y - q * d->half,
           square = (d->radius - u) * (d->radius + u);
    double s = square > 0 ? sqrt(square) : 0, arc = d->radius * d->radius / (s * s * s),
           z = d->half > 0 ? piece_height(terms, q) : terms[0];
    double bend = fabs(q) < 1 && d->half > 0 ? piece_bend(terms, q) * d->over * d->over : 0;
    return (struct crest_jet){z - u * u / (d->radius + s), -u / s,
                              fabs(q) < 1 && d->half > 0 ? arc * bend / (arc - bend) : -arc};
}

double crest_piece_centre(const struct crest_disc *d, double slope)
{
    return -d->radius * slope / sqrt(1 + slope * slope);
}

int crest_piece_open(const struct crest_disc *d, double slope, double bend)
{
    double square = 1 + slope * slope;
    return d->radius * bend < square * sqrt(square);
}

double crest_piece_margin(const struct crest_disc *d, const struct crest_jet *a, const struct crest_jet *b)
{
    double steep = fmax(a->slope * a->slope, b->slope * b->slope), bend = -1.5 * fmin(fmin(a->bend, b->bend), 0);
    return 0.5 * d->half * d->half * (bend + 1.5 * (1 + steep) * sqrt(1 + steep) / d->radius);
}

/* What a piece of the way does to the slope (force/slope.c), of all pieces at once: everything but the slope itself. */
#ifndef FORCE_SLOPE_TERMS_H
#define FORCE_SLOPE_TERMS_H
#include "force/way.h"

struct slope_terms {
    double z[LIMITED_PIECES], phi[LIMITED_PIECES], chi[LIMITED_PIECES]; /* 1 */
    double kept[LIMITED_PIECES];               /* 1 - z phi                                   */
    double bent[WAY_CHANNELS][LIMITED_PIECES]; /* what the end gains: phi h mean(T) + z (1 - z/2) h moment(T) */
    double risen[LIMITED_PIECES]; /* what the mean gains, of channel 0: chi h mean(T) - (1 - z/2) h moment(T)
                                     + z h (mean(T) - (T_start + T_end)/2) / 60 */
    double start[LIMITED_PIECES], end[LIMITED_PIECES],
        mean[LIMITED_PIECES]; /* S' along the direction of travel; set where the slope is known */
    double whole[LIMITED_PIECES], late[LIMITED_PIECES]; /* integrals of |S'|, q |S'| dq over the piece */
};

/* All of p's pieces and channels, up to `risen`. leak: l, m. */
void slope_terms(struct slope_terms *t, const struct way_pieces *p, int channels, double leak);

/* mean[] of n pieces of channel 0 from start[]. */
void slope_terms_mean(struct slope_terms *t, int n);

/* whole[], late[] of n pieces from start[], end[], mean[]: S' taken as a parabola. */
void slope_terms_crossing(struct slope_terms *t, int n);

/* S' at the piece's end from that at its start. */
static inline double slope_terms_end(const struct slope_terms *t, int channel, int i, double start)
{
    return t->kept[i] * start + t->bent[channel][i];
}

#endif

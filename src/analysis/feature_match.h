/* How well one set of modes stands for another in the plane of frequency and damping (papers/003 supplement, C.2 and
   D.1): matched as points whose unit of distance is about what an ear can tell apart.

   A feature's place is x = z(f)/bark, z the critical band rate in Bark, and y = log(1/d)/decay. D_ij is the distance of
   two places, k(D) = max(0, 1 - D) how well one stands for the other. A feature may be matched by several of the other
   set, each of which has only one of itself to give:

       R_i = min(1, sum_j u_ij k(D_ij)),   sum_i u_ij <= 1

   The paper does not say who gets what: here the closest pair comes first, of equal ones that of more energy. So a
   set stands for itself with R_i = 1 throughout, which sharing in proportion to energy would not give. R_i is
   continuous but where an estimated feature is as far from one reference as from another: there it changes hands. */
#ifndef ANALYSIS_FEATURE_MATCH_H
#define ANALYSIS_FEATURE_MATCH_H
#include <stdbool.h>

#include "base/arena.h"

struct feature {
    double frequency, decay; /* Hz, 1/s, both above 0 */
    double energy;           /* at least 0, in any unit that is the same throughout a set; gain^2/(4 decay) of a mode */
};

struct feature_match_scale { /* what is one unit of distance; a member 0: its default */
    double bark;             /* 0.1 Bark                                                        */
    double decay;            /* 0.25 of the natural logarithm of d (of the mean 1/d: durations) */
    bool durations;          /* y = (1/d)/(decay times the reference's mean 1/d by energy): as the paper says, but one
                                slow mode then outweighs all others */
};

struct feature_match {
    double *reference, *estimated; /* [n], [m] R of each feature of the two sets, 0 to 1 */
    double represented, found;     /* their means by energy (by number where a set has none); 0 of an empty set */
    double score;                  /* mean of the two: 1: equal. One alone would reward thousands of features */
};

/* Critical band rate of a frequency (Hz), Bark (Traunmueller 1990). */
double feature_match_bark(double frequency);

/* reference[n], estimated[m]; scale NULL: the defaults. In order n m; the same bits everywhere. */
void feature_match(const struct feature *reference, int n, const struct feature *estimated, int m,
                   const struct feature_match_scale *scale, struct arena *a, struct feature_match *match);

#endif

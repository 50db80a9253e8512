/* Values of a band-limited signal between its samples. */
#ifndef NUM_BETWEEN_H
#define NUM_BETWEEN_H
#include "base/arena.h"

enum { BETWEEN_PHASES = 32, BETWEEN_REACH = 24 };

struct between {
    double *tap; /* [BETWEEN_PHASES][2 BETWEEN_REACH] */
};

struct between between_make(struct arena *a);

/* x at k / BETWEEN_PHASES samples; beyond its ends x is 0. At whole samples x itself; error below 1e-4 of a sinusoid's
   amplitude up to 0.44 of the sample rate, below 4e-5 up to 0.4. */
double between_at(const struct between *b, const double *x, long n, long k);

#endif

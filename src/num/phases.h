/* A kernel's outputs at every so many inputs only. */
#ifndef NUM_PHASES_H
#define NUM_PHASES_H
#include <stdbool.h>

#include "num/filter.h"
#include "num/lanes.h"

enum { PHASES_WIDE = 4 * LANES }; /* outputs whose sums stay in registers */

struct phases {
    int reach, taps; /* of the filter                             */
    int each, turns; /* of so many taps, the last ends with zeros */
    long row;        /* inputs of one remainder by `each`         */
    double *tap;
};

/* For at most so many outputs at a time. */
struct phases phases_make(struct arena *a, const struct filter *f, int each, long outputs);

/* Values that phases_run needs. */
long phases_room(const struct phases *p);

/* y[i] = sum over the taps j, one after another, of tap[j] x[each i + j], i < n, and what was in y[i] where it adds. x
   is read up to each (n + turns), and is 0 but for first <= i < end. */
void phases_run(const struct phases *p, const double *x, long first, long end, long n, bool adds, double *y,
                double *room);

/* y[i] += sum over j of tap[j] x[i + stride j], i < n. x is read up to PHASES_WIDE values further. */
void phases_add(const double *tap, int taps, int stride, const double *x, long n, double *y);

#endif

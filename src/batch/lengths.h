/* How long the stimuli of a set are by themselves, for who wonders why all are as long as the longest. */
#ifndef BATCH_LENGTHS_H
#define BATCH_LENGTHS_H
#include "batch/design.h"

struct lengths {
    double least, most;  /* s                                   */
    int shortest, longest; /* stimuli, the first that are so long */
    int n;               /* of stimuli that were added; 0: none */
};

/* Stimulus i makes a sound of so many seconds; in the order of the design. */
void lengths_add(struct lengths *l, int i, double seconds);

/* "each 9.45 s, as long as the longest (NAME; the shortest, NAME, is 2.6 s by itself); length: own, or a time, in the design"; NULL: the design has another
   rule, or they differ by less than a hundredth. */
const char *lengths_told(const struct lengths *l, const struct design *d, struct arena *a);

#endif

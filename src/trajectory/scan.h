/* Least and greatest value of a function of time. */
#ifndef TRAJECTORY_SCAN_H
#define TRAJECTORY_SCAN_H
#include <stddef.h>

struct scan {
    void (*at)(const void *self, size_t n, const double *t, double *y);
    const void *self;
};

/* range[2]: least and greatest of y on [from, to]: on steps + 1 instants, then by golden section around each that could
   hold an extreme. Exact to the rounding of y where no two extremes of one kind fall within two steps; else too narrow
   by less than what y varies by in a step. */
void scan_range(const struct scan *, double from, double to, long steps, double range[2]);

#endif

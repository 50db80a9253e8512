/* What biases the statistics of impacts, in words. See impact_warnings.c. */
#ifndef ANALYSIS_IMPACT_WARNINGS_H
#define ANALYSIS_IMPACT_WARNINGS_H
#include "analysis/impact_statistics.h"

/* Fills s->warnings from the rest of s. interval[n - 1]: as they are. */
void impact_warnings(const struct impact_events *v, const double *interval, struct arena *a,
                     struct impact_statistics *s);

#endif

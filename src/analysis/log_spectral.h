/* The log-spectral distance of two sounds at several resolutions. */
#ifndef ANALYSIS_LOG_SPECTRAL_H
#define ANALYSIS_LOG_SPECTRAL_H
#include "file/wav.h"

/* dB: the mean of the distances with windows of about 5, 20 and 80 ms; 0: equal, or the reference is silent. a is the
   reference; both have the same rate and number of channels, and what both have in time is compared. */
double log_spectral(const struct wav *a, const struct wav *b);

#endif

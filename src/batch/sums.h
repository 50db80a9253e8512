/* SHA256SUMS and timings.csv of a set. */
#ifndef BATCH_SUMS_H
#define BATCH_SUMS_H
#include "batch/manifest.h"

/* All files of all stimuli but the summaries, then manifest.csv and manifest.json, as sha256sum -c reads them. ERR_CREATE, ERR_IO */
bool sums_write(const char *folder, const struct results *r, struct err *e);

/* What each stimulus took; n/a where that is not known any more. ERR_CREATE, ERR_IO */
bool sums_timings(const char *folder, const struct results *r, struct err *e);

#endif

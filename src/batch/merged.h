/* Is a set done already? A job that merges is sometimes run twice. */
#ifndef BATCH_MERGED_H
#define BATCH_MERGED_H
#include "batch/merge.h"

/* A folder without manifests of shards: r->already is how many stimuli its manifest.csv tells of, r->names and r->whys are those of them that are not there as it says. ERR_INPUT: some are not;
   there is no such table, or not as SHA256SUMS says; what is wrong with it, ERR_SCENE */
bool merged_already(const char *folder, struct arena *a, struct merge_report *r, struct err *e);

#endif

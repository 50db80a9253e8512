/* A set divided among several runs, "i/n" with i from 1. */
#ifndef BATCH_SHARD_H
#define BATCH_SHARD_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum { SHARD_MOST = 10000 };

struct shard {
    int i, n;   /* 1/1: all of it */
};

/* "3/7". ERR_USAGE */
bool shard_read(const char *text, struct shard *s, struct err *e);

/* Of "manifest.3-of-7.csv", as manifest_path calls it. False: it is no such name. */
bool shard_of_manifest(const char *name, struct shard *s);

/* Takes away what shards left for their merging, once the set is whole: their manifests, and DIR/.rasp/set.json. */
void shard_sweep(const char *folder);

/* to[k], of n jobs with these costs: its shard, from 1. The dearest first, each to the shard that has least so far (of equal ones the lowest): no shard has more
   than 4/3 of what the best division would give it. The same for the same costs. */
void shard_assign(const double *cost, int n, int shards, int *to, struct arena *a);

#endif

/* Which shards of a set a folder holds. */
#ifndef BATCH_MERGE_SHARDS_H
#define BATCH_MERGE_SHARDS_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

struct merge_shards {
    const char *folder;
    const char **files;  /* [n] their manifests, by name */
    int n;
    int of;              /* into how many the set was divided */
    const char *missing; /* "3,17"; "": none                  */
};

/* Fills folder, files and n. */
void merge_shards_find(const char *folder, struct arena *a, struct merge_shards *s);

/* Fills `of`. ERR_SCENE: they are of divisions into different numbers. */
bool merge_shards_agree(struct merge_shards *s, struct err *e);

/* Fills `missing`, after that. ERR_INPUT: some are. */
bool merge_shards_complete(struct merge_shards *s, struct arena *a, struct err *e);

/* Was a merge cut off while it took the manifests away? They are of the set that the folder holds, then, and what a set is described by is gone. */
bool merge_shards_swept(const struct merge_shards *s, struct arena *a);

#endif

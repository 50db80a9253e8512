/* No output of a set may be one of the files that it is made from, nor anybody's file. */
#ifndef BATCH_SPARE_H
#define BATCH_SPARE_H
#include "batch/set.h"
#include "batch/shard.h"

struct spare;                /* what the set reads, each file once, and what each stimulus writes */

struct spare_place {         /* where the set goes */
    const char *folder;
    const struct shard *shard;
    bool unknown;            /* nothing says whose files lie there */
    bool links;              /* symbolic links are written through */
};

struct spare *spare_open(const struct design *d, struct arena *a);

/* Notes the files that the scene of stimulus i reads, and the endings of those that it writes. By one thread at a time. */
void spare_scene(struct spare *s, int i, const struct scene *scene);

/* Is the file one that the set reads, as far as they were noted? */
bool spare_reads(const struct spare *s, const char *path);

/* first: [n] the stimulus whose scene was noted for stimulus i. False: ERR_CREATE, with both names; or a file of the set is there already, and the folder says nothing. */
bool spare_check(struct spare *s, const struct set *set, const int *first, const struct spare_place *place, struct err *e);

#endif

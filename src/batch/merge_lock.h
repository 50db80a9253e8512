/* One merge at a time: two would take the raw sounds away from each other. */
#ifndef BATCH_MERGE_LOCK_H
#define BATCH_MERGE_LOCK_H
#include <stdbool.h>

#include "base/arena.h"

struct merge_lock {
    const char *path; /* DIR/.rasp/merging */
    int fd;           /* -1: there is none */
};

/* False: another has it, and keeps it for a second. It ends with the program however that ends; where there are no locks, or nothing can be written, two are not told apart. */
bool merge_lock_take(const char *folder, struct arena *a, struct merge_lock *l);
void merge_lock_give(struct merge_lock *l);

/* Takes away what a merge that was killed has left of it. */
void merge_lock_sweep(const char *folder, struct arena *a);

#endif

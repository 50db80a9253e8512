/* Jobs by several threads, each job taken up in order and its result handed over in order. */
#ifndef BATCH_POOL_H
#define BATCH_POOL_H
#include <stdbool.h>

struct pool_work {
    int n;       /* jobs 0 .. n-1                                                                          */
    int threads; /* 1: all is done by the caller itself                                                    */
    void *context;
    bool (*job)(void *context, int i); /* by any thread, several at once; false: no further job is begun */
    void (*took)(void *context,
                 int i); /* by one thread at a time, for 0, 1, 2 ... as soon as all before it are done; may be NULL */
};

/* Does all jobs. Returns how many were done from 0 on without a gap: n, unless a job said stop. A thread that cannot be
 * started is done without. */
int pool_run(const struct pool_work *w);

#endif

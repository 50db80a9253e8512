/* Jobs by several threads, each job taken up in order and its result handed over in order; and the line on a terminal
   that says how far they are. */
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

/* "[ 37/240] scrape_r2_v10  x12.4  ETA 0:41" */
struct pool_progress {
    bool shown;         /* a terminal is there to show it                                        */
    double start, last; /* s; when it was last drawn                                             */
    double cost, done;  /* of all that is to be rendered; of what was                            */
    double sound;       /* s of sound rendered                                                   */
    int n, at;
};

/* quiet: nothing is shown; nor where standard error is no terminal, TERM is dumb, or CI is set. cost: in whatever unit,
 * of all n. */
void pool_progress_begin(struct pool_progress *p, int n, double cost, bool quiet);

/* One more is there: rendered at that cost, `sound` seconds long; or it was there already (cost 0 then, and `left` less
 * to do). */
void pool_progress_step(struct pool_progress *p, const char *name, double cost, double left, double sound);

/* Takes the line away, before something else is written and at the end. */
void pool_progress_clear(struct pool_progress *p);

/* "0:41", "1:02:03"; text has room for 24. */
void pool_progress_time(double seconds, char text[24]);

#endif

/* The end of a set: the common level, the tables, and nothing left over. What a whole batch and a merge of shards have in common. */
#ifndef BATCH_FINISH_H
#define BATCH_FINISH_H
#include "batch/job.h"
#include "batch/leftover.h"
#include "batch/manifest.h"

struct finish {
    const struct job_kit *kit;   /* design NULL (a merge): what is not there cannot be rendered again */
    struct results results;
    int threads;
    int entered;                 /* folder_enter's */
    struct arena *arena;
    double full_scale;           /* of the set, once it is known; NAN */
    bool anew;                   /* something was rendered: timings are written */
    const struct spare *inputs;  /* of the set, which are not left over; NULL: not known */
    bool prune;                  /* what is left over is removed */
    struct leftover left;        /* what is there besides the set */
    const char *unheard;         /* of unheard_find */
    bool alone;                  /* nobody else was at work in the folder at the end, and none can begin before folder_leave */
};

/* Where the level waits and all stimuli are there, gives them their gain. Failures of single stimuli go to their outcomes: so does one that would be rendered again for it and is not what
   it was (ERR_INPUT). ERR_SCENE, ERR_CREATE, ERR_IO, ERR_INTERRUPTED */
bool finish_level(struct finish *f, struct err *e);

/* Then writes manifest.csv, manifest.json, SHA256SUMS and timings.csv, settles the journal, sweeps, and looks for what is left over, and for factors that are not heard.
   ERR_CREATE, ERR_IO */
bool finish_tables(struct finish *f, struct err *e);

#endif

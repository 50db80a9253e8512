/* The shards of a set into one. */
#ifndef BATCH_MERGE_H
#define BATCH_MERGE_H
#include "batch/leftover.h"
#include "batch/manifest.h"

struct merge_report {
    struct set set;              /* n 0: it could not be read */
    struct outcome *outcomes;    /* [set.n] */
    struct journal *journal;     /* that has their records; NULL: none was opened */
    int shards;                  /* of how many it consists */
    int failed, waiting;
    double full_scale;           /* as of struct finish */
    struct leftover left;        /* as of struct batch_report */
    const char *unheard;         /* a warning of factors that are not heard; "": none */
    int already;                 /* there was nothing to merge: the set is done, of so many stimuli */
    const char *missing;         /* of shards, "3,17"; "": none */
    const char **names;          /* of stimuli that are not there as the shards left them; ends with NULL */
    const char **whys;           /* the same: what is the matter with each, "low.wav is missing" */
};

/* Joins what `rasp batch --shard` left in the folder: the result is that of a batch in one piece, byte for byte. ERR_INPUT: shards or stimuli are missing (the report says
   which), or neither anything of shards is there nor a set that is done (batch/merged.h); ERR_SCENE: they are of different designs, of different builds of the program, or of divisions into different numbers. ERR_CREATE: another merge is at work there. A set of which
   stimuli failed is joined all the same; then *e is the worst of the failures, and what the shards left stays. */
bool merge_run(const char *folder, int threads, struct arena *a, struct merge_report *r, struct err *e);

void merge_close(struct merge_report *r);

#endif

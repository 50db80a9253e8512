/* All scenes of a design are read, and their inputs opened, before anything is rendered. */
#ifndef BATCH_PREPARE_H
#define BATCH_PREPARE_H
#include "batch/design.h"
#include "batch/lengths.h"
#include "batch/set.h"
#include "batch/shard.h"
#include "batch/spare.h"

struct prepare_fault {
    struct arena *arena;     /* what it is told with                      */
    const struct diag *diag; /* of the scene's text                       */
    const char *messages;    /* the same as text; "": it is the error     */
    const struct err *err;
    const char *name;        /* of the first stimulus that has it         */
    int n;                   /* how many have it                          */
};

struct prepare_remark {      /* what a render will warn of */
    const char *text, *name; /* name: of the first stimulus that has it */
};

enum { PREPARE_FAULTS = 64 /* that are told apart; the next one stands for all others, whatever they say */ };

struct prepare_ask {
    const struct design *design;
    int threads;
    struct shelf *shelf;     /* for what the scenes read                  */
    const char *folder;      /* where the set goes; NULL: it is not said  */
    const struct shard *shard;
    bool replace;            /* what is there already may be anybody's    */
    bool links;              /* symbolic links are written through        */
};

struct prepare {
    double seconds;          /* of sound, all stimuli                     */
    int n_sounds;            /* how many make any                         */
    double *lengths;         /* s, [n]: of each                           */
    struct lengths own;      /* of those that sound, before they are made equal */
    double bytes, raw_bytes; /* of the WAVs; of what waits for a level    */
    double cycles;           /* predicted, of all                         */
    struct prepare_fault *faults;
    int n_faults, room;      /* 0: nothing is wrong; there is room for    */
    enum err_kind worst;     /* of all                                    */
    struct prepare_remark remarks[PREPARE_FAULTS]; /* the first that differ */
    int n_remarks;
    const struct spare *inputs; /* what the set is made from              */
};

/* Completes the set: its hash, costs, the common length, the form of the WAVs. Replicates of a cell differ in their noise alone: the first one is read for all. Takes as many
   threads. False: there are faults (*e: the gravest kind and a summary), or ERR_INTERRUPTED, or
   an output would take the place of an input, or of a file that nothing says to be this design's (ERR_CREATE). */
bool prepare_set(const struct prepare_ask *ask, struct arena *a, struct set *s, struct prepare *p, struct err *e);
void prepare_close(struct prepare *p);

#endif

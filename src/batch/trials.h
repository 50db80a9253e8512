/* The trials of a listening experiment, from a design's `trials` (design.h), and the order in which each participant
   has them.

   Stimuli that share the levels of all factors but those within a trial, and the replicate, are presented together:
   rated in one trial, or compared two by two. Orders are drawn by Philox streams whose names are the stimuli's: a
   participant more changes nobody's order, and a trial more comes in between the others. */
#ifndef BATCH_TRIALS_H
#define BATCH_TRIALS_H
#include "batch/design.h"

enum { TRIALS_SOUNDS = 100 /* in one trial */, TRIALS_MOST = 1000000, TRIALS_PEOPLE = 10000 };

struct trial {
    int id;             /* from 1, by levels, the first factor the slowest                                */
    int session, block; /* levels of those factors; -1: there is none                          */
    bool training;      /* its answer does not count                                           */
    int n, *stimuli;    /* of the design, in the order in which they are presented             */
    int reference;      /* the one of them that the others are rated by; -1: none              */
    const char *text;   /* of the design, for this trial; NULL: none                           */
    bool *differs;      /* [factors] among all that are compared with these; NULL: none is     */
    int part;           /* in a list: number of the block, from 1; 0: training before the first */
    uint64_t rank[2];   /* drawn for a list: of the block, of the trial                        */
};

struct trials {
    const struct design *design;
    struct trial *all;
    int n, most;   /* most: sounds of one trial                               */
    int *sessions; /* [n_sessions] levels of the factor; -1 alone: all is one */
    int n_sessions;
};

/* ERR_SCENE: a compared sound is alone; a trial has several references, or none where others have one, more than
   TRIALS_SOUNDS sounds, or several texts; there are more than TRIALS_MOST; all trials are of training. The design has
   `trials`. */
bool trials_make(const struct design *d, struct arena *a, struct trials *t, struct err *e);

/* The trials of one participant (from 1) in one sitting (from 1). Sessions: by a Latin square in which each comes at
   each place, and after each other, equally often over participants (Williams 1949). Training first; then blocks and
   trials, shuffled. */
struct trial *trials_list(const struct trials *t, uint64_t seed, int participant, int sitting, struct arena *a, int *n);

/* The number of the right answer, from 0; -1: there is none. */
int trials_right(const struct trials *t, const struct trial *x);

#endif

/* Runs the plan of one contact, block by block: memory does not grow with duration. */
#ifndef PIPELINE_RUN_H
#define PIPELINE_RUN_H
#include "pipeline/plan.h"

struct run {
    const struct scene *scene;
    struct plan plan;
    struct arena *arena;
    struct board board;
    struct stage_run *stages; /* those of the plan, in order */
    int n;
};

struct run_sinks { /* where the stages write; NULL: nowhere */
    struct table_sink *table;
    struct impact_sink *listing;
};

/* Opens the plan's stages and lays out the board; the first error closes what was opened. `sinks` NULL: no stage
 * writes. */
bool run_open(struct run *r, const struct plan *p, const struct scene *s, const struct run_sinks *sinks, struct err *e);

/* Frames [run so far, to): the sound is then on the board as ITEM_SOUND (if the plan has it). At most STAGE_BLOCK
 * frames a call. */
bool run_block(struct run *r, long to, struct err *e);

/* Goes on at a later frame, as though nothing had been before it: the board is empty; what stages remember is left as
   it is. Of stages behind the force only before the first block. As many frames as the stages look back in all, at
   least, are not yet as they would be. fade: frames over which the force rises from 0 there. */
void run_skip(struct run *r, long frame, long fade);

/* Frames for which stage i, which is open, costs what is predicted; of one without a block to run, such as a part of
   the surface, which costs where it is read, while the motion lasts. */
long run_works(const struct run *r, int i);

void run_close(struct run *r);

/* From now on a block in which a stage does an operation that has no result (0/0, the root of a negative number, a
   number compared with none), divides by 0 or overflows ends with ERR_NUMBERS, wherever that goes. Without it a run
   ends where a signal is not finite. */
void run_traps(void);

#endif

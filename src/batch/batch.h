/* A design into a folder of stimuli. */
#ifndef BATCH_BATCH_H
#define BATCH_BATCH_H
#include "batch/stimulus.h"
#include "batch/tables.h"

struct batch_ask {
    const char *design, *folder;
    const char *program; /* what it is called in the manifest, and what its results depend on */
    int threads;
    struct set_shard shard;
    int missing; /* shards that the set is divided into, of which those are asked for that are not whole; 0: not asked
                  */
    bool force, dry, quiet;
    bool replace, prune; /* as of struct folder_owner and folder_wanted; nothing is pruned by a shard */
    bool no_render;      /* what is not there is reported, not rendered */
};

struct batch_report {
    struct design design;
    struct set set;
    struct set_plan plan;
    const char *messages;        /* of a design that cannot be read, as of design_read; "" */
    struct tables_row *rows;     /* [set.n] NULL: nothing was planned                       */
    enum stimulus_state *states; /* [set.n] of a dry run that knows the folder; else NULL */
    bool *mine;                  /* [set.n] of this shard */
    int n_mine, rendered, reused, failed, waiting;
    bool rendering;            /* something was written, or found right */
    const char *missing;       /* "3,17": shards that are not whole, if they were asked for */
    double full_scale;         /* the set's; NAN: it has none, or it is not known yet */
    struct folder_stale stale; /* what is in the folder besides; of a shard nothing is known */
    const char *no_effect;     /* of tables_write */
    double seconds;            /* wall clock */
};

/* Exit code of the whole in *e: ERR_NONE, the worst of the stimuli's, that of what stopped it. False: *e is set. What
 * was rendered is there in any case. The report is closed in any case, too, by batch_close. */
bool batch_run(const struct batch_ask *ask, struct arena *a, struct batch_report *r, struct err *e);

void batch_close(struct batch_report *r);

#endif

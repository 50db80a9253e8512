/* A design into a folder of stimuli. */
#ifndef BATCH_BATCH_H
#define BATCH_BATCH_H
#include "batch/leftover.h"
#include "batch/manifest.h"
#include "batch/prepare.h"

struct batch_ask {
    const char *design, *folder;
    const char *build;          /* what the program is called in the manifest, and what its results depend on */
    int threads;
    struct shard shard;
    bool force, dry, quiet;
    bool replace, prune;        /* as of struct claim; what is left over is removed (not by a shard) */
};

struct batch_report {
    struct design design;
    struct set set;
    struct prepare prepare;
    const char *messages;       /* of a design that cannot be read, as of design_read; "" */
    struct outcome *outcomes;   /* [set.n] */
    struct journal *journal;    /* that has their records; NULL: nothing was rendered */
    bool *mine;                 /* [set.n] of this shard */
    int n_mine, rendered, kept, failed, waiting;
    double full_scale;          /* the set's; NAN: it has none, or it is not known yet */
    struct leftover left;       /* what is in the folder besides; of a shard nothing is known */
    const char *unheard;        /* a warning of factors that are not heard; "": none */
    double seconds;             /* wall clock */
};

/* Exit code of the whole in *e: ERR_NONE, the worst of the stimuli's, that of what stopped it. False: *e is set. What was rendered is there in any case. The report is closed in any case, too, by batch_close. */
bool batch_run(const struct batch_ask *ask, struct arena *a, struct batch_report *r, struct err *e);

void batch_close(struct batch_report *r);

#endif

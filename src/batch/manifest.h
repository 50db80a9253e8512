/* The table of a set: manifest.csv, one row a stimulus, in the order of the design; manifest.json, its side-car (a BIDS data dictionary); SHA256SUMS. Nothing in them differs
   from run to run, from machine to machine, or with the number of threads or shards. What does is in timings.csv. */
#ifndef BATCH_MANIFEST_H
#define BATCH_MANIFEST_H
#include <stdio.h>

#include "base/err.h"
#include "batch/journal.h"
#include "batch/set.h"
#include "batch/shard.h"

struct outcome {                 /* of one stimulus                                          */
    struct journal_ref record;   /* size 0: it failed, or is not of this shard               */
    struct journal_ref raw;      /* of what failed when it got its level: its raw sound, which stays; size 0: none */
    struct journal_ref refused;  /* of what a merge could not give another level: what there was, which a shard makes anew; size 0: none */
    bool waits;                  /* the record is of a raw sound, which waits for its gain   */
    bool kept;                   /* it was there                                             */
    enum err_kind kind;          /* why it failed; ERR_NONE without a record: not tried      */
    const char *text;            /* of the error                                             */
};

struct results {                 /* of a set                                                 */
    const struct set *set;
    struct outcome *of;          /* [set->n]                                                 */
    struct journal *journal;     /* that has their records                                   */
};

/* "FOLDER/manifest.csv"; of a shard (n > 1) "FOLDER/manifest.i-of-n.csv". */
const char *manifest_path(const char *folder, const struct shard *shard, struct arena *a);

/* manifest_path: of a whole set, or of a shard with the rows in `mine` and, in comments before the header, design, build and shard.
   ERR_CREATE, ERR_IO */
bool manifest_write(const char *folder, const struct results *r, const struct shard *shard, const bool *mine, struct err *e);

/* The header and the rows. ERR_IO: a record cannot be read again */
bool manifest_print(FILE *f, const struct results *r, const bool *mine, struct err *e);

/* manifest.json. ERR_CREATE, ERR_IO */
bool manifest_describe(const char *folder, const struct set *s, struct err *e);

#endif

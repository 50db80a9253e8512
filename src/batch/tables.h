/* The tables of a set, from its records, in the order of the design: manifest.csv, one row a stimulus;
   manifest.jsonl, the same as a line of JSON each; manifest.json,
   its side-car (a BIDS data dictionary); SHA256SUMS, last. Nothing in them differs from run to run, from machine to
   machine, or with the number of threads or shards. timings.csv has what the last run rendered that rendered anything.
 */
#ifndef BATCH_TABLES_H
#define BATCH_TABLES_H
#include <stdio.h>

#include "batch/record.h"
#include "batch/set.h"

struct tables_row {     /* what became of a stimulus */
    bool there;         /* it has a record           */
    bool made;          /* by this run               */
    double wall, cpu;   /* s, if so                  */
    enum err_kind kind; /* why it failed; ERR_NONE without a record: it is missing */
    const char *text;   /* of the error              */
};

struct tables {
    const struct set *set;
    const char *folder;
    const struct tables_row *rows; /* [set->n] */
    struct arena *arena;
};

/* *no_effect: one sentence that names factors without effect, or says replicates: stimuli that differ in one and have
   the same samples; "": there are none. Recordings, and what makes no sound, do not count. ERR_CREATE, ERR_IO */
bool tables_write(const struct tables *t, const char **no_effect, struct err *e);

/* Those that speak of files that may be replaced. */
void tables_remove(const char *folder, struct arena *a);

/* Did the last run end? */
bool tables_are_there(const char *folder, struct arena *a);

/* The shortest decimal number that reads back as the same; "n/a" of what is not finite. */
void tables_number(FILE *f, double x);

/* A cell, quoted where RFC 4180 wants it. */
void tables_text(FILE *f, const char *text);

#endif

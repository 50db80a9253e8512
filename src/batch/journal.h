/* What has been done in an output folder: DIR/.rasp/journal, one record a line, and of shards DIR/.rasp/journal.i-of-n.

   A record is added by one write to the end of the file, so that a program that is killed leaves whole lines and at most a piece of one; it begins with a line end,
   so that such a piece spoils nothing behind it. Several programs may add to one journal. Of a stimulus several records may be there. Nothing is fsynced: what a power cut
   takes is rendered again, for its files' hashes are looked at.

   No record is held in memory, where those of 10 000 stimuli would take 50 MB: all that were read or added are lines of an unnamed file, which other programs do not touch. */
#ifndef BATCH_JOURNAL_H
#define BATCH_JOURNAL_H
#include "base/err.h"
#include "batch/record.h"

struct journal;

struct journal_ref {         /* a record, as long as the journal is open */
    long at;
    int size;                /* 0: none */
};

/* Reads all journals of the folder, and opens `path` (within the folder's .rasp) for more. path NULL: only reads. ERR_CREATE, ERR_IO */
struct journal *journal_open(const char *folder, const char *path, struct arena *a, struct err *e);

/* The latest record with that key or job hash: of those that are complete, or of those that wait for their gain. NULL: none. Those that are added later are not found. */
const struct record *journal_find(struct journal *j, const char *hash, bool waits, struct arena *a, struct journal_ref *ref);

struct journal_wish {
    const char *hash;        /* as of journal_find */
    bool waits;
    bool (*good)(const void *context, const struct record *r, struct arena *a);
    const void *context;
};

/* The latest one that is good, besides. */
const struct record *journal_find_such(struct journal *j, const struct journal_wish *wish, struct arena *a, struct journal_ref *ref);

/* From any thread. ERR_IO */
bool journal_add(struct journal *j, const struct record *r, struct journal_ref *ref, struct err *e);

/* What was found or added; from any thread. ERR_IO */
const struct record *journal_read(struct journal *j, struct journal_ref ref, struct arena *a, struct err *e);

void journal_close(struct journal *j);

/* Calls for every record that was read, in no order, a record twice perhaps; it is gone when the call returns. ERR_IO */
bool journal_each(struct journal *j, void (*take)(void *context, const struct record *r, struct journal_ref ref), void *context, struct err *e);

/* Replaces the folder's journals by one of these records, in their order, without times (size 0: left out). The journal itself goes on. ERR_CREATE, ERR_IO */
bool journal_settle(struct journal *j, const struct journal_ref *refs, int n, struct err *e);

#endif

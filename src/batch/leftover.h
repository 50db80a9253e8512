/* Files in a set's folder that were of a stimulus once, and are of none as it is now: a level was taken out, a name was changed, a stem is not asked for any more, another design took the folder over,
   or the stimulus failed, or waits for its level, and what is there is what it was before. They are told, never removed unless that is asked for. */
#ifndef BATCH_LEFTOVER_H
#define BATCH_LEFTOVER_H
#include "batch/manifest.h"
#include "batch/spare.h"

struct leftover {
    struct journal_ref *refs;    /* records of what the set has not, of which some file is there */
    int n;
    const char **files;          /* their files that are there, as seen from the folder, by name; ends with NULL */
    int n_files, removed;        /* removed: how many files there were, and are no more                           */
};

struct leftover_ask {
    const char *folder;
    const struct results *all;
    const struct spare *inputs;  /* files that the set is made from are not left over; NULL: not known            */
    bool remove;                 /* stimuli whose files have the bytes that they were written with; what was changed since stays, and is told */
};

/* ERR_IO: the journal cannot be read again */
bool leftover_find(const struct leftover_ask *ask, struct arena *a, struct leftover *l, struct err *e);

#endif

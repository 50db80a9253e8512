/* The output folder of a batch: what it makes in it, and what it takes away. DIR/.rasp holds the journal and, while a common level is not known, the raw sounds. */
#ifndef BATCH_FOLDER_H
#define BATCH_FOLDER_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

/* DIR (its parent must be there), DIR/.rasp. ERR_CREATE */
bool folder_make(const char *folder, struct err *e);

/* The folders in which a file named so within `folder` will stand; harmless when they are there, and when several threads do it. ERR_CREATE */
bool folder_make_for(const char *folder, const char *name, struct err *e);

/* Says, until folder_leave, that a program works in the folder: a shared lock (flock) on DIR/.rasp, which ends with the program however that ends. -1: there are no locks here. */
int folder_enter(const char *folder);
void folder_leave(int entered);

/* Is no other program at work in it? Then none can begin before folder_leave. Whoever is told no leaves the sweeping to the other. Asked once. */
bool folder_is_mine(int entered);

/* Takes away what a program that was killed may have left: raw sounds (raw: of a set that is complete), and hidden names of files that were about to be complete
   (.rasp-PID-*.part) whose program is not there any more. Only in folders in which one of these names stands. Errors are no matter. */
void folder_sweep(const char *folder, const char *const *names, int n, bool raw);

/* The text with the names of files in the folder as they are seen from there: tables and journals of a set do not say where it was made. */
const char *folder_seen(const char *folder, const char *text, struct arena *a);

/* Bytes free for files in it; a great number when that cannot be told. */
double folder_free(const char *folder);

#endif

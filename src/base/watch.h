/* Files that must not change while something is made of them: how each is when it begins to be watched, and whether it
   still is. Told by what stat tells, whose time of change no program can set: a file that was changed and then put back
   has changed. */
#ifndef BASE_WATCH_H
#define BASE_WATCH_H
#include <stdbool.h>
#include <sys/stat.h>

#include "base/arena.h"

struct watch {
    const char **files; /* [n] */
    struct stat *was;   /* [n]; st_nlink 0: it was not there */
    int n;
};

/* The names are not copied. */
struct watch watch_begin(const char **files, int n, struct arena *a);

/* The first that has changed, come or gone since; NULL: none. */
const char *watch_changed(const struct watch *w);

/* Of one file: the same bytes in the same place, as far as stat tells. */
bool watch_same(const struct stat *a, const struct stat *b);

#endif

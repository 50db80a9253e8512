/* What several renders read of the same files, or compute from the same keys: it is made by the first that asks, and
   stays for the others, who only look at it. Any number of threads may ask; who asks for what is being made waits. A
   file that has changed since (its size, its time, its place on the disk) is read anew. */
#ifndef BASE_FILE_CACHE_H
#define BASE_FILE_CACHE_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct file_cache;

struct file_cache_kind {
    const char *name; /* "mode table": of one file there may be several things */
    size_t size;      /* of the thing, a struct that `make` fills              */
    bool (*make)(const char *file, const void *how, struct arena *a, void *thing, struct err *e);
    bool small; /* there is room for it in any case; `make` gets no arena */
};

struct file_cache_ask {
    const struct file_cache_kind *kind;
    const char *file; /* "": it is made of the key alone                                              */
    const char *key;  /* all that it depends on besides the file's content, as text; NULL: nothing   */
    const void *how;  /* the same, for make                                                          */
};

/* Holds that many bytes, about: what is asked for beyond is read by everyone who asks, unless it is small. Hashes are
 * small: a file that had to be known by its hash is watched. */
enum { FILE_CACHE_MOST = 256 << 20 }; /* what a command holds */
struct file_cache *file_cache_open(size_t most);
void file_cache_close(struct file_cache *s);

/* Not to be changed. s NULL: it is made in the arena, of which its life is then; else it lives as long as the
 * shorter-lived of file cache and arena. NULL: the error of make, which is not kept. */
const void *file_cache_take(struct file_cache *s, const struct file_cache_ask *ask, struct arena *a, struct err *e);

/* A file, as seen from the current folder, that is no more what it was when it was read; NULL: all are (of those that
 * there was room for). */
const char *file_cache_changed(struct file_cache *s, struct arena *a);

/* The file's sha256 as text. ERR_INPUT */
const char *file_cache_sha256(struct file_cache *s, const char *file, struct arena *a, struct err *e);

/* Files that must not change while something is made of them: how each is when it begins to be watched, and whether it
   still is. Told by what stat tells, whose time of change no program can set: a file that was changed and then put back
   has changed. */
struct file_cache_state {
    long of[7]; /* device, inode, size, times of its bytes and of its change; 0: it is not there */
};

struct watch {
    const char **files;           /* [n] */
    struct file_cache_state *was; /* [n] */
    int n;
};

/* The names are not copied. */
struct watch file_cache_watch(const char **files, int n, struct arena *a);

/* The first that has changed, come or gone since; NULL: none. */
const char *file_cache_watch_changed(const struct watch *w);

#endif

/* See watch.h. */
#include "base/watch.h"

bool watch_same(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
           a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec &&
           a->st_ctim.tv_sec == b->st_ctim.tv_sec && a->st_ctim.tv_nsec == b->st_ctim.tv_nsec;
}

static struct stat look(const char *file)
{
    struct stat s;
    return stat(file, &s) == 0 ? s : (struct stat){.st_nlink = 0};
}

struct watch watch_begin(const char **files, int n, struct arena *a)
{
    struct watch w = {files, ARENA_TAKE(a, struct stat, n), n};
    for (int i = 0; i < n; i++)
        w.was[i] = look(files[i]);
    return w;
}

const char *watch_changed(const struct watch *w)
{
    for (int i = 0; i < w->n; i++) {
        struct stat now = look(w->files[i]);
        if ((now.st_nlink == 0) != (w->was[i].st_nlink == 0) || !watch_same(&now, &w->was[i])) return w->files[i];
    }
    return NULL;
}

/* See merge_lock.h. A file of its own: over NFS, a lock of one kind on a file that claim.c locks, too, is in the way of the other kind, even within a program. Whoever gives the lock
   back removes the file, so that a set from shards is the same as one in one piece; who waited for it has then locked a file that is not there any more, and takes the next. */
#include "batch/merge_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { TRIES = 20 };

static bool is_at(const char *path, int fd)
{
    struct stat a, b;
    return fstat(fd, &a) == 0 && stat(path, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

static void drop(struct merge_lock *l)
{
    if (l->fd >= 0)
        close(l->fd);
    l->fd = -1;
}

bool merge_lock_take(const char *folder, struct arena *a, struct merge_lock *l)
{
    *l = (struct merge_lock){arena_format(a, "%s/.rasp/merging", folder), -1};
    for (int tries = 0; tries < TRIES; tries++) {
        if (tries) /* one that was killed takes a moment to be gone */
            nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
        l->fd = open(l->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (l->fd < 0)
            return true;
        bool locked = flock(l->fd, LOCK_EX | LOCK_NB) == 0;
        if (locked ? is_at(l->path, l->fd) : errno != EWOULDBLOCK)
            return true;
        drop(l);
    }
    return false;
}

void merge_lock_give(struct merge_lock *l)
{
    if (l->fd >= 0)
        unlink(l->path);
    drop(l);
}

void merge_lock_sweep(const char *folder, struct arena *a)
{
    struct merge_lock l;
    if (access(arena_format(a, "%s/.rasp/merging", folder), F_OK) == 0 && merge_lock_take(folder, a, &l))
        merge_lock_give(&l);
}

/* Loaded into a program (LD_PRELOAD): the n-th call of rename fails (CALLS_RENAME=n), as on a disk that breaks; locks
 * are not there (CALLS_NO_LOCKS), as on some file systems of networks. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/file.h>

static atomic_long renames;

int rename(const char *from, const char *to)
{
    static int (*real)(const char *, const char *);
    const char *at = getenv("CALLS_RENAME");
    if (!real) *(void **)&real = dlsym(RTLD_NEXT, "rename");
    if (at && ++renames == atol(at)) {
        errno = EIO;
        return -1;
    }
    return real(from, to);
}

int flock(int fd, int operation)
{
    static int (*real)(int, int);
    if (!real) *(void **)&real = dlsym(RTLD_NEXT, "flock");
    if (getenv("CALLS_NO_LOCKS")) {
        errno = ENOLCK;
        return -1;
    }
    return real(fd, operation);
}

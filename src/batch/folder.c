/* See folder.h. */
#include "batch/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/text.h"

/* Of ENOENT. */
static const char *missing(const char *path)
{
    char parent[4096];
    struct stat s;
    const char *slash = strrchr(path, '/');
    snprintf(parent, sizeof parent, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
    return stat(parent, &s) == 0 ? "no folder can be made there: choose another place with -o" : "its parent is not there";
}

static bool make_one(const char *path, struct err *e)
{
    struct stat s;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &s) == 0 && S_ISDIR(s.st_mode)))
        return true;
    return err_set(e, err_system(ERR_CREATE), "the folder %s cannot be created: %s", path,
                   errno == ENOENT ? missing(path) : errno == EEXIST ? "a file has that name" : strerror(errno));
}

bool folder_make(const char *folder, struct err *e)
{
    char hidden[4096];
    snprintf(hidden, sizeof hidden, "%s/.rasp", folder);
    return make_one(folder, e) && make_one(hidden, e);
}

bool folder_make_for(const char *folder, const char *name, struct err *e)
{
    char path[4096];
    for (const char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        if (snprintf(path, sizeof path, "%s/%.*s", folder, (int)(slash - name), name) >= (int)sizeof path)
            return err_set(e, ERR_CREATE, "%s/%s: the path is too long", folder, name);
        if (!make_one(path, e))
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ who is at work */

int folder_enter(const char *folder)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/.rasp", folder);
    int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0 && flock(fd, LOCK_SH) == 0)
        return fd;
    folder_leave(fd);
    return -1;
}

void folder_leave(int entered)
{
    if (entered >= 0)
        close(entered);
}

/* A lock that cannot be had at once is lost with the one that was held: of two that ask, the second gets it. */
bool folder_is_mine(int entered)
{
    return entered < 0 || flock(entered, LOCK_EX | LOCK_NB) == 0;
}

/* ------------------------------------------------------------------ what a killed program left */

/* "(rasp) S": what the system calls a process, and its state; "" if there is none. */
static void process_named(const char *pid, char text[64])
{
    char path[64], line[256] = "";
    snprintf(path, sizeof path, "/proc/%s/stat", pid);
    FILE *f = fopen(path, "r");
    if (f && !fgets(line, sizeof line, f))
        line[0] = '\0';
    if (f)
        fclose(f);
    const char *from = strchr(line, '('), *to = strrchr(line, ')');
    snprintf(text, 64, "%.*s", from && to > from ? (int)(to - from) + 3 : 0, from ? from : "");
}

/* Does a program like this one run under that number? One that was killed may still be there, as a zombie; and its number may have gone to another. */
static bool runs(int pid)
{
    char number[16], other[64], self[64];
    snprintf(number, sizeof number, "%d", pid);
    process_named("self", self);
    process_named(number, other);
    size_t n = strlen(self);
    if (!n)
        return kill(pid, 0) == 0 || errno != ESRCH; /* no /proc */
    return strlen(other) == n && !strncmp(self, other, n - 1) && other[n - 1] != 'Z' && other[n - 1] != 'X';
}

/* ".rasp-1234-0.part" of a process that is not there: it was about to be renamed. */
static bool is_left(const char *name)
{
    const char *dash = !strncmp(name, ".rasp-", 6) ? strchr(name + 6, '-') : NULL;
    size_t n = strlen(name), digits = dash ? (size_t)(dash - name) - 6 : 0;
    char text[16] = "";
    int pid;
    if (!dash || n < 6 || strcmp(name + n - 5, ".part") != 0 || digits >= sizeof text)
        return false;
    memcpy(text, name + 6, digits);
    return text_int(text, 1, 2147483647, &pid) && !runs(pid);
}

static void sweep_one(const char *folder)
{
    char path[4096];
    DIR *d = opendir(folder);
    if (!d)
        return;
    for (const struct dirent *entry; (entry = readdir(d));)
        if (is_left(entry->d_name) && snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) < (int)sizeof path)
            unlink(path);
    closedir(d);
}

static int remove_it(const char *path, const struct stat *s, int kind, struct FTW *where)
{
    (void)s;
    (void)kind;
    (void)where;
    remove(path);
    return 0;
}

static bool same_folder(const char *a, const char *b)
{
    const char *x = strrchr(a, '/'), *y = strrchr(b, '/');
    return (x ? x - a : 0) == (y ? y - b : 0) && (!x || !strncmp(a, b, (size_t)(x - a)));
}

void folder_sweep(const char *folder, const char *const *names, int n, bool raw)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/.rasp/raw", folder);
    if (raw)
        nftw(path, remove_it, 16, FTW_DEPTH | FTW_PHYS);
    snprintf(path, sizeof path, "%s/.rasp", folder);
    sweep_one(path);
    sweep_one(folder);
    for (int i = 0; i < n; i++) {
        const char *slash = strrchr(names[i], '/');
        if (slash && (i == 0 || !same_folder(names[i], names[i - 1])) && snprintf(path, sizeof path, "%s/%.*s", folder, (int)(slash - names[i]), names[i]) < (int)sizeof path)
            sweep_one(path);
    }
}

static const char *behind(const char *text, const char *start)
{
    size_t n = strlen(start);
    return strncmp(text, start, n) ? text : text + n;
}

const char *folder_seen(const char *folder, const char *text, struct arena *a)
{
    const char *prefix = arena_format(a, "%s/", folder), *from = text;
    char *seen = arena_text(a, text), *to = seen;
    while (*from) {
        bool begins = from == text || strchr(" '\"(", from[-1]);
        const char *within = begins ? behind(from, prefix) : from;
        if (within == from)
            *to++ = *from++;
        else
            from = behind(within, ".rasp/raw/");
    }
    *to = '\0';
    return seen;
}

double folder_free(const char *folder)
{
    struct statvfs s;
    return statvfs(folder, &s) == 0 ? (double)s.f_bavail * (double)s.f_frsize : HUGE_VAL;
}

/* See outfile.h. The data needs no fsync: the promise is against a program that dies, not against a power cut.

   open(folder, O_TMPFILE)      an inode without a name: gone when the program is
   linkat(/proc/self/fd/N)      a hidden name in the same folder, for linkat cannot replace an existing file
   rename                       over the target, atomically

   Whatever the reason why O_TMPFILE fails (NFS and FUSE do not have it, old kernels answer EISDIR), and where /proc is
   not mounted, the hidden name is there from the start. */
#include "base/outfile.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/memory.h"
#include "base/relpath.h"

enum { NAMES = 10000 };

/* Length of the folder part of a path with its last slash; 0: the current folder. */
static int folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (int)(slash - path) + 1 : 0;
}

static void hidden_name(struct outfile *o, int k)
{
    snprintf(o->temporary, sizeof o->temporary, "%.*s.rasp-%ld-%d.part", folder_length(o->target), o->target,
             (long)getpid(), k);
}

static bool open_unnamed(struct outfile *o)
{
    char folder[sizeof o->target + 2], proc[64];
    snprintf(folder, sizeof folder, "%.*s.", folder_length(o->target), o->target);
    o->fd = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    if (o->fd < 0) return false;
    snprintf(proc, sizeof proc, "/proc/self/fd/%d", o->fd);
    if (access(proc, F_OK) == 0) return true;
    close(o->fd);
    return false;
}

static bool try_hidden(struct outfile *o)
{
    o->fd = open(o->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return o->fd >= 0;
}

/* Gives an unnamed file its hidden name. */
static bool try_name(struct outfile *o)
{
    char proc[64];
    snprintf(proc, sizeof proc, "/proc/self/fd/%d", o->fd);
    return linkat(AT_FDCWD, proc, AT_FDCWD, o->temporary, AT_SYMLINK_FOLLOW) == 0;
}

/* Tries to give it a hidden name, which goes with the program if that is interrupted or out of memory: it is
   registered before there is such a file, since to register it takes memory. */
static bool try_registered(struct outfile *o, bool (*try)(struct outfile *o))
{
    bool ok = false;
    int why = EEXIST;
    interrupt_hold();
    for (int k = 0; !ok && why == EEXIST && k < NAMES; k++) {
        hidden_name(o, k);
        interrupt_temporary(o->temporary);
        ok = try(o);
        why = errno;
        if (!ok) interrupt_forget(o->temporary);
    }
    interrupt_go();
    if (!ok) o->temporary[0] = '\0';
    errno = why;
    return ok;
}

static bool set_target(struct outfile *o, const char *target, struct err *e)
{
    struct stat s;
    char whole[4096]; /* PATH_MAX, which realpath wants */
    size_t n = strlen(target);
    if (n == 0) return err_set(e, ERR_CREATE, "an output needs a name");
    if (n >= sizeof o->target) return err_set(e, ERR_CREATE, "%.60s...: the path is too long", target);
    if (target[n - 1] == '/')
        return err_set(e, ERR_CREATE, "%s: is the name of a folder; a file name is needed", target);
    memcpy(o->target, target, n + 1);
    if (stat(target, &s) != 0) return errno == ENOENT; /* else a name that rename would refuse when all is done */
    if (!S_ISREG(s.st_mode))
        return err_set(e, ERR_CREATE, "%s: %s", target,
                       S_ISDIR(s.st_mode) ? "is a folder; a file name is needed"
                                          : "is not a regular file and would be replaced");
    if (access(target, W_OK) != 0)
        return err_set(e, err_system(ERR_CREATE), "%s: exists and cannot be written: %s", target, strerror(errno));
    if (realpath(target, whole)) memcpy(o->target, whole, strlen(whole) + 1);
    return true;
}

static bool open_one(struct outfile *o, const char *target, bool unnamed, struct err *e)
{
    *o = (struct outfile){.fd = -1};
    if (set_target(o, target, e) && ((unnamed && open_unnamed(o)) || try_registered(o, try_hidden))) return true;
    const char *why = strerror(errno);
    if (errno == ENOENT) { /* there is no folder, or one in which there can be no such file, as in /proc */
        char folder[sizeof o->target + 2];
        struct stat s;
        snprintf(folder, sizeof folder, "%.*s.", folder_length(o->target), o->target);
        why = stat(folder, &s) == 0 ? "its folder is none in which files can be made: choose another"
                                    : "its folder does not exist";
        errno = ENOENT;
    }
    err_set(e, err_system(ERR_CREATE), "%s: cannot be created: %s", target, why);
    o->target[0] = '\0';
    return false;
}

bool outfile_open_fd(struct outfile *o, const char *target, struct err *e) { return open_one(o, target, true, e); }

bool outfile_open_hidden(struct outfile *o, const char *target, struct err *e) { return open_one(o, target, false, e); }

bool outfile_open(struct outfile *o, const char *target, struct err *e)
{
    if (!outfile_open_fd(o, target, e)) return false;
    o->stream = fdopen(o->fd, "w+");
    if (o->stream) return true;
    err_set(e, err_system(ERR_CREATE), "%s: cannot be created: %s", target, strerror(errno));
    outfile_drop(o);
    return false;
}

static bool close_it(struct outfile *o)
{
    int bad = o->stream ? fclose(o->stream) : close(o->fd);
    o->stream = NULL;
    o->fd = -1;
    return bad == 0;
}

static bool flush_it(struct outfile *o)
{
    if (!o->stream) return true;
    if (fflush(o->stream) != 0) return false;
    errno = o->why ? o->why : EIO; /* an earlier write failed; its reason is not kept by the stream */
    return !ferror(o->stream);
}

static bool give_up(struct outfile *o, struct err *e)
{
    err_set(e, err_system(ERR_IO), "%s: cannot be written: %s", o->target, strerror(errno));
    outfile_drop(o);
    return false;
}

void outfile_put(struct outfile *o, const void *data, size_t n)
{
    errno = 0;
    if (fwrite(data, 1, n, o->stream) != n && !o->why) o->why = errno;
}

bool outfile_finalise(struct outfile *o, struct err *e)
{
    if (o->target[0] == '\0') return err_set(e, ERR_IO, "an output that is closed already cannot be committed");
    bool open = o->fd >= 0;
    return !open || (flush_it(o) && (o->temporary[0] || try_registered(o, try_name)) && close_it(o)) || give_up(o, e);
}

bool outfile_hash(struct outfile *o, char hex[HASH_TEXT], struct err *e)
{
    char piece[1 << 14];
    ssize_t n = 0;
    if (!flush_it(o)) return give_up(o, e);
    struct hash h = hash_start();
    for (off_t at = 0; (n = pread(o->fd, piece, sizeof piece, at)) > 0; at += n)
        hash_add(&h, piece, (size_t)n);
    hash_end(&h, hex);
    return n == 0 || give_up(o, e);
}

bool outfile_commit(struct outfile *o, struct err *e)
{
    if (!outfile_finalise(o, e)) return false;
    interrupt_hold();
    bool ok = rename(o->temporary, o->target) == 0;
    if (ok) interrupt_forget(o->temporary);
    interrupt_go();
    if (!ok) return give_up(o, e);
    o->target[0] = o->temporary[0] = '\0';
    return true;
}

void outfile_drop(struct outfile *o)
{
    if (o->target[0] == '\0') return;
    if (o->fd >= 0) close_it(o);
    if (o->temporary[0]) {
        unlink(o->temporary);
        interrupt_forget(o->temporary);
    }
    o->target[0] = o->temporary[0] = '\0';
}

int outfile_commit_all(struct outfile *all, int n, struct err *e)
{
    int done = 0;
    for (int i = 0; e->kind == ERR_NONE && i < n; i++)
        outfile_finalise(&all[i], e);
    interrupt_hold();
    while (e->kind == ERR_NONE && done < n && outfile_commit(&all[done], e))
        done++;
    interrupt_go();
    for (int i = 0; i < n; i++)
        outfile_drop(&all[i]);
    return done;
}

/* ------------------------------------------------------------------ files without a name */

const char *outfile_scratch_folder(void)
{
    const char *folder = getenv("TMPDIR");
    return folder && *folder ? folder : "/tmp";
}

FILE *outfile_scratch_open(void)
{
    int fd = open(outfile_scratch_folder(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    char name[4096];
    bool fits = snprintf(name, sizeof name, "%s/rasp-XXXXXX", outfile_scratch_folder()) < (int)sizeof name;
    if (fd < 0 && !fits) errno = ENAMETOOLONG;
    if (fd < 0 && fits) { /* a name that is forgotten at once */
        interrupt_hold();
        fd = mkostemp(name, O_CLOEXEC);
        if (fd >= 0) unlink(name);
        interrupt_go();
    }
    FILE *f = fd >= 0 ? fdopen(fd, "w+") : NULL;
    if (!f && errno == ENOMEM) memory_out("to open a temporary file");
    if (!f && fd >= 0) close(fd);
    return f;
}

const char *outfile_scratch_make_folder(const char *name, struct arena *a, struct err *e)
{
    char *path = arena_format(a, "%s/%s-XXXXXX", outfile_scratch_folder(), name);
    interrupt_hold();
    bool made = mkdtemp(path) != NULL;
    if (made) interrupt_temporary(path);
    interrupt_go();
    if (!made)
        err_set(e, ERR_CREATE,
                "%s: no temporary folder can be made there: %s; set TMPDIR to a folder that can be written",
                outfile_scratch_folder(), strerror(errno));
    return made ? path : NULL;
}

/* ------------------------------------------------------------------ folders */

static int remove_one(const char *path, const struct stat *s, int kind, struct FTW *where)
{
    (void)s, (void)kind, (void)where;
    remove(path);
    return 0;
}

static void remove_folder(const char *path) { nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS); }

const char *outfile_folder_open(const char *target, struct arena *a, struct err *e)
{
    const char *temporary = arena_format(a, "%s/.rasp-%ld.part", relpath_folder(target, a), (long)getpid());
    interrupt_hold();
    bool made = mkdir(temporary, 0777) == 0;
    int why = errno;
    if (made) interrupt_temporary(temporary);
    interrupt_go();
    if (made) return temporary;
    err_set(e, ERR_CREATE, "%s: cannot be created: %s", target,
            why == ENOENT ? "its folder does not exist" : strerror(why));
    return NULL;
}

bool outfile_folder_close(const char *target, const char *temporary, bool ok, struct arena *a, struct err *e)
{
    const char *old = arena_format(a, "%s.old", temporary);
    interrupt_hold();
    bool moved = ok && access(target, F_OK) == 0 && rename(target, old) == 0;
    if (ok && rename(temporary, target) != 0) {
        ok = err_set(e, ERR_CREATE, "%s: cannot be created: %s", target, strerror(errno));
        if (moved) rename(old, target);
        moved = false;
    }
    if (moved) remove_folder(old);
    if (!ok) remove_folder(temporary);
    interrupt_forget(temporary);
    interrupt_go();
    return ok;
}

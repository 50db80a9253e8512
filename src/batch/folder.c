/* See folder.h. */
#include "batch/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/record.h"
#include "file/bytes.h"
#include "output/mark.h"

/* ------------------------------------------------------------------ folders */

static bool make_one(const char *path, struct err *e)
{
    struct stat s;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &s) == 0 && S_ISDIR(s.st_mode))) return true;
    const char *why = errno == EEXIST ? "a file has that name" : strerror(errno);
    if (errno == ENOENT) {
        char parent[4096];
        const char *slash = strrchr(path, '/');
        snprintf(parent, sizeof parent, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
        why = stat(parent, &s) == 0 ? "no folder can be made there: choose another place with -o"
                                    : "its parent is not there";
        errno = ENOENT;
    }
    return err_set(e, err_system(ERR_CREATE), "the folder %s cannot be created: %s", path, why);
}

bool folder_make_for(const char *folder, const char *name, struct err *e)
{
    char path[4096];
    for (const char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        if (snprintf(path, sizeof path, "%s/%.*s", folder, (int)(slash - name), name) >= (int)sizeof path)
            return err_set(e, ERR_CREATE, "%s/%s: the path is too long", folder, name);
        if (!make_one(path, e)) return false;
    }
    return true;
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

/* ------------------------------------------------------------------ the owner */

enum { MOST = 8192 /* bytes of the file */, LINES = 5 };

static const char format[] = "rasp set 2", piped[] = "-";

struct owner {
    char text[MOST + 1];
    const char *lines[LINES]; /* format, hash, place, program, who is at work; NULL: not there */
};

const char *folder_place(const char *design, const char *folder, struct arena *a)
{
    if (!bytes_piped(design)) return text_shown(a, relpath_make(design, folder, a));
    char *real = memory_realpath(folder);
    const char *place = arena_format(a, "%s %s", piped, text_shown(a, real ? real : folder));
    free(real);
    return place;
}

static const char *place_of(const struct folder_owner *o, struct arena *a)
{
    return bytes_piped(o->design) ? piped : folder_place(o->design, o->folder, a);
}

/* Of a file that is no owner's, or not whole, there are no lines. */
static void read_owner(int fd, struct owner *was)
{
    ssize_t n = fd < 0 ? 0 : pread(fd, was->text, MOST, 0);
    char *at = was->text;
    was->text[n > 0 ? n : 0] = '\0';
    for (int i = 0; i < LINES; i++) {
        char *end = strchr(at, '\n');
        was->lines[i] = end ? at : NULL;
        if (end) *end = '\0';
        at = end ? end + 1 : at + strlen(at);
    }
    if (!was->lines[3] || strcmp(was->lines[0], format) != 0) memset(was->lines, 0, sizeof was->lines);
}

static void look(const char *folder, struct arena *a, struct owner *was)
{
    int fd = open(arena_format(a, "%s/.rasp/owner", folder), O_RDONLY | O_CLOEXEC);
    read_owner(fd, was);
    if (fd >= 0) close(fd);
}

bool folder_is_recorded(const char *folder, struct arena *a)
{
    struct owner was;
    look(folder, a, &was);
    return was.lines[0];
}

/* Of another design? */
static bool is_free(const struct folder_owner *o, const struct owner *was, struct arena *a, struct err *e)
{
    const char *place = place_of(o, a), *other = was->lines[2];
    if (o->replace || !other || !strcmp(was->lines[1], o->sha256) ||
        (strcmp(place, piped) != 0 && !strcmp(other, place)))
        return true;
    const char *seen = !strcmp(other, piped) ? "one that came through a pipe"
                       : other[0] == '/'     ? other
                                             : relpath_make(arena_format(a, "%s/%s", o->folder, other), NULL, a);
    return err_set(e, ERR_CREATE,
                   "%s: holds the set of another design, %s: choose another folder with -o, or say --replace, and the "
                   "folder is this design's from now on",
                   o->folder, seen);
}

bool folder_look(const struct folder_owner *o, struct arena *a, struct err *e)
{
    struct owner was;
    look(o->folder, a, &was);
    return is_free(o, &was, a, e);
}

static bool is_busy(const struct folder_owner *o, const struct owner *was, struct err *e)
{
    return err_set(e, ERR_INTERRUPTED,
                   "%s: another rasp is at work in it%s%s: wait until it has ended, or choose another folder with -o; "
                   "several runs of one set are its shards (--shard)",
                   o->folder, was->lines[4] ? ", " : "", was->lines[4] ? was->lines[4] : "");
}

/* Takes the lock of who works, while nobody else can enter. */
static bool enter(const struct folder_owner *o, int fd, struct arena *a, struct err *e)
{
    struct owner was;
    read_owner(fd, &was);
    if (!is_free(o, &was, a, e)) return false;
    bool alone = flock(fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; /* else there are no locks */
    bool same = was.lines[0] && !strcmp(was.lines[1], o->sha256) && !strcmp(was.lines[3], o->program);
    if (!alone && !(o->part && same && flock(fd, LOCK_SH | LOCK_NB) == 0)) return is_busy(o, &was, e);
    if (!alone) return true;
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    const char *text = arena_format(a, "%s\n%s\n%s\n%s\n%s, process %ld\n", format, o->sha256, place_of(o, a),
                                    o->program, text_shown(a, host), (long)getpid());
    size_t n = strlen(text);
    if (n > MOST) return err_set(e, ERR_CREATE, "%s: the path is too long", o->design);
    errno = ENOSPC; /* where less is written than was asked for */
    if (pwrite(fd, text, n, 0) != (ssize_t)n || ftruncate(fd, (off_t)n) != 0)
        return err_set(e, err_system(ERR_CREATE), "%s/.rasp/owner: cannot be written: %s", o->folder, strerror(errno));
    if (o->part) flock(fd, LOCK_SH);
    return true;
}

/* One at a time comes in; who holds the door longer than a moment was stopped there. */
static bool open_door(const struct folder_owner *o, int door, struct arena *a, struct err *e)
{
    struct owner was;
    for (int tries = 0; door >= 0 && flock(door, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; tries++) {
        if (tries == 200) {
            look(o->folder, a, &was);
            return is_busy(o, &was, e);
        }
        usleep(10000);
    }
    return true;
}

bool folder_enter(const struct folder_owner *o, struct arena *a, int *lock, struct err *e)
{
    const char *hidden = arena_format(a, "%s/.rasp", o->folder), *path = arena_format(a, "%s/owner", hidden);
    *lock = -1;
    if (!make_one(o->folder, e) || !make_one(hidden, e)) return false;
    int door = open(hidden, O_RDONLY | O_DIRECTORY | O_CLOEXEC), fd = -1;
    bool ok = open_door(o, door, a, e);
    if (ok && (fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666)) < 0)
        ok = err_set(e, err_system(ERR_CREATE), "%s: cannot be written: %s", path, strerror(errno));
    ok = ok && enter(o, fd, a, e);
    if (door >= 0) close(door);
    if (ok)
        *lock = fd;
    else if (fd >= 0)
        close(fd);
    return ok;
}

/* Takes away who is at work. */
void folder_leave(int lock)
{
    struct owner was;
    if (lock < 0) return;
    read_owner(lock, &was);
    if (was.lines[4] && ftruncate(lock, was.lines[4] - was.text) != 0)
        was.lines[4] = NULL; /* the next one says otherwise */
    close(lock);
}

/* ------------------------------------------------------------------ inputs */

struct input {
    const char *file, *what; /* file NULL: a free place */
    dev_t device;
    ino_t inode;
};

struct folder_inputs {
    struct arena *arena;
    struct input *table; /* [room], a power of two, with open addressing */
    size_t room, n;
};

/* Where the file is in the table, or would be. */
static struct input *find(const struct folder_inputs *all, dev_t device, ino_t inode)
{
    size_t at = (size_t)(((unsigned long long)inode * 0x9e3779b97f4a7c15ull + (unsigned long long)device) >> 17);
    for (;; at++) {
        struct input *in = &all->table[at & (all->room - 1)];
        if (!in->file || (in->inode == inode && in->device == device)) return in;
    }
}

struct folder_inputs *folder_inputs(struct arena *a)
{
    struct folder_inputs *all = ARENA_TAKE(a, struct folder_inputs, 1);
    *all = (struct folder_inputs){a, ARENA_TAKE(a, struct input, 64), 64, 0};
    return all;
}

void folder_inputs_add(struct folder_inputs *all, const char *file, const char *what, dev_t device, ino_t inode)
{
    struct input *in = find(all, device, inode);
    if (in->file) return;
    *in = (struct input){arena_text(all->arena, file), what, device, inode};
    if (2 * ++all->n <= all->room) return;
    const struct folder_inputs old = *all;
    all->table = ARENA_TAKE(all->arena, struct input, all->room *= 2);
    for (size_t i = 0; i < old.room; i++)
        if (old.table[i].file) *find(all, old.table[i].device, old.table[i].inode) = old.table[i];
}

void folder_inputs_add_file(struct folder_inputs *all, const char *file, const char *what)
{
    struct stat s;
    if (stat(file, &s) == 0) folder_inputs_add(all, file, what, s.st_dev, s.st_ino);
}

static const struct input *input_at(const struct folder_inputs *all, const char *path)
{
    struct stat s;
    const struct input *in = stat(path, &s) == 0 ? find(all, s.st_dev, s.st_ino) : NULL;
    return in && in->file ? in : NULL;
}

bool folder_inputs_has(const struct folder_inputs *all, const char *path) { return input_at(all, path); }

bool folder_spares(const struct folder_inputs *all, const struct folder_output *o, struct arena *a, struct err *e)
{
    const struct input *in = input_at(all, o->path);
    struct err link = {0};
    struct stat s;
    if (in)
        return err_set(e, ERR_CREATE,
                       "%s: the output %s would overwrite the input %s (%s): write into another folder with -o, or "
                       "change the name; nothing was written",
                       o->whose, o->path, in->file, in->what);
    /* Another shard may have begun meanwhile: it says whose the folder is before it writes anything else. */
    if (o->unknown && lstat(o->path, &s) == 0 && !folder_is_recorded(o->folder, a))
        return err_set(e, ERR_CREATE,
                       "%s: is there already, and nothing says of which design: choose another folder with -o, or say "
                       "--replace, and the folder is this design's from now on; nothing was "
                       "written",
                       o->path);
    return mark_links(o->path, o->links, &link) || err_set(e, link.kind, "%s; nothing was written", link.text);
}

bool folder_spares_hidden(const struct folder_inputs *all, const char *folder, const char *design, struct err *e)
{
    struct arena *a = arena_open();
    char *hidden = memory_realpath(arena_format(a, "%s/.rasp", folder));
    bool ok = true;
    for (size_t k = 0; hidden && ok && k < all->room; k++) {
        const struct input *in = &all->table[k];
        char *real = in->file ? memory_realpath(in->file) : NULL;
        if (real && strncmp(real, hidden, strlen(hidden)) == 0 && real[strlen(hidden)] == '/')
            ok = err_set(e, ERR_CREATE,
                         "%s: the input %s (%s) is in the folder %s/.rasp, whose files come and go with the set: copy "
                         "it elsewhere; nothing was written",
                         design, in->file, in->what, folder);
        free(real);
    }
    free(hidden);
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ what a killed program left */

/* "(rasp) S": what the system calls a process, and its state; "" if there is none. */
static void process_named(const char *pid, char text[64])
{
    char path[64], line[256] = "";
    snprintf(path, sizeof path, "/proc/%s/stat", pid);
    FILE *f = fopen(path, "r");
    if (f && !fgets(line, sizeof line, f)) line[0] = '\0';
    if (f) fclose(f);
    const char *from = strchr(line, '('), *to = strrchr(line, ')');
    snprintf(text, 64, "%.*s", from && to > from ? (int)(to - from) + 3 : 0, from ? from : "");
}

/* ".rasp-1234-0.part" of a process that is not there: it was about to be renamed. */
static bool is_left(const char *name)
{
    const char *dash = !strncmp(name, ".rasp-", 6) ? strchr(name + 6, '-') : NULL;
    size_t n = strlen(name), digits = dash ? (size_t)(dash - name) - 6 : 0;
    char text[16] = "", other[64], self[64];
    int pid;
    if (!dash || n < 6 || strcmp(name + n - 5, ".part") != 0 || digits >= sizeof text) return false;
    memcpy(text, name + 6, digits);
    if (!text_int(text, 1, 2147483647, &pid)) return false;
    /* Does a program like this one run under that number? One that was killed may still be there, as a zombie; and its
       number may have gone to another. */
    process_named("self", self);
    process_named(text, other);
    size_t size = strlen(self);
    if (!size) return kill(pid, 0) != 0 && errno == ESRCH; /* no /proc */
    return strlen(other) != size || strncmp(self, other, size - 1) != 0 || strchr("ZX", other[size - 1]);
}

/* ------------------------------------------------------------------ stale files */

struct walk {
    const struct folder_wanted *wanted;
    struct arena *arena;
    struct folder_stale *to;
};

static int by_text(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

/* -1: it is none of the set's. */
static int stimulus_named(const struct folder_wanted *w, const char *name)
{
    const char **found = w->n ? bsearch(&name, w->names, (size_t)w->n, sizeof *w->names, by_text) : NULL;
    return found ? (int)(found - w->names) : -1;
}

/* A stimulus of the set may have a file that was another's before: "a.b.wav" of a.b. */
static bool is_of_another(const struct walk *x, const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    bool is = false;
    for (const char *dot = strchr(slash ? slash : path, '.'); dot && !is; dot = strchr(dot + 1, '.')) {
        const char *stem = arena_format(x->arena, "%.*s", (int)(dot - path), path);
        is = strcmp(stem, name) != 0 && stimulus_named(x->wanted, stem) >= 0;
    }
    return is;
}

/* All files of a stimulus go, or none: what somebody changed keeps what it belongs to. */
static void take_stale(struct walk *x, const char *name, const struct record *r)
{
    const struct folder_wanted *w = x->wanted;
    const char **files = ARENA_TAKE(x->arena, const char *, r->n_files + 1);
    int n = 0;
    bool changed = false;
    for (int i = 0; i < r->n_files; i++) {
        struct stat s;
        char hex[HASH_TEXT];
        const char *file = r->files[i].path, *path = arena_format(x->arena, "%s/%s", w->folder, file);
        bool again = false, same = false;
        for (int k = 0; k < n; k++)
            again = again || !strcmp(files[k], file);
        if (again || r->files[i].raw || lstat(path, &s) != 0 || !S_ISREG(s.st_mode) ||
            folder_inputs_has(w->inputs, path) || is_of_another(x, file, name))
            continue;
        files[n++] = file;
        bool readable = hash_file(path, hex, &(struct err){0});
        for (int k = 0; readable && k < r->n_files; k++) /* one that was about to be replaced is listed twice */
            same = same || (!strcmp(r->files[k].path, file) && !strcmp(r->files[k].sha256, hex));
        changed = changed || !same;
    }
    files[n++] = arena_format(x->arena, "%s.json", name);
    for (int i = 0; i < n; i++) {
        const char *slash = strrchr(files[i], '/');
        if (!w->prune || changed) {
            x->to->files = arena_more(x->arena, x->to->files, x->to->n_files, sizeof *x->to->files);
            x->to->files[x->to->n_files++] = files[i];
        } else if (unlink(arena_format(x->arena, "%s/%s", w->folder, files[i])) == 0) {
            x->to->removed++;
            while (slash && rmdir(arena_format(x->arena, "%s/%.*s", w->folder, (int)(slash - files[i]), files[i])) ==
                                0) /* if nothing is in it */
                slash = memrchr(files[i], '/', (size_t)(slash - files[i]));
        }
    }
}

static bool is_folder(const char *path, const struct dirent *entry)
{
    struct stat s;
    return entry->d_type == DT_DIR || (entry->d_type == DT_UNKNOWN && lstat(path, &s) == 0 && S_ISDIR(s.st_mode));
}

/* below: seen from the folder, with a slash at its end, or "". */
static void walk(struct walk *x, const char *below)
{
    DIR *d = opendir(arena_format(x->arena, "%s/%s", x->wanted->folder, below));
    for (const struct dirent *entry; d && (entry = readdir(d));) {
        const char *name = entry->d_name, *path = arena_format(x->arena, "%s%s", below, name),
                   *whole = arena_format(x->arena, "%s/%s", x->wanted->folder, path);
        if (is_left(name))
            unlink(whole);
        else if (!is_folder(whole, entry) && text_ends(name, ".json")) {
            const char *stimulus = arena_format(x->arena, "%.*s", (int)strlen(path) - 5, path);
            int i = stimulus_named(x->wanted, stimulus);
            const char *key = i >= 0 ? x->wanted->keys[i] : NULL; /* NULL of the set's: its record is right */
            struct record r;
            if ((i < 0 || key) && record_read(x->wanted->folder, stimulus, x->arena, &r) &&
                (i < 0 || (r.status == RECORD_DONE && strcmp(key, r.key) != 0)))
                take_stale(x, stimulus, &r);
        } else if (strcmp(name, ".") != 0 && strcmp(name, "..") != 0 && is_folder(whole, entry) &&
                   (!strcmp(name, ".rasp") || !folder_is_recorded(whole, x->arena)))
            walk(x, arena_format(x->arena, "%s/", path));
    }
    if (d) closedir(d);
}

static int remove_it(const char *path, const struct stat *s, int kind, struct FTW *where)
{
    (void)s, (void)kind, (void)where;
    remove(path);
    return 0;
}

void folder_stale(const struct folder_wanted *w, struct arena *a, struct folder_stale *s)
{
    *s = (struct folder_stale){.files = ARENA_TAKE(a, const char *, 1)};
    walk(&(struct walk){.wanted = w, .arena = a, .to = s}, "");
    if (s->n_files) qsort(s->files, (size_t)s->n_files, sizeof *s->files, by_text);
    if (w->all) nftw(arena_format(a, "%s/.rasp/raw", w->folder), remove_it, 16, FTW_DEPTH | FTW_PHYS);
}

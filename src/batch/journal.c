/* See journal.h. */
#include "batch/journal.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/outfile.h"

enum { HASH_KEPT = 32 /* characters of a hash that are looked for; the rest is compared in the record */ };

struct entry {
    char hash[HASH_KEPT];
    bool waits;
    struct journal_ref ref; /* in the order in which they were read */
};

struct journal {
    const char *folder, *path; /* path NULL: only read */
    int fd;
    struct outfile lines;   /* without a name, never committed */
    long end;               /* of the lines */
    pthread_mutex_t lock;   /* of lines and end */
    struct entry *entries;
    int n, room;
};

/* ------------------------------------------------------------------ lines */

static bool put_line(struct journal *j, const char *line, size_t n, struct journal_ref *ref, struct err *e)
{
    pthread_mutex_lock(&j->lock);
    errno = ENOSPC; /* where less is written than was asked for */
    ssize_t put = pwrite(j->lines.fd, line, n, j->end);
    *ref = (struct journal_ref){j->end, (int)n};
    j->end += put == (ssize_t)n ? put : 0;
    int why = errno;
    pthread_mutex_unlock(&j->lock);
    errno = why;
    return put == (ssize_t)n || err_set(e, err_system(ERR_IO), "%s/.rasp: cannot be written: %s", j->folder, put < 0 ? strerror(errno) : "the disk is full");
}

const struct record *journal_read(struct journal *j, struct journal_ref ref, struct arena *a, struct err *e)
{
    char *line = memory_take((size_t)ref.size + 1);
    struct record *r = ARENA_TAKE(a, struct record, 1);
    errno = 0;
    bool ok = pread(j->lines.fd, line, (size_t)ref.size, ref.at) == ref.size && record_read(line, (size_t)ref.size, a, r);
    if (!ok)
        err_set(e, err_system(ERR_IO), "%s/.rasp: what was noted of a stimulus cannot be read again: %s", j->folder, errno ? strerror(errno) : "it is not whole");
    free(line);
    return ok ? r : NULL;
}

/* ------------------------------------------------------------------ reading */

static void keep_hash(char to[HASH_KEPT], const char *hash)
{
    size_t n = strlen(hash);
    memset(to, 0, HASH_KEPT);
    memcpy(to, hash, n < HASH_KEPT ? n : HASH_KEPT);
}

static void enter(struct journal *j, const char *hash, bool waits, struct journal_ref ref)
{
    if (!hash)
        return;
    if (j->n == j->room) {
        j->room = 2 * j->room + 64;
        struct entry *more = realloc(j->entries, (size_t)j->room * sizeof *more);
        if (!more)
            memory_out("%d records of a journal", j->room);
        j->entries = more;
    }
    struct entry *to = &j->entries[j->n++];
    *to = (struct entry){.waits = waits, .ref = ref};
    keep_hash(to->hash, hash);
}

static bool read_line(struct journal *j, const char *line, size_t n, struct err *e)
{
    struct arena *a = arena_open();
    struct record r;
    struct journal_ref ref;
    bool ok = true;
    if (n > 0 && n < INT_MAX && record_read(line, n, a, &r) && (ok = put_line(j, line, n, &ref, e))) {
        enter(j, r.key, !r.job, ref);
        enter(j, r.job, !r.job, ref);
    }
    arena_close(a);
    return ok;
}

static bool read_lines(struct journal *j, const char *path, struct err *e)
{
    FILE *f = memory_fopen(path, "r");
    char *line = NULL;
    size_t room = 0;
    bool ok = true;
    for (ssize_t n; ok && f && (n = getline(&line, &room, f)) > 0;)
        ok = read_line(j, line, (size_t)n - (line[n - 1] == '\n'), e);
    free(line);
    if (f)
        fclose(f);
    return ok;
}

static int is_journal(const struct dirent *d)
{
    return !strncmp(d->d_name, "journal", 7);
}

/* The whole set's first, so that what shards did since counts more. One that cannot be read is as if it were not there. */
static bool read_all(struct journal *j, struct arena *a, struct err *e)
{
    struct dirent **found;
    const char *hidden = arena_format(a, "%s/.rasp", j->folder);
    int n = scandir(hidden, &found, is_journal, alphasort);
    bool ok = n >= 0 || errno != ENOMEM || err_set(e, ERR_MEMORY, "%s: out of memory", hidden);
    for (int i = 0; i < n; i++) {
        ok = ok && read_lines(j, arena_format(a, "%s/%s", hidden, found[i]->d_name), e);
        free(found[i]);
    }
    if (n >= 0)
        free(found);
    return ok;
}

static int by_hash(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    int hashes = memcmp(p->hash, q->hash, HASH_KEPT);
    return hashes ? hashes : (p->ref.at > q->ref.at) - (p->ref.at < q->ref.at);
}

struct journal *journal_open(const char *folder, const char *path, struct arena *a, struct err *e)
{
    struct journal *j = ARENA_TAKE(a, struct journal, 1);
    *j = (struct journal){.folder = folder, .path = path, .fd = -1};
    pthread_mutex_init(&j->lock, NULL);
    j->lines.fd = -1;
    bool ok = outfile_open_fd(&j->lines, arena_format(a, "%s/.rasp/records", folder), e) && read_all(j, a, e);
    if (j->n)
        qsort(j->entries, (size_t)j->n, sizeof *j->entries, by_hash);
    if (ok && path && (j->fd = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) < 0)
        ok = err_set(e, err_system(ERR_CREATE), "%s: cannot be written: %s", path, strerror(errno));
    if (ok)
        return j;
    journal_close(j);
    return NULL;
}

/* Where the entries with that hash begin. */
static int first_of(const struct journal *j, const char hash[HASH_KEPT])
{
    int low = 0, high = j->n;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (memcmp(j->entries[middle].hash, hash, HASH_KEPT) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static bool is_of(const struct record *r, const char *hash)
{
    return !strcmp(r->key, hash) || (r->job && !strcmp(r->job, hash));
}

const struct record *journal_find_such(struct journal *j, const struct journal_wish *wish, struct arena *a, struct journal_ref *ref)
{
    struct err unreadable = {0};
    char kept[HASH_KEPT];
    keep_hash(kept, wish->hash);
    int begin = first_of(j, kept), end = begin;
    while (end < j->n && !memcmp(j->entries[end].hash, kept, HASH_KEPT))
        end++;
    for (int i = end - 1; i >= begin; i--) {
        *ref = j->entries[i].ref;
        const struct record *found = j->entries[i].waits == wish->waits ? journal_read(j, *ref, a, &unreadable) : NULL;
        if (found && is_of(found, wish->hash) && wish->good(wish->context, found, a))
            return found;
    }
    *ref = (struct journal_ref){0};
    return NULL;
}

static bool any(const void *context, const struct record *r, struct arena *a)
{
    (void)context, (void)r, (void)a;
    return true;
}

const struct record *journal_find(struct journal *j, const char *hash, bool waits, struct arena *a, struct journal_ref *ref)
{
    return journal_find_such(j, &(struct journal_wish){hash, waits, any, NULL}, a, ref);
}

bool journal_each(struct journal *j, void (*take)(void *context, const struct record *r, struct journal_ref ref), void *context, struct err *e)
{
    for (int i = 0; i < j->n; i++) {
        if (i && j->entries[i].ref.at == j->entries[i - 1].ref.at)
            continue; /* by its other hash, which is the same one */
        struct arena *a = arena_open();
        const struct record *r = journal_read(j, j->entries[i].ref, a, e);
        if (r)
            take(context, r, j->entries[i].ref);
        arena_close(a);
        if (!r)
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ writing */

bool journal_add(struct journal *j, const struct record *r, struct journal_ref *ref, struct err *e)
{
    char *text = record_text(r, true);
    size_t n = text ? strlen(text) : 0;
    char *line = memory_take(n + 2);
    ssize_t put = -1;
    if (!text)
        memory_out("a record");
    line[0] = '\n';
    memcpy(line + 1, text, n);
    line[n + 1] = '\n';
    errno = ENOSPC;
    put = write(j->fd, line, n + 2);
    if (put != (ssize_t)(n + 2))
        err_set(e, err_system(ERR_IO), "%s: cannot be written: %s", j->path, put < 0 ? strerror(errno) : "the disk is full");
    bool ok = !e->kind && put_line(j, text, n, ref, e);
    free(line);
    free(text);
    return ok;
}

void journal_close(struct journal *j)
{
    if (!j)
        return;
    if (j->fd >= 0)
        close(j->fd);
    outfile_drop(&j->lines);
    pthread_mutex_destroy(&j->lock);
    free(j->entries);
}

static bool settle_one(struct journal *j, struct journal_ref ref, FILE *to, struct err *e)
{
    struct arena *a = arena_open();
    const struct record *r = journal_read(j, ref, a, e);
    char *text = r ? record_text(r, false) : NULL;
    if (r && !text)
        memory_out("a record");
    if (text)
        fprintf(to, "%s\n", text);
    free(text);
    arena_close(a);
    return r != NULL;
}

static bool write_settled(struct journal *j, const char *path, const struct journal_ref *refs, int n, struct err *e)
{
    struct outfile f;
    bool ok = outfile_open(&f, path, e);
    if (!ok)
        return false;
    for (int i = 0; ok && i < n; i++)
        ok = !refs[i].size || settle_one(j, refs[i], f.stream, e);
    if (ok)
        return outfile_commit(&f, e);
    outfile_drop(&f);
    return false;
}

bool journal_settle(struct journal *j, const struct journal_ref *refs, int n, struct err *e)
{
    struct arena *a = arena_open();
    struct dirent **found;
    const char *hidden = arena_format(a, "%s/.rasp", j->folder);
    bool ok = write_settled(j, arena_format(a, "%s/journal", hidden), refs, n, e);
    int others = ok ? scandir(hidden, &found, is_journal, alphasort) : -1;
    for (int i = 0; i < others; i++) {
        if (strcmp(found[i]->d_name, "journal") != 0)
            unlink(arena_format(a, "%s/%s", hidden, found[i]->d_name));
        free(found[i]);
    }
    if (others >= 0)
        free(found);
    arena_close(a);
    return ok;
}

/* See leftover.h. What a folder held is in its journal: records of stimuli that are not in the set, or are not any more what they were, stay there as long as one of their files does. */
#include "batch/leftover.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"

struct found {                   /* a file of a record                              */
    const char *path, *sha256;   /* NULL: of a summary, which differs from run to run */
    int record;                  /* in list.records                                 */
    long at;                     /* of that record                                  */
    bool ours, there;            /* ours: a stimulus of the set has a file so named */
};

struct list {
    const struct leftover_ask *ask;
    struct arena *arena;
    struct row {
        const char *name;
        long at;                 /* of its record; -1: it failed, or waits */
        const char *refused;     /* key of what is to be made anew: its records are forgotten, though their files are there; NULL: none */
    } *rows;                     /* of the set, by name */
    struct old {
        struct journal_ref ref;
        bool touched;            /* some file is not as it was written */
    } *records;
    int n, room;
    struct found *files;
    int n_files, files_room;
};

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct row *)a)->name, ((const struct row *)b)->name);
}

static int by_path(const void *a, const void *b)
{
    return strcmp(((const struct found *)a)->path, ((const struct found *)b)->path);
}

/* Of one file the latest record first. */
static int by_path_and_time(const void *a, const void *b)
{
    const struct found *p = a, *q = b;
    int paths = by_path(a, b);
    return paths ? paths : (p->at < q->at) - (p->at > q->at);
}

/* ------------------------------------------------------------------ records */

static void take_record(void *context, const struct record *r, struct journal_ref ref)
{
    struct list *l = context;
    const struct row *row = bsearch(&(struct row){.name = r->name}, l->rows, (size_t)l->ask->all->set->n, sizeof *row, by_name);
    if (!r->job || (row && (row->at == ref.at || (row->refused && !strcmp(row->refused, r->key)))))
        return;
    if (l->n == l->room) {
        struct old *more = ARENA_TAKE(l->arena, struct old, l->room = 2 * l->room + 16);
        if (l->n)
            memcpy(more, l->records, (size_t)l->n * sizeof *more);
        l->records = more;
    }
    l->records[l->n++] = (struct old){ref, false};
}

static bool read_refused(struct list *l, int i, struct err *e)
{
    struct arena *a = arena_open();
    const struct record *r = journal_read(l->ask->all->journal, l->ask->all->of[i].refused, a, e);
    l->rows[i].refused = r ? arena_text(l->arena, r->key) : NULL;
    arena_close(a);
    return r != NULL;
}

static bool read_records(struct list *l, struct err *e)
{
    const struct results *all = l->ask->all;
    l->rows = ARENA_TAKE(l->arena, struct row, all->set->n);
    for (int i = 0; i < all->set->n; i++) {
        const struct outcome *o = &all->of[i];
        l->rows[i] = (struct row){all->set->rows[i].name, o->record.size && !o->waits ? o->record.at : -1, NULL};
        if (o->refused.size && !read_refused(l, i, e))
            return false;
    }
    qsort(l->rows, (size_t)all->set->n, sizeof *l->rows, by_name);
    return journal_each(all->journal, take_record, l, e);
}

/* ------------------------------------------------------------------ files */

/* A journal that somebody wrote leads nowhere else. */
static bool is_within(const char *path)
{
    return *path && *path != '/' && strncmp(path, "../", 3) != 0 && !strstr(path, "/../") && strncmp(path, ".rasp/", 6) != 0;
}

static bool read_one(struct list *l, int i, struct err *e)
{
    struct arena *a = arena_open();
    const struct record *r = journal_read(l->ask->all->journal, l->records[i].ref, a, e);
    int n = r ? r->n_files : 0;
    if (l->n_files + n > l->files_room) {
        struct found *more = ARENA_TAKE(l->arena, struct found, l->files_room = 2 * l->files_room + n);
        if (l->n_files)
            memcpy(more, l->files, (size_t)l->n_files * sizeof *more);
        l->files = more;
    }
    for (int k = 0; k < n; k++) {
        const struct record_file *f = &r->files[k];
        if (is_within(f->path))
            l->files[l->n_files++] = (struct found){arena_text(l->arena, f->path), f->sha256 ? arena_text(l->arena, f->sha256) : NULL, i, l->records[i].ref.at, false, false};
    }
    arena_close(a);
    return r != NULL;
}

/* Each once, of its latest record. */
static bool read_files(struct list *l, struct err *e)
{
    for (int i = 0; i < l->n; i++)
        if (!read_one(l, i, e))
            return false;
    if (l->n_files)
        qsort(l->files, (size_t)l->n_files, sizeof *l->files, by_path_and_time);
    int n = 0;
    for (int i = 0; i < l->n_files; i++)
        if (!n || by_path(&l->files[i], &l->files[n - 1]) != 0)
            l->files[n++] = l->files[i];
    l->n_files = n;
    return true;
}

/* A record of the set has a file of that name: it is not left over. */
static bool spare_one(struct list *l, int i, struct err *e)
{
    const struct results *all = l->ask->all;
    struct arena *a = arena_open();
    const struct record *r = all->of[i].record.size ? journal_read(all->journal, all->of[i].record, a, e) : NULL;
    bool ok = r || !all->of[i].record.size;
    for (int k = 0; r && k < r->n_files; k++) {
        struct found *f = bsearch(&(struct found){.path = r->files[k].path}, l->files, (size_t)l->n_files, sizeof *f, by_path);
        if (f)
            f->ours = true;
    }
    arena_close(a);
    return ok;
}

static bool spare_ours(struct list *l, struct err *e)
{
    bool ok = true;
    for (int i = 0; ok && i < l->ask->all->set->n; i++)
        ok = spare_one(l, i, e);
    return ok;
}

static bool is_left(const struct list *l, const char *path)
{
    struct stat s;
    return lstat(path, &s) == 0 && S_ISREG(s.st_mode) && (!l->ask->inputs || !spare_reads(l->ask->inputs, path));
}

static void look(struct list *l)
{
    for (int i = 0; i < l->n_files; i++) {
        struct found *f = &l->files[i];
        char hex[HASH_TEXT];
        struct err unreadable = {0};
        struct arena *a = arena_open();
        const char *path = arena_format(a, "%s/%s", l->ask->folder, f->path);
        f->there = !f->ours && is_left(l, path);
        if (f->there && f->sha256 && (!hash_file(path, hex, &unreadable) || strcmp(hex, f->sha256) != 0))
            l->records[f->record].touched = true;
        arena_close(a);
    }
}

/* All files of a stimulus, or none: what somebody changed keeps what it belongs to. */
static int remove_files(struct list *l)
{
    int n = 0;
    struct arena *a = arena_open();
    for (int i = 0; i < l->n_files; i++) {
        struct found *f = &l->files[i];
        const char *path = arena_format(a, "%s/%s", l->ask->folder, f->path), *slash = strrchr(f->path, '/');
        if (!f->there || l->records[f->record].touched || unlink(path) != 0)
            continue;
        f->there = false;
        n++;
        while (slash && rmdir(arena_format(a, "%s/%.*s", l->ask->folder, (int)(slash - f->path), f->path)) == 0) /* if nothing is in it */
            slash = memrchr(f->path, '/', (size_t)(slash - f->path));
    }
    arena_close(a);
    return n;
}

static int by_age(const void *a, const void *b)
{
    const struct journal_ref *p = a, *q = b;
    return (p->at > q->at) - (p->at < q->at);
}

static void gather(const struct list *l, struct leftover *to)
{
    bool *kept = ARENA_TAKE(l->arena, bool, l->n);
    int n = 0;
    to->files = ARENA_TAKE(l->arena, const char *, l->n_files + 1);
    to->refs = ARENA_TAKE(l->arena, struct journal_ref, l->n);
    for (int i = 0; i < l->n_files; i++)
        if (l->files[i].there) {
            to->files[to->n_files++] = l->files[i].path;
            kept[l->files[i].record] = true;
        }
    for (int i = 0; i < l->n; i++)
        if (kept[i])
            to->refs[to->n++] = l->records[i].ref;
    qsort(to->refs, (size_t)to->n, sizeof *to->refs, by_age);
    for (int i = 0; i < to->n; i++) /* a record is known by two hashes, and may come twice */
        if (!n || to->refs[n - 1].at != to->refs[i].at)
            to->refs[n++] = to->refs[i];
    to->n = n;
}

bool leftover_find(const struct leftover_ask *ask, struct arena *a, struct leftover *to, struct err *e)
{
    struct list l = {.ask = ask, .arena = a};
    *to = (struct leftover){.files = ARENA_TAKE(a, const char *, 1)};
    if (!read_records(&l, e) || !l.n)
        return e->kind == ERR_NONE;
    if (!read_files(&l, e) || (l.n_files && !spare_ours(&l, e)))
        return false;
    look(&l);
    to->removed = ask->remove ? remove_files(&l) : 0;
    gather(&l, to);
    return true;
}

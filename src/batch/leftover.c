/* See leftover.h. What a folder held is in its journal: records of stimuli that are not in the set stay there as long as one of their files does. */
#include "batch/leftover.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"

struct found {                   /* a file of a record                              */
    const char *path, *sha256;   /* NULL: of a summary, which differs from run to run */
    int record;                  /* in list.records                                 */
    bool ours, there;            /* ours: a stimulus of the set has a file so named */
};

struct list {
    const struct leftover_ask *ask;
    struct arena *arena;
    const char **names;          /* of the set, sorted */
    int n_names;
    struct old {
        const char *name;
        struct journal_ref ref;
        bool touched;            /* some file is not as it was written */
    } *records;
    int n, room;
    struct found *files;
    int n_files, files_room;
};

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static int by_record(const void *a, const void *b)
{
    const struct old *p = a, *q = b;
    int names = strcmp(p->name, q->name);
    return names ? names : (p->ref.at > q->ref.at) - (p->ref.at < q->ref.at);
}

static int by_path(const void *a, const void *b)
{
    return strcmp(((const struct found *)a)->path, ((const struct found *)b)->path);
}

/* ------------------------------------------------------------------ records */

static void take_record(void *context, const struct record *r, struct journal_ref ref)
{
    struct list *l = context;
    if (!r->job || bsearch(&r->name, l->names, (size_t)l->n_names, sizeof *l->names, by_text))
        return;
    if (l->n == l->room) {
        struct old *more = ARENA_TAKE(l->arena, struct old, l->room = 2 * l->room + 16);
        if (l->n)
            memcpy(more, l->records, (size_t)l->n * sizeof *more);
        l->records = more;
    }
    l->records[l->n++] = (struct old){arena_text(l->arena, r->name), ref, false};
}

/* Of each name the latest. */
static bool read_records(struct list *l, struct err *e)
{
    const struct set *s = l->ask->all->set;
    l->names = ARENA_TAKE(l->arena, const char *, s->n);
    l->n_names = s->n;
    for (int i = 0; i < s->n; i++)
        l->names[i] = s->rows[i].name;
    qsort(l->names, (size_t)s->n, sizeof *l->names, by_text);
    if (!journal_each(l->ask->all->journal, take_record, l, e))
        return false;
    int kept = 0;
    if (l->n)
        qsort(l->records, (size_t)l->n, sizeof *l->records, by_record);
    for (int i = 0; i < l->n; i++)
        if (i + 1 == l->n || strcmp(l->records[i].name, l->records[i + 1].name) != 0)
            l->records[kept++] = l->records[i];
    l->n = kept;
    return true;
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
            l->files[l->n_files++] = (struct found){arena_text(l->arena, f->path), f->sha256 ? arena_text(l->arena, f->sha256) : NULL, i, false, false};
    }
    arena_close(a);
    return r != NULL;
}

static bool read_files(struct list *l, struct err *e)
{
    for (int i = 0; i < l->n; i++)
        if (!read_one(l, i, e))
            return false;
    if (l->n_files)
        qsort(l->files, (size_t)l->n_files, sizeof *l->files, by_path);
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
        bool twice = i && !by_path(f, f - 1);
        char hex[HASH_TEXT];
        struct err unreadable = {0};
        struct arena *a = arena_open();
        const char *path = arena_format(a, "%s/%s", l->ask->folder, f->path);
        f->there = !twice && !f->ours && is_left(l, path);
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
        if (slash)
            rmdir(arena_format(a, "%s/%.*s", l->ask->folder, (int)(slash - f->path), f->path)); /* if nothing is in it */
    }
    arena_close(a);
    return n;
}

static void gather(const struct list *l, struct leftover *to)
{
    bool *kept = ARENA_TAKE(l->arena, bool, l->n);
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

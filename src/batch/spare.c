/* See spare.h. As in pipeline/outputs.c two files are one if they have the same device and inode, so that links count, and an output that is not there yet is none of
   the inputs: all of those are there. The inputs are kept in a table with open addressing, so that a set of many stimuli costs little more than a look at each file. */
#include "batch/spare.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "batch/claim.h"
#include "batch/manifest.h"
#include "output/mark.h"
#include "pipeline/outputs.h"

struct file_read {
    const char *file, *what; /* file NULL: a free place */
    dev_t device;
    ino_t inode;
};

struct endings {
    const char **of;
    int n;
};

struct spare {
    const struct design *design;
    struct arena *arena;
    struct file_read *table;     /* [room], a power of two */
    size_t room, n;
    struct endings *writes;  /* [n] of the stimuli that were noted; most share theirs */
    struct endings last;
};

/* ------------------------------------------------------------------ the table */

/* Where the file is in the table, or would be. */
static struct file_read *find(const struct spare *s, dev_t device, ino_t inode)
{
    size_t at = (size_t)(((unsigned long long)inode * 0x9e3779b97f4a7c15ull + (unsigned long long)device) >> 17);
    for (;; at++) {
        struct file_read *in = &s->table[at & (s->room - 1)];
        if (!in->file || (in->inode == inode && in->device == device))
            return in;
    }
}

static void grow(struct spare *s)
{
    const struct spare old = *s;
    s->room *= 2;
    s->table = ARENA_TAKE(s->arena, struct file_read, s->room);
    for (size_t i = 0; i < old.room; i++)
        if (old.table[i].file)
            *find(s, old.table[i].device, old.table[i].inode) = old.table[i];
}

static void add(struct spare *s, const char *file, const char *what, dev_t device, ino_t inode)
{
    struct file_read *in = find(s, device, inode);
    if (in->file)
        return;
    *in = (struct file_read){arena_text(s->arena, file), what, device, inode};
    if (2 * ++s->n > s->room)
        grow(s);
}

static void add_file(struct spare *s, const char *file, const char *what)
{
    struct stat status;
    if (stat(file, &status) == 0)
        add(s, file, what, status.st_dev, status.st_ino);
}

/* ------------------------------------------------------------------ noting */

struct spare *spare_open(const struct design *d, struct arena *a)
{
    struct spare *s = ARENA_TAKE(a, struct spare, 1);
    *s = (struct spare){.design = d, .arena = a, .room = 64};
    s->table = ARENA_TAKE(a, struct file_read, s->room);
    s->writes = ARENA_TAKE(a, struct endings, d->n_stimuli);
    for (int i = 0; d->sources[i]; i++)
        add_file(s, d->sources[i], "the design");
    return s;
}

static bool as_last(const struct spare *s, const struct outputs *o)
{
    bool same = s->last.n == o->n;
    for (int k = 0; same && k < o->n; k++)
        same = strcmp(s->last.of[k], o->paths[k]) == 0;
    return same;
}

void spare_scene(struct spare *s, int i, const struct scene *scene)
{
    int n;
    struct arena *a = arena_open();
    const struct outputs_source *reads = outputs_sources(scene, &n, a);
    const struct outputs o = outputs_make(scene, "", a);
    for (int k = 0; k < n; k++)
        add(s, reads[k].file, reads[k].what, reads[k].device, reads[k].inode);
    if (!as_last(s, &o)) {
        s->last = (struct endings){ARENA_TAKE(s->arena, const char *, o.n), o.n};
        for (int k = 0; k < o.n; k++)
            s->last.of[k] = arena_text(s->arena, o.paths[k]);
    }
    s->writes[i] = s->last;
    arena_close(a);
}

/* ------------------------------------------------------------------ checking */

static const struct file_read *reads(const struct spare *s, const char *path)
{
    struct stat status;
    const struct file_read *in = stat(path, &status) == 0 ? find(s, status.st_dev, status.st_ino) : NULL;
    return in && in->file ? in : NULL;
}

bool spare_reads(const struct spare *s, const char *path)
{
    return reads(s, path) != NULL;
}

/* Another shard may have begun meanwhile: it says whose the folder is before it writes anything else. */
static bool is_foreign(const struct spare_place *p, const char *path, struct arena *a)
{
    struct stat status;
    return p->unknown && lstat(path, &status) == 0 && !claim_is_noted(p->folder, a);
}

static bool spared(const struct spare *s, const struct spare_place *p, const char *whose, const char *path, struct err *e)
{
    const struct file_read *in = reads(s, path);
    if (!in && is_foreign(p, path, s->arena))
        return err_set(e, ERR_CREATE, "%s: is there already, and nothing says of which design: choose another folder with -o, or say --replace, and the folder is this design's from now on; nothing was "
                                      "written", path);
    struct err link = {0};
    if (!in && !mark_links(path, p->links, &link))
        return err_set(e, link.kind, "%s; nothing was written", link.text);
    return !in ||
           err_set(e, ERR_CREATE, "%s: the output %s would overwrite the input %s (%s): write into another folder with -o, or change the name; nothing was written", whose, path, in->file,
                   in->what);
}

static bool tables_spared(const struct spare *s, const struct spare_place *p, struct arena *a, struct err *e)
{
    static const char *const tables[] = {"manifest.csv", "manifest.json", "SHA256SUMS", "timings.csv"};
    for (int k = 0; k < 4; k++)
        if (!spared(s, p, s->design->file, arena_format(a, "%s/%s", p->folder, tables[k]), e))
            return false;
    return spared(s, p, s->design->file, manifest_path(p->folder, p->shard, a), e);
}

/* The end of a whole set takes shards' manifests away. */
static bool shards_spared(const struct spare *s, const struct spare_place *p, struct err *e)
{
    struct shard other;
    bool ok = true;
    DIR *d = p->unknown ? opendir(p->folder) : NULL;
    for (struct dirent *entry; d && ok && (entry = readdir(d));)
        if (shard_of_manifest(entry->d_name, &other))
            ok = spared(s, p, s->design->file, arena_format(s->arena, "%s/%s", p->folder, entry->d_name), e);
    if (d)
        closedir(d);
    return ok;
}

/* What lies in FOLDER/.rasp is the program's own, and is taken away. */
static bool hidden_spared(const struct spare *s, const char *folder, struct arena *a, struct err *e)
{
    char *hidden = memory_realpath(arena_format(a, "%s/.rasp", folder));
    bool ok = true;
    for (size_t k = 0; hidden && ok && k < s->room; k++) {
        char *real = s->table[k].file ? memory_realpath(s->table[k].file) : NULL;
        if (real && strncmp(real, hidden, strlen(hidden)) == 0 && real[strlen(hidden)] == '/')
            ok = err_set(e, ERR_CREATE, "%s: the input %s (%s) is in the folder %s/.rasp, whose files come and go with the set: copy it elsewhere; nothing was written", s->design->file, s->table[k].file,
                         s->table[k].what, folder);
        free(real);
    }
    free(hidden);
    return ok;
}

static bool all_spared(const struct spare *s, const struct set *set, const int *first, const struct spare_place *p, struct err *e)
{
    static const char *const wav[] = {".wav"};
    bool ok = true;
    for (int i = 0; ok && i < set->n; i++) {
        struct arena *a = arena_open();
        bool recording = s->design->stimuli[i].recording;
        const char *const *endings = recording ? wav : s->writes[first[i]].of;
        for (int k = 0; ok && k < (recording ? 1 : s->writes[first[i]].n); k++)
            ok = spared(s, p, set->rows[i].name, arena_format(a, "%s/%s%s", p->folder, set->rows[i].name, endings[k]), e);
        arena_close(a);
    }
    return ok;
}

bool spare_check(struct spare *s, const struct set *set, const int *first, const struct spare_place *p, struct err *e)
{
    struct stat status;
    if (stat(p->folder, &status) != 0)
        return true; /* an empty one cannot hold an input */
    for (int i = 0; i < set->n; i++)
        if (s->design->stimuli[i].recording)
            add_file(s, s->design->stimuli[i].recording, "a recording");
    return all_spared(s, set, first, p, e) && tables_spared(s, p, s->arena, e) && shards_spared(s, p, e) && hidden_spared(s, p->folder, s->arena, e);
}

/* See file_cache.h. One lock guards the tree; things are made outside of it, each in an arena of its own. */
#include "base/file_cache.h"

#include <pthread.h>
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"

static struct file_cache_state look(const char *file)
{
    struct stat s;
    if (stat(file, &s) != 0) return (struct file_cache_state){{0}};
    return (struct file_cache_state){{(long)s.st_dev, (long)s.st_ino, (long)s.st_size, s.st_mtim.tv_sec,
                                      s.st_mtim.tv_nsec, s.st_ctim.tv_sec, s.st_ctim.tv_nsec}};
}

static int compare(const struct file_cache_state *a, const struct file_cache_state *b)
{
    return memcmp(a, b, sizeof *a);
}

enum progress { MAKING, THERE, FAILED /* its making failed */ };

struct cached {
    const struct file_cache_kind *kind;
    const char *file, *key;
    struct file_cache_state state;
    struct arena *arena; /* that what its thing has besides lies in; NULL: it is small */
    void *thing;
    enum progress progress;
    struct cached *next; /* of all */
};

struct file_cache {
    pthread_mutex_t lock;
    pthread_cond_t made;
    struct arena *arena; /* of the entries */
    struct cached *entries;
    void *tree; /* of the same, of those that are alike the last */
    size_t bytes, most;
};

struct file_cache *file_cache_open(size_t most)
{
    struct file_cache *s = memory_take(sizeof *s);
    *s = (struct file_cache){.most = most, .arena = arena_open()};
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->made, NULL);
    return s;
}

static void leave(void *entry) { (void)entry; }

void file_cache_close(struct file_cache *s)
{
    if (!s) return;
    for (struct cached *x = s->entries; x; x = x->next)
        arena_close(x->arena);
    tdestroy(s->tree, leave);
    arena_close(s->arena);
    pthread_cond_destroy(&s->made);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

static int order(const void *p, const void *q)
{
    const struct cached *a = p, *b = q;
    int by = strcmp(a->file, b->file);
    by = by ? by : strcmp(a->kind->name, b->kind->name);
    by = by ? by : strcmp(a->key, b->key);
    return by ? by : compare(&a->state, &b->state);
}

static struct cached *enter(struct file_cache *s, const struct cached *wanted)
{
    struct cached *x = ARENA_TAKE(s->arena, struct cached, 1);
    *x = *wanted;
    x->file = arena_text(s->arena, wanted->file);
    x->key = arena_text(s->arena, wanted->key);
    x->thing = arena_take(s->arena, 1, wanted->kind->size);
    x->arena = wanted->kind->small ? NULL : arena_open();
    x->next = s->entries;
    s->entries = x;
    struct cached **at = tsearch(x, &s->tree, order);
    if (!at) memory_out("for a tree of files");
    *at = x; /* in place of one whose making failed */
    return x;
}

static const void *make(struct file_cache *s, struct cached *x, const void *how, struct err *e)
{
    struct err own = {0};
    bool ok = x->kind->make(x->file, how, x->arena, x->thing, &own);
    pthread_mutex_lock(&s->lock);
    x->progress = ok ? THERE : FAILED;
    s->bytes += x->arena ? arena_bytes(x->arena) : 0;
    pthread_cond_broadcast(&s->made);
    pthread_mutex_unlock(&s->lock);
    if (!ok && !e->kind) *e = own;
    return ok ? x->thing : NULL;
}

const void *file_cache_take(struct file_cache *s, const struct file_cache_ask *ask, struct arena *a, struct err *e)
{
    const struct cached wanted = {
        .kind = ask->kind, .file = ask->file, .key = ask->key ? ask->key : "", .state = look(ask->file)};
    struct cached *mine = NULL;
    if (s && (wanted.state.of[1] || !*ask->file)) {
        pthread_mutex_lock(&s->lock);
        struct cached *const *at = tfind(&wanted, &s->tree, order);
        const struct cached *found = at ? *at : NULL;
        while (found && found->progress == MAKING) /* by another */
            pthread_cond_wait(&s->made, &s->lock);
        found = found && found->progress == THERE ? found : NULL;
        if (!found && (s->bytes < s->most || ask->kind->small)) mine = enter(s, &wanted);
        pthread_mutex_unlock(&s->lock);
        if (found) return found->thing;
    }
    if (mine) return make(s, mine, ask->how, e);
    void *thing = arena_take(a, 1, ask->kind->size);
    return ask->kind->make(ask->file, ask->how, a, thing, e) ? thing : NULL;
}

const char *file_cache_changed(struct file_cache *s, struct arena *a)
{
    const char *file = NULL;
    pthread_mutex_lock(&s->lock);
    for (const struct cached *x = s->entries; x && !file; x = x->next) {
        const struct file_cache_state now = look(x->file);
        if (compare(&x->state, &now)) file = relpath_make(x->file, NULL, a);
    }
    pthread_mutex_unlock(&s->lock);
    return file;
}

static bool make_sha256(const char *file, const void *how, struct arena *a, void *thing, struct err *e)
{
    (void)a, (void)how;
    return hash_file(file, thing, e);
}

const char *file_cache_sha256(struct file_cache *s, const char *file, struct arena *a, struct err *e)
{
    static const struct file_cache_kind sha256 = {"sha256", HASH_TEXT, make_sha256, true};
    return file_cache_take(s, &(struct file_cache_ask){.kind = &sha256, .file = file}, a, e);
}

/* ------------------------------------------------------------------ watching */

struct watch file_cache_watch(const char **files, int n, struct arena *a)
{
    struct watch w = {files, ARENA_TAKE(a, struct file_cache_state, n), n};
    for (int i = 0; i < n; i++)
        w.was[i] = look(files[i]);
    return w;
}

const char *file_cache_watch_changed(const struct watch *w)
{
    for (int i = 0; i < w->n; i++) {
        const struct file_cache_state now = look(w->files[i]);
        if (compare(&now, &w->was[i])) return w->files[i];
    }
    return NULL;
}

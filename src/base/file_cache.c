/* See file_cache.h. One lock guards the list; things are made outside of it, each in an arena of its own. */
#include "base/file_cache.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "base/watch.h"

enum state { MAKING, THERE, FAILED /* its making failed */ };

struct entry {
    const struct file_cache_kind *kind;
    const char *file, *key;
    struct stat status;
    struct arena *arena; /* that what its thing has besides lies in; NULL: it is small */
    void *thing;
    enum state state;
    size_t hash;         /* of kind, file and key */
    struct entry *next;  /* of all */
    struct entry *other; /* of those that have their place in the table in common */
};

struct file_cache {
    pthread_mutex_t lock;
    pthread_cond_t made;
    struct arena *arena; /* of the entries */
    struct entry *entries, **table;
    size_t n, places; /* entries; of the table, a power of two */
    size_t bytes, most;
};

struct file_cache *file_cache_open(size_t most)
{
    struct file_cache *s = memory_take(sizeof *s);
    *s = (struct file_cache){.most = most, .arena = arena_open(), .places = 64};
    s->table = ARENA_TAKE(s->arena, struct entry *, s->places);
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->made, NULL);
    return s;
}

void file_cache_close(struct file_cache *s)
{
    if (!s) return;
    for (struct entry *x = s->entries; x; x = x->next)
        arena_close(x->arena);
    arena_close(s->arena);
    pthread_cond_destroy(&s->made);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

/* FNV-1a. */
static size_t add_text(size_t h, const char *text)
{
    for (; *text; text++)
        h = (h ^ (unsigned char)*text) * (size_t)0x100000001b3;
    return (h ^ 0xff) * (size_t)0x100000001b3;
}

static const char *key_of(const struct file_cache_ask *ask) { return ask->key ? ask->key : ""; }

static size_t hash_of(const struct file_cache_ask *ask)
{
    size_t h = add_text(add_text(add_text((size_t)0xcbf29ce484222325, ask->kind->name), ask->file), key_of(ask));
    return h ^ h >> 32;
}

/* Waits where another makes it. NULL: nobody has. */
static const struct entry *find(struct file_cache *s, const struct file_cache_ask *ask, const struct stat *status)
{
    size_t hash = hash_of(ask);
    for (struct entry *x = s->table[hash & (s->places - 1)]; x; x = x->other) {
        if (x->hash != hash || x->kind != ask->kind || x->state == FAILED || !watch_same(&x->status, status) ||
            strcmp(x->file, ask->file) != 0 || strcmp(x->key, key_of(ask)) != 0)
            continue;
        while (x->state == MAKING)
            pthread_cond_wait(&s->made, &s->lock);
        if (x->state == THERE) return x;
    }
    return NULL;
}

static void lay(struct file_cache *s, struct entry *x)
{
    struct entry **at = &s->table[x->hash & (s->places - 1)];
    x->other = *at;
    *at = x;
}

static void grow(struct file_cache *s)
{
    s->places *= 4;
    s->table = ARENA_TAKE(s->arena, struct entry *, s->places);
    for (struct entry *x = s->entries; x; x = x->next)
        lay(s, x);
}

static struct entry *enter(struct file_cache *s, const struct file_cache_ask *ask, const struct stat *status)
{
    struct entry *x = ARENA_TAKE(s->arena, struct entry, 1);
    *x = (struct entry){.kind = ask->kind,
                        .file = arena_text(s->arena, ask->file),
                        .key = *key_of(ask) ? arena_text(s->arena, ask->key) : "",
                        .status = *status,
                        .thing = arena_take(s->arena, 1, ask->kind->size),
                        .state = MAKING,
                        .hash = hash_of(ask),
                        .next = s->entries};
    x->arena = ask->kind->small ? NULL : arena_open();
    s->entries = x;
    lay(s, x);
    if (++s->n > 2 * s->places) grow(s);
    return x;
}

static const void *make(struct file_cache *s, struct entry *x, const void *how, struct err *e)
{
    struct err own = {0};
    bool ok = x->kind->make(x->file, how, x->arena, x->thing, &own);
    pthread_mutex_lock(&s->lock);
    x->state = ok ? THERE : FAILED;
    s->bytes += x->arena ? arena_bytes(x->arena) : 0;
    pthread_cond_broadcast(&s->made);
    pthread_mutex_unlock(&s->lock);
    if (!ok && !e->kind) *e = own;
    return ok ? x->thing : NULL;
}

const void *file_cache_take(struct file_cache *s, const struct file_cache_ask *ask, struct arena *a, struct err *e)
{
    struct stat status;
    struct entry *mine = NULL;
    if (s && stat(ask->file, &status) == 0) {
        pthread_mutex_lock(&s->lock);
        const struct entry *found = find(s, ask, &status);
        if (!found && (s->bytes < s->most || ask->kind->small)) mine = enter(s, ask, &status);
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
    for (const struct entry *x = s->entries; x && !file; x = x->next) {
        struct stat now;
        if (stat(x->file, &now) != 0 || !watch_same(&x->status, &now)) file = relpath_make(x->file, NULL, a);
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

/* See shelf.h. One lock guards the list; things are made outside of it, each in an arena of its own. */
#include "base/shelf.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "base/watch.h"

enum state { MAKING, THERE, GONE /* its making failed */ };

struct entry {
    const struct shelf_kind *kind;
    const char *file, *key;
    struct stat status;
    struct arena *arena; /* that it and its thing lie in */
    void *thing;
    enum state state;
    struct entry *next;
};

enum { NOTES = 1 << 14 /* a power of two */, NOTES_MOST = 8 << 20 /* bytes */ };

struct note {
    char key[HASH_TEXT];
    size_t size;
    unsigned char data[];
};

struct shelf {
    pthread_mutex_t lock;
    pthread_cond_t made;
    struct entry *entries;
    size_t bytes, most;
    struct note **notes; /* [NOTES], or NULL: none yet; a key has one place, and drives out what is there */
    size_t noted;        /* their bytes */
};

struct shelf *shelf_open(size_t most)
{
    struct shelf *s = memory_take(sizeof *s);
    *s = (struct shelf){.most = most};
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->made, NULL);
    return s;
}

void shelf_close(struct shelf *s)
{
    if (!s)
        return;
    for (struct entry *x = s->entries, *next; x; x = next) {
        next = x->next;
        arena_close(x->arena);
    }
    for (int i = 0; s->notes && i < NOTES; i++)
        free(s->notes[i]);
    free(s->notes);
    pthread_cond_destroy(&s->made);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

/* Waits where another makes it. NULL: nobody has. */
static const struct entry *find(struct shelf *s, const struct shelf_ask *ask, const struct stat *status)
{
    const char *key = ask->key ? ask->key : "";
    for (struct entry *x = s->entries; x; x = x->next) {
        if (x->kind != ask->kind || x->state == GONE || !watch_same(&x->status, status) || strcmp(x->file, ask->file) != 0 || strcmp(x->key, key) != 0)
            continue;
        while (x->state == MAKING)
            pthread_cond_wait(&s->made, &s->lock);
        if (x->state == THERE)
            return x;
    }
    return NULL;
}

static struct entry *enter(struct shelf *s, const struct shelf_ask *ask, const struct stat *status)
{
    struct arena *a = arena_open();
    struct entry *x = ARENA_TAKE(a, struct entry, 1);
    *x = (struct entry){ask->kind, arena_text(a, ask->file), arena_text(a, ask->key ? ask->key : ""), *status, a, arena_take(a, 1, ask->kind->size), MAKING, s->entries};
    s->entries = x;
    return x;
}

static const void *make(struct shelf *s, struct entry *x, const void *how, struct err *e)
{
    struct err own = {0};
    bool ok = x->kind->make(x->file, how, x->arena, x->thing, &own);
    pthread_mutex_lock(&s->lock);
    x->state = ok ? THERE : GONE;
    s->bytes += arena_bytes(x->arena);
    pthread_cond_broadcast(&s->made);
    pthread_mutex_unlock(&s->lock);
    if (!ok && !e->kind)
        *e = own;
    return ok ? x->thing : NULL;
}

const void *shelf_take(struct shelf *s, const struct shelf_ask *ask, struct arena *a, struct err *e)
{
    struct stat status;
    struct entry *mine = NULL;
    if (s && stat(ask->file, &status) == 0) {
        pthread_mutex_lock(&s->lock);
        const struct entry *found = find(s, ask, &status);
        if (!found && (s->bytes < s->most || ask->kind->small))
            mine = enter(s, ask, &status);
        pthread_mutex_unlock(&s->lock);
        if (found)
            return found->thing;
    }
    if (mine)
        return make(s, mine, ask->how, e);
    void *thing = arena_take(a, 1, ask->kind->size);
    return ask->kind->make(ask->file, ask->how, a, thing, e) ? thing : NULL;
}

const char *shelf_changed(struct shelf *s, struct arena *a)
{
    const char *file = NULL;
    pthread_mutex_lock(&s->lock);
    for (const struct entry *x = s->entries; x && !file; x = x->next) {
        struct stat now;
        if (stat(x->file, &now) != 0 || !watch_same(&x->status, &now))
            file = relpath_make(x->file, NULL, a);
    }
    pthread_mutex_unlock(&s->lock);
    return file;
}

static bool make_sha256(const char *file, const void *how, struct arena *a, void *thing, struct err *e)
{
    (void)a, (void)how;
    return hash_file(file, thing, e);
}

const char *shelf_sha256(struct shelf *s, const char *file, struct arena *a, struct err *e)
{
    static const struct shelf_kind sha256 = {"sha256", HASH_TEXT, make_sha256, true};
    return shelf_take(s, &(struct shelf_ask){.kind = &sha256, .file = file}, a, e);
}

/* ------------------------------------------------------------------ notes */

static size_t place_of(const char *key)
{
    return strtoul((const char[9]){key[0], key[1], key[2], key[3], key[4], key[5], key[6], key[7]}, NULL, 16) % NOTES;
}

static size_t bytes_of(const struct note *n)
{
    return n ? sizeof *n + n->size : 0;
}

/* Under the lock. */
static void put_note(struct shelf *s, struct note *n)
{
    if (!s->notes) {
        s->notes = memory_take(NOTES * sizeof *s->notes);
        memset(s->notes, 0, NOTES * sizeof *s->notes);
    }
    struct note **to = &s->notes[place_of(n->key)];
    s->noted += bytes_of(n) - bytes_of(*to);
    free(*to);
    *to = n;
    for (size_t i = place_of(n->key) + 1; s->noted > NOTES_MOST; i++) {
        struct note **other = &s->notes[i % NOTES];
        s->noted -= bytes_of(*other);
        free(*other);
        *other = NULL;
    }
}

void shelf_note(struct shelf *s, const char *key, const void *data, size_t size)
{
    size_t length = strlen(key);
    if (!s || length < 8 || length >= HASH_TEXT)
        return;
    struct note *n = memory_take(sizeof *n + size);
    memcpy(n->key, key, length + 1);
    n->size = size;
    memcpy(n->data, data, size);
    pthread_mutex_lock(&s->lock);
    put_note(s, n);
    pthread_mutex_unlock(&s->lock);
}

const void *shelf_noted(struct shelf *s, const char *key, struct arena *a)
{
    const void *found = NULL;
    if (!s || strlen(key) < 8)
        return NULL;
    pthread_mutex_lock(&s->lock);
    const struct note *n = s->notes ? s->notes[place_of(key)] : NULL;
    if (n && !strcmp(n->key, key))
        found = memcpy(arena_take(a, n->size, 1), n->data, n->size);
    pthread_mutex_unlock(&s->lock);
    return found;
}

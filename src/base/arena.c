#include "base/arena.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/memory.h"
#include "base/stopwatch.h"

enum {
    ARENA_ALIGN = 64,
    ARENA_FIRST = 1 << 10,
    ARENA_CHUNK = 1 << 16 /* chunks double from the first to this */,
    ARENA_HUGE = 1 << 21 /* a large page's bytes */
};

#define TOUCHED 0.5 /* predicted cycles of a byte that is new: pages are made, and filled with zeros */

struct chunk {
    struct chunk *next;
    void *whole;       /* as it came from calloc */
    size_t used, size; /* bytes after the header, which takes one alignment unit */
};

struct arena {
    struct chunk *chunks;
    size_t bytes;
};

static _Noreturn void arena_full(size_t count, size_t size) { memory_out("%zu x %zu bytes asked for", count, size); }

struct arena *arena_open(void)
{
    struct arena *a = calloc(1, sizeof *a);
    if (!a) arena_full(1, sizeof *a);
    return a;
}

void arena_close(struct arena *a)
{
    if (!a) return;
    for (struct chunk *c = a->chunks, *next; c; c = next) {
        next = c->next;
        free(c->whole);
    }
    free(a);
}

/* Asks for large pages where two or more fit: a render of 22 s of a force from a file fell from 135 to 120 cycles a
 * sample. */
static void chunk_huge(void *whole, size_t size)
{
#ifdef MADV_HUGEPAGE
    uintptr_t at = (uintptr_t)whole, from = (at + ARENA_HUGE - 1) / ARENA_HUGE * ARENA_HUGE,
              to = (at + size) / ARENA_HUGE * ARENA_HUGE;
    if (to >= from + 2 * (uintptr_t)ARENA_HUGE)
        (void)madvise((void *)from, to - from, MADV_HUGEPAGE); /* a wish: nothing depends on it */
#endif
}

static struct chunk *chunk_add(struct arena *a, size_t need)
{
    size_t size = a->chunks ? 2 * a->chunks->size : ARENA_FIRST;
    size = size < ARENA_CHUNK ? size : ARENA_CHUNK;
    size = need > size ? need : size;
    void *whole = size <= SIZE_MAX - 2 * ARENA_ALIGN ? calloc(1, size + 2 * ARENA_ALIGN) : NULL;
    if (!whole) arena_full(1, need);
    chunk_huge(whole, size + 2 * ARENA_ALIGN);
    struct chunk *c = (struct chunk *)(((uintptr_t)whole + ARENA_ALIGN - 1) / ARENA_ALIGN * ARENA_ALIGN);
    *c = (struct chunk){.next = a->chunks, .whole = whole, .size = size};
    a->chunks = c;
    return c;
}

void *arena_take(struct arena *a, size_t count, size_t size)
{
    struct chunk *c = a->chunks;
    size_t need;
    if (size && count > (SIZE_MAX / 2) / size) arena_full(count, size);
    need = (count * size + ARENA_ALIGN - 1) / ARENA_ALIGN * ARENA_ALIGN;
    if (need == 0) need = ARENA_ALIGN;
    if (!c || c->size - c->used < need) c = chunk_add(a, need);
    void *p = (char *)c + ARENA_ALIGN + c->used;
    c->used += need;
    a->bytes += need;
    stopwatch_spend(TOUCHED * (double)need);
    return p; /* zeros: from calloc, which knows fresh pages and does not touch them, and never given twice */
}

void *arena_more(struct arena *a, const void *list, int n, size_t size)
{
    if (n > 0 && (n < 4 || n & (n - 1))) return (void *)list;
    void *more = arena_take(a, n ? 2 * (size_t)n : 4, size);
    return n ? memcpy(more, list, (size_t)n * size) : more;
}

char *arena_text(struct arena *a, const char *s)
{
    size_t n = strlen(s) + 1;
    return memcpy(arena_take(a, n, 1), s, n);
}

char *arena_format(struct arena *a, const char *format, ...)
{
    va_list ap, again;
    va_start(ap, format);
    va_copy(again, ap);
    int n = vsnprintf(NULL, 0, format, ap);
    va_end(ap);
    size_t size = n < 0 ? 1 : (size_t)n + 1;
    char *s = arena_take(a, size, 1);
    if (n > 0) vsnprintf(s, size, format, again);
    va_end(again);
    return s;
}

const char *arena_line(struct arena *a, const char *lines, const char *line)
{
    return lines ? arena_format(a, "%s\n%s", lines, line) : line;
}

size_t arena_bytes(const struct arena *a) { return a->bytes; }

/* See bytes.h. A regular file is read in one piece; a pipe into room that doubles. */
#include "file/bytes.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/text.h"

bool bytes_stream(FILE *f, size_t room, size_t most, struct arena *a, struct bytes *b)
{
    *b = (struct bytes){.at = arena_take(a, room + 1, 1)};
    for (;;) {
        b->n += fread(b->at + b->n, 1, room - b->n, f);
        if (b->n < room || b->n > most) return !ferror(f);
        char *more = arena_take(a, 2 * room + 1, 1);
        memcpy(more, b->at, b->n);
        b->at = more;
        room *= 2;
    }
}

bool bytes_read(const char *path, struct arena *a, struct bytes *b, struct err *e)
{
    struct stat s;
    FILE *f = memory_fopen(path, "rb");
    if (!f || fstat(fileno(f), &s) != 0) {
        int why = errno;
        if (f) fclose(f);
        return err_set(e, ERR_INPUT, "%s: %s", path, strerror(why));
    }
    size_t room = S_ISREG(s.st_mode) && s.st_size > 0 ? (size_t)s.st_size + 1 : 1 << 16;
    bool ok = bytes_stream(f, room, SIZE_MAX, a, b);
    int why = errno;
    fclose(f);
    return ok || err_set(e, ERR_INPUT, "%s: %s", path, strerror(why));
}

char *bytes_trim(char *s)
{
    s += strspn(s, " \t");
    size_t n = strlen(s);
    while (n > 0 && strchr(" \t", s[n - 1]))
        s[--n] = '\0';
    return s;
}

uint64_t bytes_word(const void *bytes, size_t size)
{
    const unsigned char *u = bytes;
    uint64_t v = 0;
    while (size-- > 0)
        v = v << 8 | u[size];
    return v;
}

double bytes_f64(const void *bytes)
{
    uint64_t w = bytes_word(bytes, 8);
    double v;
    memcpy(&v, &w, 8);
    return v;
}

void bytes_put(FILE *f, uint64_t value, size_t size)
{
    unsigned char u[8];
    for (size_t i = 0; i < 8; i++)
        u[i] = (unsigned char)(value >> 8 * i);
    fwrite(u, 1, size, f);
}

void bytes_put_f64(FILE *f, double value)
{
    uint64_t w;
    memcpy(&w, &value, 8);
    bytes_put(f, w, 8);
}

double bytes_number(const void *bytes, char kind, size_t size)
{
    uint64_t w = bytes_word(bytes, size);
    if (kind == 'f' && size == 4) {
        uint32_t half = (uint32_t)w;
        float v;
        memcpy(&v, &half, 4);
        return v;
    }
    if (kind == 'f') return bytes_f64(bytes);
    if (kind == 'u' || w >> (8 * size - 1) == 0) return (double)w;
    return -(double)((UINT64_MAX >> (64 - 8 * size)) - w) - 1;
}

/* Opening a FIFO waits for a writer, and reading for what is written: a signal ends the program there
 * (base/interrupt.h). */

struct piped {
    struct arena *arena; /* in which it lies */
    struct piped *next;
    const char *file;
    struct bytes text;
};

static struct piped *all; /* as long as the program */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

const char *bytes_near(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file, *best = NULL;
    int folder = (int)(name - file), n, limit = (int)strcspn(name, ".") / 3;
    struct dirent **entries;
    limit = limit > 2 ? 2 : limit;
    if (access(file, F_OK) == 0) return NULL;
    n = scandir(folder ? arena_format(a, "%.*s", folder, file) : ".", &entries, NULL, alphasort);
    for (int i = 0; i < n; i++) {
        int distance = text_distance(name, entries[i]->d_name);
        if (distance <= limit) {
            best = arena_format(a, "%.*s%s", folder, file, entries[i]->d_name);
            limit = distance - 1;
        }
        free(entries[i]);
    }
    if (n >= 0) free(entries);
    return best;
}

bool bytes_piped(const char *file)
{
    struct stat s;
    return !strcmp(file, "/dev/stdin") || !strncmp(file, "/dev/fd/", 8) ||
           (!strncmp(file, "/proc/", 6) && strstr(file, "/fd/")) ||
           (stat(file, &s) == 0 && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode));
}

static struct piped *take(const char *file, size_t most)
{
    struct arena *a = arena_open();
    struct piped *k = ARENA_TAKE(a, struct piped, 1);
    FILE *f = memory_fopen(file, "re");
    bool ok = f && bytes_stream(f, 1 << 16, most, a, &k->text);
    int why = errno;
    if (f) fclose(f);
    if (!ok) {
        arena_close(a);
        errno = why;
        return NULL;
    }
    k->arena = a;
    k->next = all;
    k->file = arena_text(a, file);
    k->text.n = k->text.n > most ? most + 1 : k->text.n;
    k->text.at[k->text.n] = '\0';
    return all = k;
}

const char *bytes_piped_read(const char *file, size_t most, size_t *size)
{
    pthread_mutex_lock(&lock);
    struct piped *k = all;
    while (k && strcmp(k->file, file) != 0)
        k = k->next;
    k = k ? k : take(file, most);
    pthread_mutex_unlock(&lock);
    *size = k ? k->text.n : 0;
    return k ? k->text.at : NULL;
}

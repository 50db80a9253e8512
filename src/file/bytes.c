/* See bytes.h. A regular file is read in one piece; a pipe into room that doubles. */
#include "file/bytes.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"

static bool bytes_stream(FILE *f, size_t room, struct arena *a, struct bytes *b)
{
    *b = (struct bytes){.at = arena_take(a, room + 1, 1)};
    for (;;) {
        b->n += fread(b->at + b->n, 1, room - b->n, f);
        if (b->n < room) return !ferror(f);
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
    bool ok = bytes_stream(f, room, a, b);
    int why = errno;
    fclose(f);
    return ok || err_set(e, ERR_INPUT, "%s: %s", path, strerror(why));
}

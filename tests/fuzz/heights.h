/* What the targets of the height map formats share: the reader of one format alone, so that each has its own time and
   its own corpus; what it accepts holds no infinity, and is levelled. */
#ifndef HEIGHTS_H
#define HEIGHTS_H
#include <math.h>

#include "file/bytes.h"
#include "file/heightfile.h"
#include "fuzz.h"

/* 8 bytes a height, and the format's own room: a short file must not take much. */
enum { HEIGHTS_ROOM = 1 << 26 };

typedef bool heights_is(const struct bytes *b);
typedef bool heights_read(const char *path, const struct bytes *b, struct arena *a, struct heightfile *h,
                          struct err *e);

static inline void heights_fuzz(heights_is *is, heights_read *read, const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct bytes b;
    struct heightfile h = {.pitch_x = NAN, .pitch_y = NAN};
    struct err e = {0};
    if (bytes_read(path, a, &b, &e) && is(&b)) {
        bool ok = read(path, &b, a, &h, &e);
        fuzz_check(ok, &e);
        if (arena_bytes(a) > HEIGHTS_ROOM || (ok && (h.rows == 0 || h.columns == 0 || !h.format))) abort();
        for (size_t i = 0; ok && i < h.rows * h.columns; i++)
            ok = !isinf(h.z[i]);
        if (ok && !e.kind) heightfile_level(&h, HEIGHTFILE_LEVEL_PLANE);
    }
    arena_close(a);
}

#endif

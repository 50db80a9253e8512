/* The height map readers of all formats, and filling: no height that is read is infinite, holes are counted right, and
 * a filled map has none. */
#include <math.h>

#include "file/heightfile.h"
#include "fuzz.h"

static void check_heights(const struct heightfile *h)
{
    size_t holes = 0, first = 0;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        if (isinf(h->z[i])) abort();
        first = isnan(h->z[i]) && !holes ? i : first;
        holes += isnan(h->z[i]);
    }
    if (holes != h->holes || (holes && first != h->first_hole) || !h->format || h->rows == 0 || h->columns == 0)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct heightfile h = {0};
    struct err e = {0};
    bool ok = heightfile_read(path, a, &h, &e);
    fuzz_check(ok, &e);
    if (ok) {
        check_heights(&h);
        ok = heightfile_fill(path, &h, &e);
        fuzz_check(ok, &e);
        for (size_t i = 0; ok && i < h.rows * h.columns; i++)
            if (!isfinite(h.z[i])) abort();
    }
    arena_close(a);
    return 0;
}

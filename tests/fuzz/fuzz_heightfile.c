/* The height map readers, NPY and GSF; every height that is read is finite. */
#include <math.h>

#include "file/heightfile.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_file f = fuzz_open(data, size);
    struct arena *a = arena_open();
    struct heightfile h = {0};
    struct err e = {0};
    bool ok = heightfile_read(f.path, a, &h, &e);
    fuzz_check(ok, &e);
    for (size_t i = 0; ok && i < h.rows * h.columns; i++)
        if (!isfinite(h.z[i]))
            abort();
    arena_close(a);
    close(f.fd);
    return 0;
}

/* The mode table reader, and gains at and between places of what it accepts. */
#include <math.h>

#include "fuzz.h"
#include "response/modes.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_file f = fuzz_open(data, size);
    struct arena *a = arena_open();
    struct modes m = {0};
    struct err e = {0};
    bool ok = modes_read(f.path, 20, a, &m, &e);
    fuzz_check(ok, &e);
    if (ok) {
        double re[20], im[20];
        if (m.n < 1 || m.n > 20 || m.places < 1 || isnan(modes_gains_at(&m, 0.01, 0.02, re, im)))
            abort();
    }
    arena_close(a);
    close(f.fd);
    return 0;
}

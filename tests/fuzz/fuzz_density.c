/* A distribution as a table of its density: what is accepted has probabilities from 0 to 1, quantiles that rise and
 * undo them, and finite moments. */
#include <math.h>

#include "force/impact_table.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct fuzz_file f = fuzz_open(data, size);
    struct arena *a = arena_open();
    struct impact_table t = {0};
    struct err e = {0};
    bool ok = impact_table_read(f.path, a, &t, &e);
    fuzz_check(ok, &e);
    if (ok && (t.n < 2 || !isfinite(t.mean) || !isfinite(t.variance) || t.variance < 0)) abort();
    for (int i = 1; ok && i < 64; i++) {
        double x = impact_table_quantile(&t, i / 64.0), below = impact_table_below(&t, x),
               above = impact_table_above(&t, x);
        if (!(x >= t.value[0] && x <= t.value[t.n - 1]) || !(below >= 0 && below <= 1 + 1e-9) ||
            !(fabs(below + above - 1) < 1e-6) || !(impact_table_density(&t, x) >= 0))
            abort();
    }
    arena_close(a);
    close(f.fd);
    return 0;
}

/* A distribution as a table of its density: what is accepted has probabilities from 0 to 1, quantiles that rise and
 * undo them, and finite moments. */
#include <math.h>

#include "force/impact_density.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct err e = {0};
    const struct impact_density *d = impact_density_table(path, a, &e);
    fuzz_check(d != NULL, &e);
    if (d && (d->table.n < 2 || !isfinite(d->mean) || !isfinite(d->variance) || d->variance < 0)) abort();
    for (int i = 1; d && i < 64; i++) {
        double density, x = impact_density_quantile(d, i / 64.0), below = impact_density_beyond(d, false, x, &density),
                        above = impact_density_beyond(d, true, x, &density);
        if (!(x >= d->table.value[0] && x <= d->table.value[d->table.n - 1]) || !(below >= 0 && below <= 1 + 1e-9) ||
            !(fabs(below + above - 1) < 1e-6) || !(density >= 0))
            abort();
    }
    arena_close(a);
    return 0;
}

/* The mode table reader, and modes at and between places of what it accepts. */
#include <math.h>

#include "fuzz.h"
#include "response/modes.h"

/* Frequencies and decays above or at 0 and finite; gains finite, or as large as the table's. */
static void check(const struct modes *m, const struct modes_point *p, double off)
{
    int ok = off >= 0.0 && off < 1e7;
    for (int i = 0; i < m->n; i++) {
        double f = m->shared ? m->frequency[i] : p->frequency[i], d = m->shared ? m->decay[i] : p->decay[i];
        ok = ok && f >= 0.0 && d >= 0.0 && d >= m->slowest[i] * (1 - 1e-9) && !isnan(p->re[i]) && !isnan(p->im[i]);
    }
    if (!ok) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct modes m = {0};
    struct err e = {0};
    bool ok = modes_table(path, &(struct modes_ask){.strongest = 20, .pairing = 0.03, .rate = 48000}, a, &m, &e);
    fuzz_check(ok, &e);
    if (ok && m.n < 1) abort();
    for (int pass = 0; ok && pass < 2 && m.n > 0; pass++) {
        struct modes_point p = modes_point_make(a, m.n);
        for (int k = 0; k < 20; k++)
            check(&m, &p, modes_at(&m, &(struct modes_where){0.01 * k, 0.02, 0}, &p));
        check(&m, &p, modes_at(&m, &(struct modes_where){m.home[0], m.home[1], 0}, &p));
        if (modes_ring_time(&m, 80) < 0) abort();
        modes_drop_above(&m, 3000);
    }
    arena_close(a);
    return 0;
}

/* What `rasp analyse` takes: a force or a list of impacts as CSV (else the input begins as a WAV or an NPY does). */
#include <math.h>

#include "cmd/analyse.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    const struct analyse_given given = {.scale = 0.5, .rate = 1000, .channel = 1};
    struct arena *a = arena_open();
    struct analyse_source s = {0};
    struct err e = {0};
    fuzz_put(path, size >= 4 && memcmp(data, "RIFF", 4) == 0 ? "force.wav" : "force.csv", data, size);
    bool ok = analyse_read(path, &given, a, &s, &e);
    fuzz_check(ok, &e);
    for (long i = 0; ok && s.has_force && i < s.signal.n; i++)
        if (!isfinite(s.signal.force[i])) abort();
    for (int i = 0; ok && !s.has_force && i < s.found.events.n; i++)
        if (!isfinite(s.found.events.time[i]) || !isfinite(s.found.events.amplitude[i])) abort();
    arena_close(a);
    return 0;
}

/* The sound file reader; every sample that is read is finite. */
#include <math.h>

#include "file/wav.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct wav w = {0};
    struct err e = {0};
    bool ok = wav_read(path, a, &w, &e);
    fuzz_check(ok, &e);
    for (size_t i = 0; ok && i < w.frames * (size_t)w.channels; i++)
        if (!isfinite(w.x[i])) abort();
    arena_close(a);
    return 0;
}

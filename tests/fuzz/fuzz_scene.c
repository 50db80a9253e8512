/* The scene reader: any text is either a scene or refused with messages. */
#include "fuzz.h"
#include "scene/scene_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input", data, size);
    struct arena *a = arena_open();
    struct scene s = {0};
    struct err e = {0};
    const struct scene_overrides none = {0};
    const char *messages = NULL;
    fuzz_check(scene_read(path, &none, a, &s, &messages, &e), &e);
    arena_close(a);
    return 0;
}

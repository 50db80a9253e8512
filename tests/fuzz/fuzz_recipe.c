/* A recipe of a surface, and a file that a scene includes: the input is both. */
#include "fuzz.h"
#include "scene/scene_read.h"

static void as(const char *text, const char *name)
{
    char path[128];
    struct arena *a = arena_open();
    struct scene s = {0};
    struct err e = {0};
    const struct scene_overrides none = {0};
    const char *messages = NULL;
    fuzz_put(path, name, text, strlen(text));
    fuzz_check(scene_read(path, &none, a, &s, &messages, &e), &e);
    arena_close(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[128];
    fuzz_put(path, "input.yaml", data, size);
    as("rasp: 1\ncontacts:\n  - {name: a, surface: {recipe: input.yaml}}\n  - {name: b, surface: {recipe: input.yaml, "
       "roughness: {rms: 2 um}}}\n",
       "recipe.yaml");
    as("include: input.yaml\nmotion: {rate: 3 Hz}\n", "include.yaml");
    return 0;
}

/* The index of a folder of responses: the input is index.csv of a folder that holds one sound, a.wav. */
#include <string.h>
#include <sys/stat.h>

#include "fuzz.h"
#include "response/ir.h"

static const unsigned char sound[] = {
    'R', 'I', 'F', 'F',  44, 0, 0, 0, 'W', 'A', 'V', 'E', 'f', 'm', 't', ' ', 16, 0, 0, 0,  1, 0,  1, 0,  0x80, 0xbb,
    0,   0,   0,   0x77, 1,  0, 2, 0, 16,  0,   'd', 'a', 't', 'a', 8,   0,   0,  0, 0, 64, 0, 32, 0, 16, 0,    8};

static void put(const char *folder, const char *name, const void *data, size_t size)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    if (!f || fwrite(data, 1, size, f) != size || fclose(f) != 0) abort();
}

static void drop(const char *folder, const char *name)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char folder[40];
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir_set s;
    fuzz_make_folder(folder);
    put(folder, "a.wav", sound, sizeof sound);
    put(folder, "index.csv", data, size);
    fuzz_check(ir_set_read(&(struct ir_ask){folder, 44100, 1, NULL}, a, &s, &e), &e);
    drop(folder, "a.wav");
    drop(folder, "index.csv");
    if (rmdir(folder) != 0) abort();
    arena_close(a);
    return 0;
}

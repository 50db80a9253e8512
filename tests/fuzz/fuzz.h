/* What fuzz targets share: the input as a file in a folder that lasts as long as the process. A path below /proc/self/fd
   would be taken for a pipe, whose text is read once and kept by its name. */
#ifndef FUZZ_H
#define FUZZ_H
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/err.h"

static char fuzz_folder[40];
static char fuzz_names[8][32]; /* in it */

static inline void fuzz_folder_gone(void)
{
    char path[128];
    for (int i = 0; i < 8 && fuzz_names[i][0]; i++) {
        snprintf(path, sizeof path, "%s/%s", fuzz_folder, fuzz_names[i]);
        unlink(path);
    }
    rmdir(fuzz_folder);
}

/* A folder of its own; in memory, where there is room for that: waiting for a disk is no fuzzing. */
static inline void fuzz_make_folder(char folder[40])
{
    snprintf(folder, 40, "%s/rasp-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!mkdtemp(folder)) abort();
}

/* Writes folder/name, of at most 8 different names, and puts its path into path. */
static inline const char *fuzz_put(char path[128], const char *name, const void *data, size_t size)
{
    int i = 0;
    if (!fuzz_folder[0]) {
        fuzz_make_folder(fuzz_folder);
        if (atexit(fuzz_folder_gone) != 0) abort();
    }
    while (i < 7 && fuzz_names[i][0] && strcmp(fuzz_names[i], name) != 0)
        i++;
    snprintf(fuzz_names[i], sizeof fuzz_names[i], "%s", name);
    snprintf(path, 128, "%s/%s", fuzz_folder, name);
    FILE *f = fopen(path, "wb");
    if (!f || (size > 0 && fwrite(data, 1, size, f) != size) || fclose(f) != 0) abort();
    return path;
}

/* A reader fails with a kind and a text, or succeeds without: anything else is a bug. */
static inline void fuzz_check(bool ok, const struct err *e)
{
    if (ok != (e->kind == ERR_NONE) || (!ok && e->text[0] == '\0')) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
#endif

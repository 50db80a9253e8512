/* What fuzz targets share: the input as a file that has a path but no place on disk. */
#ifndef FUZZ_H
#define FUZZ_H
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/err.h"

struct fuzz_file {
    int fd;
    char path[64];
};

static inline struct fuzz_file fuzz_open(const uint8_t *data, size_t size)
{
    struct fuzz_file f = {.fd = memfd_create("input", MFD_CLOEXEC)};
    if (f.fd < 0 || write(f.fd, data, size) != (ssize_t)size || lseek(f.fd, 0, SEEK_SET) != 0)
        abort();
    snprintf(f.path, sizeof f.path, "/proc/self/fd/%d", f.fd);
    return f;
}

/* A reader fails with a kind and a text, or succeeds without: anything else is a bug. */
static inline void fuzz_check(bool ok, const struct err *e)
{
    if (ok != (e->kind == ERR_NONE) || (!ok && e->text[0] == '\0'))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
#endif

/* For tests of height maps: files made byte by byte, and reading them. */
#ifndef HEIGHTS_H
#define HEIGHTS_H
#include <stdint.h>
#include <unistd.h>

#include "base/arena.h"
#include "file/heightfile.h"
#include "unit.h"

static char path[] = "/tmp/test_heights.XXXXXX";
static unsigned char file[1 << 17];
static size_t size;
static struct heightfile h;
static struct err e;

static inline void put(const void *p, size_t n)
{
    ck_assert_uint_le(size + n, sizeof file);
    memcpy(file + size, p, n);
    size += n;
}

static inline void text(const char *s) { put(s, strlen(s)); }

static inline void number(uint64_t v, int bytes)
{
    for (int i = 0; i < bytes; i++)
        put(&(unsigned char){(unsigned char)(v >> 8 * i)}, 1);
}

static inline void f64(double v) { put(&v, 8); }

/* An unnamed path of its own. */
static inline int path_make(void)
{
    memcpy(path + strlen(path) - 6, "XXXXXX", 6);
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    return fd;
}

static inline struct arena *memory(void)
{
    static struct arena *a;
    if (!a) a = arena_open();
    return a;
}

static inline void file_write(void)
{
    int fd = path_make();
    ck_assert_int_eq(write(fd, file, size), (ssize_t)size);
    close(fd);
}

static inline bool read_file(void)
{
    file_write();
    e = (struct err){0};
    bool ok = heightfile_read(path, memory(), &h, &e);
    unlink(path);
    return ok;
}

static inline void accepted(void) { ck_assert_msg(read_file(), "%s", e.text); }

static inline void refused(const char *says)
{
    ck_assert_msg(!read_file(), "accepted; wanted: %s", says);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s (wanted: %s)", e.text, says);
}

#endif

/* See memory.h. */
#include "base/memory.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "base/interrupt.h"

_Noreturn void memory_out(const char *format, ...)
{
    char what[256], text[300];
    va_list ap;
    va_start(ap, format);
    vsnprintf(what, sizeof what, format, ap);
    va_end(ap);
    snprintf(text, sizeof text, "out of memory (%s)", what);
    err_last_words(ERR_MEMORY, text);
    interrupt_remove();
    _exit(ERR_MEMORY);
}

void *memory_take(size_t bytes)
{
    void *p = malloc(bytes);
    if (!p && bytes > 0) memory_out("%zu bytes asked for", bytes);
    return p;
}

char *memory_realpath(const char *path)
{
    char *real = realpath(path, NULL);
    if (!real && errno == ENOMEM) memory_out("to look up %.200s", path);
    return real;
}

FILE *memory_fopen(const char *path, const char *mode)
{
    FILE *f = fopen(path, mode);
    if (!f && errno == ENOMEM) memory_out("to open %.200s", path);
    return f;
}

void memory_available(size_t bytes)
{
    void *volatile p = memory_take(bytes); /* volatile: else no call is made */
    free(p);
}

FILE *memory_stream(char **text, size_t *size)
{
    FILE *f = open_memstream(text, size);
    if (!f) memory_out("for a text");
    return f;
}

/* A stream that did not get memory on the way has lost some of what was written, whatever fclose says. */
void memory_stream_end(FILE *f, char *const *text)
{
    int lost = ferror(f);
    if (fclose(f) != 0 || lost || !*text) memory_out("for a text");
}

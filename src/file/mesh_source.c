/* See mesh_source.h. */
#include "file/mesh_source.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "file/bytes.h"

enum { SHOWN = 24 }; /* characters of a wrong word that a message repeats */

bool mesh_source_open(struct mesh_source *s, const char *path, struct arena *a, struct err *e)
{
    struct bytes b;
    if (!bytes_read(path, a, &b, e)) return false;
    *s = (struct mesh_source){.path = path, .start = b.at, .at = b.at, .end = b.at + b.n, .line = 1, .e = e};
    return true;
}

bool mesh_source_bad(const struct mesh_source *s, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (s->binary) return err_set(s->e, ERR_SCENE, "%s: byte %td: %s", s->path, s->at - s->start, text);
    return err_set(s->e, ERR_SCENE, "%s:%d: %s", s->path, s->line, text);
}

/* To the next word; with `within`, no further than the end of the line. */
static void skip_blanks(struct mesh_source *s, bool within)
{
    for (; s->at < s->end; s->at++) {
        if (s->remarks && *s->at == '#') s->at += strcspn(s->at, "\n");
        if (s->at >= s->end || !strchr(" \t\r\n", *s->at) || *s->at == '\0' || (within && *s->at == '\n')) return;
        s->line += *s->at == '\n';
    }
}

/* Length of the word there; 0, and an error: the file ends. */
static size_t word(struct mesh_source *s, const char *what)
{
    skip_blanks(s, false);
    if (s->at >= s->end)
        return (size_t)mesh_source_bad(
            s, "the file ends where %s should stand; it was cut off, or its counts are wrong", what);
    size_t n = strcspn(s->at, " \t\r\n");
    return n > 0 ? n : 1;
}

static bool take(struct mesh_source *s, size_t n, unsigned char *to, const char *what)
{
    if ((size_t)(s->end - s->at) < n)
        return mesh_source_bad(s, "the file ends where %s should stand; it was cut off, or its counts are wrong", what);
    memcpy(to, s->at, n);
    s->at += n;
    return true;
}

static uint64_t little(const unsigned char *p, int bytes)
{
    uint64_t v = 0;
    for (int i = bytes; i > 0; i--)
        v = v << 8 | p[i - 1];
    return v;
}

bool mesh_source_whole(struct mesh_source *s, int bytes, int64_t *v, const char *what)
{
    unsigned char b[8];
    if (s->binary) {
        if (!take(s, (size_t)bytes, b, what)) return false;
        *v = bytes == 4 ? (int32_t)(uint32_t)little(b, 4) : (int64_t)little(b, 8);
        return true;
    }
    size_t n = word(s, what), sign = n > 0 && (*s->at == '-' || *s->at == '+'),
           digits = n > 0 ? strspn(s->at + sign, "0123456789") : 0;
    if (n == 0) return false;
    errno = 0;
    *v = digits > 0 && sign + digits == n ? strtoll(s->at, NULL, 10) : 0;
    if (digits == 0 || sign + digits != n || errno != 0)
        return mesh_source_bad(s, "%s is '%.*s', not a whole number%s", what, (int)(n < SHOWN ? n : SHOWN), s->at,
                               errno ? " below 2^63" : "");
    s->at += n;
    return true;
}

bool mesh_source_real(struct mesh_source *s, double *v, const char *what)
{
    if (s->binary) {
        unsigned char b[8];
        if (!take(s, 8, b, what)) return false;
        uint64_t bits = little(b, 8);
        memcpy(v, &bits, 8);
    } else {
        size_t n = word(s, what);
        if (n == 0) return false;
        *v = strtod(s->at, NULL);
        if (text_number_length(s->at) != n) *v = NAN;
        if (!isfinite(*v))
            return mesh_source_bad(s, "%s is '%.*s', not a finite number", what, (int)(n < SHOWN ? n : SHOWN), s->at);
        s->at += n;
    }
    return isfinite(*v) || mesh_source_bad(s, "%s is %g, not a finite number", what, *v);
}

bool mesh_source_count(struct mesh_source *s, int bytes, size_t least, size_t *n, const char *what)
{
    int64_t v;
    if (!mesh_source_whole(s, bytes, &v, what)) return false;
    size_t left = (size_t)(s->end - s->at);
    if (v < 0 || (uint64_t)v > (left + 1) / least)
        return mesh_source_bad(
            s,
            "%s is %" PRId64 ", and the %zu bytes that follow cannot hold so many; the file was cut off, or is damaged",
            what, v, left);
    *n = (size_t)v;
    return true;
}

bool mesh_source_on_line(struct mesh_source *s)
{
    skip_blanks(s, true);
    return s->at < s->end && *s->at != '\n';
}

void mesh_source_next_line(struct mesh_source *s)
{
    const char *stop = memchr(s->at, '\n', (size_t)(s->end - s->at));
    s->at = stop ? stop + 1 : s->end;
    s->line++;
}

bool mesh_source_find(struct mesh_source *s, const char *name)
{
    size_t n = strlen(name);
    const char *p = s->at;
    while ((p = memchr(p, '$', (size_t)(s->end - p))) != NULL) {
        if ((size_t)(s->end - p) > n && !memcmp(p + 1, name, n) && strchr(" \t\r\n", p[1 + n])) break;
        p++;
    }
    if (!p) return false;
    for (; s->at < p; s->at++)
        s->line += *s->at == '\n';
    s->at += 1 + n;
    return true;
}

/* Reads and checks the bytes of a YAML text: see yaml_bytes.h. What is refused here libyaml would refuse too, but
   without a line, or take for an encoding other than UTF-8. */
#include "file/yaml_bytes.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "base/text.h"
#include "file/piped.h"

enum { SIZE_MAX_BYTES = 4 << 20 };

static bool unreadable(struct yaml *y, const char *file, struct diag_place named)
{
    bool pipe = errno == ENXIO;
    const char *why = pipe ? "it is a pipe" : strerror(errno);
    y->missing = true;
    if (named.source)
        diag_add(y->diag, named,
                 pipe ? "only what the command line names may be one: save it as a file"
                      : "a path in a file is relative to that file's folder",
                 "cannot read '%s': %s", file, why);
    else
        diag_add(y->diag, (struct diag_place){yaml_source(y, file, "", 0), 0, 0, 0}, NULL, "cannot be read: %s", why);
    return false;
}

static bool too_large(struct yaml *y, const struct diag_source *source)
{
    diag_add(y->diag, (struct diag_place){source, 0, 0, 0}, "is it a scene? measured data belong in files of their own",
             "larger than %d MiB", SIZE_MAX_BYTES >> 20);
    return false;
}

/* All of it, or a little more than what is too large. */
static char *all_of(FILE *in, struct arena *a, size_t *size)
{
    size_t room = 1 << 16;
    char *buffer = arena_take(a, room + 1, 1);
    for (*size = 0;;) {
        *size += fread(buffer + *size, 1, room - *size, in);
        if (*size < room || *size > SIZE_MAX_BYTES) return buffer;
        buffer = memcpy(arena_take(a, 4 * room + 1, 1), buffer, room);
        room *= 4;
    }
}

const char *yaml_bytes_text(const char *file, struct arena *a, size_t *size)
{
    if (piped_is(file)) return piped_read(file, SIZE_MAX_BYTES, size);
    FILE *in = memory_fopen(file, "rb");
    char *text = in ? all_of(in, a, size) : NULL;
    bool good = in && !ferror(in);
    int why = errno;
    if (good) text[*size] = '\0';
    if (in) fclose(in);
    errno = why;
    return good ? text : NULL;
}

static void note_file(struct yaml *y, const char *name)
{
    struct yaml_file *f = ARENA_TAKE(y->arena, struct yaml_file, 1);
    f->name = name;
    *(y->last_file ? &y->last_file->next : &y->files) = f;
    y->last_file = f;
}

struct diag_source *yaml_bytes_read(struct yaml *y, const char *file, struct diag_place named)
{
    size_t size;
    struct stat s;
    bool waits = named.source && !named.source->made && stat(file, &s) == 0 &&
                 S_ISFIFO(s.st_mode); /* until somebody writes into it */
    const char *text = waits ? NULL : yaml_bytes_text(file, y->arena, &size);
    if (!text) {
        errno = waits ? ENXIO : errno;
        unreadable(y, file, named);
        return NULL;
    }
    const char *name = arena_text(y->arena, file);
    note_file(y, name);
    struct diag_source *source = yaml_source(y, name, text, size);
    source->named = named;
    return source;
}

static const char *byte_order_mark(const struct diag_source *s)
{
    if (s->size >= 3 && memcmp(s->text, "\xef\xbb\xbf", 3) == 0) return "UTF-8 with a byte order mark";
    if (s->size >= 2 && (memcmp(s->text, "\xff\xfe", 2) == 0 || memcmp(s->text, "\xfe\xff", 2) == 0))
        return "UTF-16 or UTF-32";
    return NULL;
}

/* YAML's printable characters and line breaks. */
static bool printable(uint32_t c)
{
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c <= 0x7e) || c == 0x85 ||
           (c >= 0xa0 && c != 0xfeff && c != 0xfffe && c != 0xffff);
}

static bool line_break(uint32_t c, char next)
{
    return c == '\n' || (c == '\r' && next != '\n') || c == 0x85 || c == 0x2028 || c == 0x2029;
}

static bool bad_character(struct yaml *y, struct diag_place at, int length, uint32_t code)
{
    if (length == 0)
        diag_add(y->diag, at, "save the file with the encoding UTF-8", "not valid UTF-8");
    else if (code == 0)
        diag_add(y->diag, at, "save the file as plain text in UTF-8", "a NUL byte");
    else
        diag_add(y->diag, at, "remove it", "control character U+%04X", (unsigned)code);
    return false;
}

bool yaml_bytes_good(struct yaml *y, const struct diag_source *s)
{
    struct diag_place at = {s, 1, 1, 1};
    const char *mark = byte_order_mark(s);
    if (s->size > SIZE_MAX_BYTES) return too_large(y, s);
    if (mark) {
        diag_add(y->diag, (struct diag_place){s, 0, 0, 0}, "save the file as UTF-8 without a byte order mark (BOM)",
                 "encoded as %s", mark);
        return false;
    }
    for (size_t i = 0; i < s->size;) {
        uint32_t code = 0;
        int length = text_utf8(s->text + i, s->size - i, &code);
        if (length == 0 || !printable(code)) return bad_character(y, at, length, code);
        i += (size_t)length;
        at.column++;
        if (line_break(code, i < s->size ? s->text[i] : '\0')) {
            at.line++;
            at.column = 1;
        }
    }
    return true;
}

/* Collects errors and shows them with the line they are about: see diag.h. */
#include "base/diag.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"

enum { LINE_SHOWN = 160, LINE_BEFORE = 60, WORD_SHOWN = 40 };

struct span {
    const char *start;
    size_t size;
};

struct diag *diag_open(struct arena *a)
{
    struct diag *d = ARENA_TAKE(a, struct diag, 1);
    d->arena = a;
    return d;
}

bool diag_add(struct diag *d, struct diag_place at, const char *help, const char *format, ...)
{
    char text[1024];
    va_list ap;
    if (!d->errors) d->errors = ARENA_TAKE(d->arena, struct diag_error, DIAG_STORED);
    if (d->n < DIAG_STORED) {
        va_start(ap, format);
        vsnprintf(text, sizeof text, format, ap);
        va_end(ap);
        d->errors[d->n] =
            (struct diag_error){at, text_shown(d->arena, text), help ? text_shown(d->arena, help) : NULL, d->n};
    }
    d->n++;
    return false;
}

static size_t bytes_of(const char *s, size_t size, size_t characters)
{
    size_t at = 0;
    uint32_t code;
    while (at < size && characters-- > 0) {
        int n = text_utf8(s + at, size - at, &code);
        at += n ? (size_t)n : 1;
    }
    return at;
}

const char *diag_shown(struct diag *d, const char *text)
{
    size_t size = strlen(text), cut = bytes_of(text, size, WORD_SHOWN);
    return arena_format(d->arena, "%.*s%s", (int)cut, text, cut < size ? "..." : "");
}

/* Bytes of the line break at s (YAML's: LF, CR, CR LF, NEL, LS, PS); 0: none. */
static size_t break_at(const char *s, size_t size)
{
    if (s[0] == '\r') return size > 1 && s[1] == '\n' ? 2 : 1;
    if (s[0] == '\n') return 1;
    if (size > 1 && memcmp(s, "\xc2\x85", 2) == 0) return 2;
    return size > 2 && (memcmp(s, "\xe2\x80\xa8", 3) == 0 || memcmp(s, "\xe2\x80\xa9", 3) == 0) ? 3 : 0;
}

static struct span line_of(const struct diag_source *source, int line)
{
    const char *s = source->text, *end = s + source->size;
    const char *start = s;
    for (int at = 1; s < end;) {
        size_t n = break_at(s, (size_t)(end - s));
        if (n && at == line) break;
        s += n ? n : 1;
        if (n) {
            at++;
            start = s;
        }
    }
    return (struct span){start, (size_t)(s - start)};
}

static void show_caret(FILE *out, struct span line, int column, int width)
{
    size_t before = bytes_of(line.start, line.size, (size_t)(column - 1)), rest = line.size - before;
    while (rest > 0 && (line.start[before + rest - 1] == ' ' || line.start[before + rest - 1] == '\t'))
        rest--;
    int most = (int)text_utf8_count(line.start + before, rest);
    if (width <= 0 || width > most) width = most;
    fputs("      | ", out);
    for (size_t i = 0, step; i < before; i += step) {
        step = bytes_of(line.start + i, before - i, 1);
        fputc(line.start[i] == '\t' ? '\t' : ' ', out);
    }
    fputc('^', out);
    for (int i = 1; i < width; i++)
        fputc('~', out);
    fputc('\n', out);
}

static void show_line(FILE *out, const struct diag_place *at)
{
    int column = at->column < 1 ? 1 : at->column;
    struct span line = line_of(at->source, at->line);
    if (text_utf8_count(line.start, line.size) > LINE_SHOWN) { /* a long one from a little before the column */
        size_t skip = column > LINE_BEFORE ? (size_t)(column - LINE_BEFORE) : 0;
        size_t from = bytes_of(line.start, line.size, skip);
        column -= (int)skip;
        line.start += from;
        line.size = bytes_of(line.start, line.size - from, LINE_SHOWN);
    }
    if (at->source->option)
        fputs("      | ", out);
    else
        fprintf(out, "%5d | ", at->line);
    for (size_t i = 0, step; i < line.size; i += step) {
        /* what cannot be shown is one '?' for each character, so that the caret stays below its place */
        step = bytes_of(line.start + i, line.size - i, 1);
        if (line.start[i] == '\t' || text_showable(line.start + i, line.size - i))
            fwrite(line.start + i, 1, step, out);
        else
            fputc('?', out);
    }
    fputc('\n', out);
    show_caret(out, line, column, at->width);
}

/* "scene.yaml:4:12", or the name alone. */
static const char *place_text(struct arena *a, const struct diag_place *at)
{
    const char *name = text_shown(a, at->source->name);
    return at->line > 0 && !at->source->option && !at->source->made
               ? arena_format(a, "%s:%d:%d", name, at->line, at->column)
               : name;
}

const char *diag_named(struct arena *a, const struct diag_source *source)
{
    const char *all = "";
    for (const struct diag_place *at = &source->named; at->source && !at->source->made; at = &at->source->named)
        all = arena_format(a, "%s%snamed at %s", all, *all ? ", " : " (", place_text(a, at));
    return *all ? arena_format(a, "%s)", all) : "";
}

static const char *header(struct diag *d, const struct diag_error *x)
{
    if (!x->at.source) return arena_format(d->arena, "error: %s", x->text);
    return arena_format(d->arena, "%s: error: %s%s", place_text(d->arena, &x->at), x->text,
                        diag_named(d->arena, x->at.source));
}

static int by_place(const void *pa, const void *pb)
{
    const struct diag_error *a = pa, *b = pb;
    const int of[2][4] = {{a->at.source ? a->at.source->order : -1, a->at.line, a->at.column, a->serial},
                          {b->at.source ? b->at.source->order : -1, b->at.line, b->at.column, b->serial}};
    int k = 0;
    while (k < 3 && of[0][k] == of[1][k])
        k++;
    return (of[0][k] > of[1][k]) - (of[0][k] < of[1][k]);
}

static int sorted(struct diag *d)
{
    int stored = d->n < DIAG_STORED ? d->n : DIAG_STORED;
    qsort(d->errors, (size_t)stored, sizeof *d->errors, by_place);
    return stored;
}

const char *diag_text(struct diag *d)
{
    char *buffer = NULL;
    size_t size = 0;
    FILE *out = memory_stream(&buffer, &size);
    int stored = sorted(d);
    for (const struct diag_error *x = d->errors; x < d->errors + stored && x < d->errors + DIAG_SHOWN; x++) {
        fprintf(out, "%s\n", header(d, x));
        if (x->at.source && x->at.line > 0 && !x->at.source->made) show_line(out, &x->at);
        if (x->help) fprintf(out, "      = help: %s\n", x->help);
    }
    if (d->n > DIAG_SHOWN) fprintf(out, "... and %d more\n", d->n - DIAG_SHOWN);
    fprintf(out, "%d error%s\n", d->n, d->n == 1 ? "" : "s");
    memory_stream_end(out, &buffer);
    const char *text = arena_text(d->arena, buffer);
    free(buffer);
    return text;
}

const char *diag_first(struct diag *d)
{
    if (sorted(d) == 0) return "";
    const char *first = header(d, &d->errors[0]);
    return d->n == 1 ? first : arena_format(d->arena, "%s (and %d more)", first, d->n - 1);
}

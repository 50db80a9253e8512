/* See keys_yaml.h. A map's header is written when its first key is, and is itself commented out when all of its keys
 * are. */
#include "scene/keys_yaml.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "base/wrap.h"
#include "scene/keys.h"

static bool under(const char *path, const char *map, size_t length)
{
    return !strncmp(path, map, length) && path[length] == '.';
}

/* Is every line of the map path[0 .. length) commented out? */
static bool all_off(const struct keys_line *lines, int n, const char *path, size_t length)
{
    for (int i = 0; i < n; i++)
        if (under(lines[i].path, path, length) && !lines[i].off) return false;
    return true;
}

static const char *section_meaning(const char *path, size_t length)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (strlen(s->path) == length && !strncmp(s->path, path, length)) return s->meaning;
    return NULL;
}

static void print_comment(FILE *f, const char *text, int indent)
{
    char margin[64];
    snprintf(margin, sizeof margin, "%*s# ", indent, "");
    fputs(margin, f);
    wrap_print(f, text, indent + 2, margin);
}

static void print_header(FILE *f, const char *path, size_t length, int indent, bool off)
{
    size_t start = length;
    while (start > 0 && path[start - 1] != '.')
        start--;
    fprintf(f, "%*s%s%.*s:\n", indent, "", off ? "#" : "", (int)(length - start), path + start);
}

/* Headers of the maps that `path` is in and `last` is not; returns the indent of the key itself. */
static int open_maps(FILE *f, const struct keys_line *lines, int n, int i, const struct keys_style *style)
{
    const char *path = lines[i].path, *last = i > 0 ? lines[i - 1].path : "";
    int indent = style->indent;
    for (const char *dot = strchr(path, '.'); dot; dot = strchr(dot + 1, '.')) {
        size_t length = (size_t)(dot - path);
        const char *meaning = style->comments ? section_meaning(path, length) : NULL;
        if (!under(last, path, length)) {
            if (style->comments && indent == style->indent) fputc('\n', f);
            if (meaning) print_comment(f, meaning, indent);
            print_header(f, path, length, indent, all_off(lines, n, path, length));
        }
        indent += 2;
    }
    return indent;
}

static void print_key(FILE *f, const struct keys_line *l, int indent)
{
    const char *dot = strrchr(l->path, '.');
    if (l->comment) print_comment(f, l->comment, indent);
    fprintf(f, "%*s%s%s: %s\n", indent, "", l->off ? "#" : "", dot ? dot + 1 : l->path, l->value);
}

/* Writes to memory and puts "- " over the last two columns before the first key. */
static void print_item(FILE *f, const struct keys_line *lines, int n, const struct keys_style *style)
{
    struct keys_style inner = *style;
    char *text = NULL;
    size_t size = 0;
    FILE *memory = memory_stream(&text, &size);
    inner.item = false;
    keys_yaml_print(memory, lines, n, &inner);
    memory_stream_end(memory, &text);
    if (style->indent >= 2 && size > (size_t)style->indent) text[style->indent - 2] = '-';
    fputs(text, f);
    free(text);
}

void keys_yaml_print(FILE *f, const struct keys_line *lines, int n, const struct keys_style *style)
{
    if (style->item) {
        print_item(f, lines, n, style);
        return;
    }
    for (int i = 0; i < n; i++) {
        if (style->comments && !strchr(lines[i].path, '.') && i > 0 && strchr(lines[i - 1].path, '.')) fputc('\n', f);
        print_key(f, &lines[i], open_maps(f, lines, n, i, style));
    }
}

/* ------------------------------------------------------------------ scalars */

/* May it stand in a YAML stream as it is, on one line? (YAML 1.1, c-printable without line breaks.) */
static bool plain(uint32_t c)
{
    return (c >= 0x20 && c <= 0x7E) ||
           (c >= 0xA0 && c != 0x2028 && c != 0x2029 && c != 0xFEFF && c != 0xFFFE && c != 0xFFFF);
}

static void put_escaped(FILE *f, uint32_t c)
{
    if (c <= 0xFF)
        fprintf(f, "\\x%02" PRIX32, c);
    else
        fprintf(f, "\\u%04" PRIX32, c);
}

const char *keys_yaml_quoted(const char *text, struct arena *a)
{
    char *memory = NULL;
    size_t size = 0;
    FILE *f = memory_stream(&memory, &size);
    fputc('"', f);
    for (const char *s = text; *s;) {
        uint32_t code = 0;
        int n = text_utf8(s, strlen(s), &code);
        if (n && !plain(code)) {
            put_escaped(f, code);
        } else {
            if (*s == '"' || *s == '\\') fputc('\\', f);
            fwrite(s, 1, (size_t)(n ? n : 1), f);
        }
        s += n ? n : 1;
    }
    fputc('"', f);
    memory_stream_end(f, &memory);
    const char *quoted = arena_text(a, memory);
    free(memory);
    return quoted;
}

const char *keys_yaml_number(double x, struct arena *a)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    return arena_text(a, text);
}

/* See keys_yaml.h. A map's header is written when its first key is, and is itself commented out when all of its keys
 * are. */
#include "scene/keys_yaml.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/params.h"

static bool under(const char *path, const char *map, size_t length)
{
    return !strncmp(path, map, length) && path[length] == '.';
}

static void print_comment(FILE *f, const char *text, int indent)
{
    char margin[64];
    snprintf(margin, sizeof margin, "%*s# ", indent, "");
    fputs(margin, f);
    text_wrap(f, text, indent + 2, margin);
}

/* Headers of the maps that `path` is in and `last` is not; returns the indent of the key itself. */
static int open_maps(FILE *f, const struct keys_line *lines, int n, int i, const struct keys_style *style)
{
    const char *path = lines[i].path, *last = i > 0 ? lines[i - 1].path : "";
    int indent = style->indent;
    for (const char *dot = strchr(path, '.'); dot; dot = strchr(dot + 1, '.')) {
        size_t length = (size_t)(dot - path);
        const char *meaning = NULL;
        for (const struct key_section *s = keys_sections; style->comments && s->path; s++)
            if (strlen(s->path) == length && !strncmp(s->path, path, length)) meaning = s->meaning;
        bool off = true; /* every line of the map is */
        for (int k = 0; k < n; k++)
            off = off && (lines[k].off || !under(lines[k].path, path, length));
        if (!under(last, path, length)) {
            if (style->comments && indent == style->indent) fputc('\n', f);
            if (meaning) print_comment(f, meaning, indent);
            size_t start = length;
            while (start > 0 && path[start - 1] != '.')
                start--;
            fprintf(f, "%*s%s%.*s:\n", indent, "", off ? "#" : "", (int)(length - start), path + start);
        }
        indent += 2;
    }
    return indent;
}

void keys_yaml_print(FILE *f, const struct keys_line *lines, int n, const struct keys_style *style)
{
    if (style->item) { /* to memory, with "- " over the last two columns before the first key */
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
        return;
    }
    for (int i = 0; i < n; i++) {
        if (style->comments && !strchr(lines[i].path, '.') && i > 0 && strchr(lines[i - 1].path, '.')) fputc('\n', f);
        const char *dot = strrchr(lines[i].path, '.');
        int indent = open_maps(f, lines, n, i, style);
        if (lines[i].comment) print_comment(f, lines[i].comment, indent);
        fprintf(f, "%*s%s%s: %s\n", indent, "", lines[i].off ? "#" : "", dot ? dot + 1 : lines[i].path, lines[i].value);
    }
}

/* ------------------------------------------------------------------ scalars */

const char *keys_yaml_quoted(const char *text, struct arena *a)
{
    char *memory = NULL;
    size_t size = 0;
    FILE *f = memory_stream(&memory, &size);
    fputc('"', f);
    for (const char *s = text; *s;) {
        uint32_t code = 0;
        int n = text_utf8(s, strlen(s), &code);
        /* May it stand in a YAML stream as it is, on one line? (YAML 1.1, c-printable without line breaks.) */
        bool plain = (code >= 0x20 && code <= 0x7E) || (code >= 0xA0 && code != 0x2028 && code != 0x2029 &&
                                                        code != 0xFEFF && code != 0xFFFE && code != 0xFFFF);
        if (n && !plain)
            fprintf(f, code <= 0xFF ? "\\x%02" PRIX32 : "\\u%04" PRIX32, code);
        else {
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

/* ------------------------------------------------------------------ the reference scene */

/* From the tables come keys, defaults, ranges, meanings; what has no default is shown by an example. A key is commented
   out when it stands for something else than the scene shows: a rival of a key that is given, a section that is not, or
   a key that does not apply. */

static const char head[] =
    "# Every key of a scene, with its default. It is a scene: rasp check takes it as it stands.\n"
    "# A line that begins with #key: is an alternative or may be left out; remove the # to use it.\n"
    "# A bare number is in SI units (m, s, kg, N, Hz, rad); with a unit it is what the unit says: 20 g, 5.6 um, 30 "
    "deg.\n"
    "\n";

static const char tail[] =
    "\n"
    "# Several contacts, whose sounds add up, stand in a list instead of at the top level:\n"
    "#contacts:\n"
    "#  - name: rod\n"
    "#    surface: {roughness: {rms: 4 um}}\n"
    "#    scraper: {mass: 20 g}\n"
    "#    motion: {path: line, to: [10 cm, 0 cm], speed: 5 cm/s}\n"
    "#  - name: comb\n"
    "#    start: 0.5 s\n"
    "#    surface: {roughness: {rms: 9 um}}\n"
    "#    scraper: {mass: 8 g}\n"
    "#    motion: {path: line, to: [10 cm, 0 cm], speed: 20 cm/s}\n"
    "\n"
    "# Scene files to build on: maps merge, lists are replaced, this file wins. Names are as seen from this file.\n"
    "#include: [plank.yaml, hand.yaml]\n";

const char *keys_yaml_example(const char *path)
{
    const struct key *k = keys_find(path);
    return !k ? NULL : k->shown ? k->shown : k->example;
}

static const char *shown(const struct key *k)
{
    const char *value = keys_yaml_example(k->path);
    return value ? value : k->standard ? k->standard : "";
}

static bool is_off(const struct key *k);

static bool applies(const struct key *k)
{
    const struct key *decides = keys_decider(k);
    if (!decides) return true;
    return applies(decides) &&
           (keys_words(k) ? keys_applies_with(k, shown(decides)) : keys_applies_beside(k, !is_off(decides)));
}

static bool is_off(const struct key *k)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!s->in->shown && !strncmp(k->path, s->path, strlen(s->path)) && k->path[strlen(s->path)] == '.')
            return true;
    return (k->standard && !*k->standard && !k->on) || !applies(k);
}

static const char *comment(const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a);
    const char *all = arena_format(a, "%s%s%s%s%s", k->meaning, range ? "; " : "", range ? range : "",
                                   when ? "; only " : "", when ? when : "");
    const char *rivals = NULL;
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        for (int i = 0; !rivals && t->paths[i]; i++)
            if (!strcmp(t->paths[i], k->path))
                rivals = arena_format(a, "; %s%s", keys_text_rivals(t, a), keys_text_rivals_apply(t, a));
    if (rivals) all = arena_format(a, "%s%s", all, rivals);
    if (keys_same_words(k)) return arena_format(a, "%s; words: see %s", all, keys_same_words(k)->path);
    for (const struct choice *c = k->choices; c && c->word; c++)
        all = arena_format(a, "%s\n- %s: %s", all, c->word, c->meaning);
    return all;
}

static void print_knobs(FILE *f, struct arena *a)
{
    int n = 2, room = 2;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        room++;
    struct keys_line *lines = ARENA_TAKE(a, struct keys_line, room);
    lines[0] = (struct keys_line){.path = "accuracy.preset", .value = "standard"};
    lines[1] = (struct keys_line){.path = "accuracy.error", .value = "-80 dB", .off = true};
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        for (int i = 0; i < 2; i++)
            if (!strcmp(p->path, lines[i].path)) lines[i].comment = p->meaning;
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        const char *all = arena_format(a, "%s; %.6g to %.6g;", k->meaning, k->low, k->high);
        for (int i = 0; i < 4; i++)
            all = arena_format(a, "%s%s %s %s", all, i ? "," : "", keys_presets[i], keys_yaml_number(k->preset[i], a));
        lines[n++] = (struct keys_line){.path = arena_format(a, "accuracy.%s", k->name),
                                        .value = keys_yaml_number(k->preset[1], a),
                                        .comment = all};
    }
    keys_yaml_print(f, lines, n, &(struct keys_style){.comments = true});
}

void keys_yaml_reference(FILE *f, struct arena *a)
{
    int n = 0;
    while (keys_table[n].path)
        n++;
    struct keys_line *lines = ARENA_TAKE(a, struct keys_line, n);
    for (int i = 0; i < n; i++)
        lines[i] = (struct keys_line){keys_table[i].path, shown(&keys_table[i]), comment(&keys_table[i], a),
                                      is_off(&keys_table[i])};
    fputs(head, f);
    keys_yaml_print(f, lines, n, &(struct keys_style){.comments = true});
    print_knobs(f, a);
    fputs(tail, f);
}

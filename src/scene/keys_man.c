/* See keys_man.h. One .Ss for the scene's own keys and one for each top-level map; a sentence begins a line, as mdoc
 * asks for. */
#include "scene/keys_man.h"

#include <ctype.h>
#include <string.h>

#include "scene/keys_text.h"
#include "scene/keys_yaml.h"

/* Text with roff's own characters made harmless. */
static void put_text(FILE *f, const char *text)
{
    if (*text == '.' || *text == '\'') fputs("\\&", f);
    for (; *text; text++) {
        if (*text == '\\')
            fputs("\\e", f);
        else if (*text == '-')
            fputs("\\-", f);
        else if (*text == '^')
            fputs("\\(ha", f);
        else
            fputc(*text, f);
    }
}

static void put_sentence(FILE *f, const char *text)
{
    put_text(f, text);
    fputs(text[strlen(text) - 1] == '.' ? "\n" : ".\n", f);
}

/* The same with a capital letter, unless the first word is a name or a symbol. */
static void put_opening(FILE *f, const char *text, struct arena *a)
{
    char *copy = arena_text(a, text);
    size_t word = strcspn(copy, " :_,");
    if (copy[word] == ' ' && word > 1 && strncmp(copy, "alpha ", 6) != 0)
        copy[0] = (char)toupper((unsigned char)copy[0]);
    put_sentence(f, copy);
}

static void put_words(FILE *f, const struct choice *choices)
{
    fputs(".Bl -tag -width Ds -compact\n", f);
    for (const struct choice *c = choices; c->word; c++) {
        fprintf(f, ".It Cm %s\n", c->word);
        put_sentence(f, c->meaning);
    }
    fputs(".El\n", f);
}

static void put_rivals(FILE *f, const char *path, struct arena *a)
{
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        for (int i = 0; t->paths[i]; i++)
            if (!strcmp(t->paths[i], path))
                put_opening(f,
                            arena_format(a, "%s %s be given%s", keys_text_rivals(t, a), t->least ? "must" : "may",
                                         keys_text_rivals_apply(t, a)),
                            a);
}

static void put_key(FILE *f, const struct key *k, struct arena *a)
{
    const char *range = keys_text_range(k, a), *when = keys_text_applies(k, a);
    fprintf(f, ".It Ic %s\n", k->path);
    put_opening(f, k->meaning, a);
    if (keys_same_words(k))
        put_sentence(f, arena_format(a, "Type: one of the words of %s", keys_same_words(k)->path));
    else
        put_sentence(f, arena_format(a, "Type: %s", keys_text_type(k)));
    if (range) put_sentence(f, arena_format(a, "Range: %s", range));
    put_sentence(f, arena_format(a, "Default: %s", k->standard ? keys_text_default(k) : "none, it must be given"));
    if (when) put_opening(f, arena_format(a, "only %s", when), a);
    put_rivals(f, k->path, a);
    if (k->choices && !keys_same_words(k)) put_words(f, k->choices);
}

static void put_section(FILE *f, const struct key_section *s, struct arena *a)
{
    fprintf(f, ".It Ic %s\n", s->path);
    put_opening(f, arena_format(a, "Section: %s", s->meaning), a);
    put_rivals(f, s->path, a);
}

/* Does the section's item stand before this key: is the key the section's first? */
static bool opens_section(const struct key *k, const struct key_section *s)
{
    size_t n = strlen(s->path);
    if (strncmp(k->path, s->path, n) != 0 || k->path[n] != '.') return false;
    return k == keys_table || strncmp(k[-1].path, s->path, n) != 0 || k[-1].path[n] != '.';
}

static bool same_group(const struct key *k, const char *map)
{
    size_t n = strcspn(k->path, ".");
    return k->path[n] ? strlen(map) == n && !strncmp(k->path, map, n) : !*map;
}

static void put_group(FILE *f, const char *map, struct arena *a)
{
    fprintf(f, ".Ss %s\n.Bl -tag -width Ds\n", *map ? map : "The scene itself");
    for (const struct key *k = keys_table; k->path; k++) {
        if (!same_group(k, map)) continue;
        for (const struct key_section *s = keys_sections; s->path; s++)
            if (opens_section(k, s)) put_section(f, s, a);
        put_key(f, k, a);
    }
    for (const struct keys_text_frame *p = keys_text_frames; !*map && p->path; p++) {
        fprintf(f, ".It Ic %s\n", p->path);
        put_opening(f, p->meaning, a);
        put_sentence(f, arena_format(a, "Type: %s", p->type));
    }
    fputs(".El\n", f);
}

static void put_knobs(FILE *f, struct arena *a)
{
    fputs(".Ss accuracy\n.Bl -column \"oversampling\" \"draft\" \"standard\" \"high\" \"reference\"\n.It knob Ta draft "
          "Ta standard Ta high Ta reference\n",
          f);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        fprintf(f, ".It Ic %s", k->name);
        for (int i = 0; i < 4; i++)
            fprintf(f, " Ta %s", keys_yaml_number(k->preset[i], a));
        fputc('\n', f);
    }
    fputs(".El\n.Bl -tag -width Ds\n", f);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        fprintf(f, ".It Ic accuracy.%s\n", k->name);
        put_opening(f, k->meaning, a);
        put_sentence(f, arena_format(a, "Range: %.6g to %.6g%s", k->low, k->high, k->whole ? ", a whole number" : ""));
    }
    fputs(".El\n", f);
}

void keys_man_print(FILE *f, struct arena *a)
{
    put_group(f, "", a);
    for (const struct key *k = keys_table; k->path; k++) {
        size_t n = strcspn(k->path, ".");
        bool first = k->path[n] && (k == keys_table || strncmp(k[-1].path, k->path, n + 1) != 0);
        if (first) put_group(f, arena_format(a, "%.*s", (int)n, k->path), a);
    }
    put_knobs(f, a);
}

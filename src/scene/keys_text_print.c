/* The phrases of keys_text.c as the texts of `rasp explain KEY`. */
#include <string.h>

#include "base/wrap.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"

#define MARGIN "            "

static void print_fact(FILE *f, const char *name, const char *text)
{
    if (!text) return;
    fprintf(f, "  %-10s", name);
    wrap_print(f, text, 12, MARGIN);
}

static void print_words(FILE *f, const struct choice *choices)
{
    fputs("  words\n", f);
    for (const struct choice *c = choices; c->word; c++) {
        int n = fprintf(f, "    %-16s", c->word);
        wrap_print(f, c->meaning, n, "                    ");
    }
}

static void print_choose(FILE *f, const char *path, struct arena *a)
{
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        if (keys_text_has(t, path))
            print_fact(f, "choose", arena_format(a, "%s%s", keys_text_rivals(t, a), keys_text_rivals_apply(t, a)));
}

void keys_text_print_key(FILE *f, const struct key *k, struct arena *a)
{
    int n = fprintf(f, "%s: ", k->path);
    wrap_print(f, k->meaning, n, MARGIN);
    print_fact(f, "type", keys_text_type(k));
    print_fact(f, "range", keys_text_range(k, a));
    print_fact(f, "default", keys_text_default(k));
    print_fact(f, "applies", keys_text_applies(k, a));
    print_choose(f, k->path, a);
    print_fact(f, "belongs",
               k->of == KEY_SCENE ? "to the scene" : "to a contact: at the top level, or in each entry of contacts");
    if (k->choices) print_words(f, k->choices);
}

static const char *map_meaning(const char *path)
{
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strcmp(s->path, path)) return s->meaning;
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) return p->meaning;
    return NULL;
}

void keys_text_print_map(FILE *f, const char *path, struct arena *a)
{
    const char *meaning = map_meaning(path);
    size_t length = strlen(path);
    fprintf(f, "%s%s", path, meaning ? ": " : "\n");
    if (meaning) wrap_print(f, meaning, (int)length + 2, MARGIN);
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) print_fact(f, "type", p->type);
    print_choose(f, path, a);
    for (const struct key *k = keys_table; k->path; k++) {
        if (strncmp(k->path, path, length) != 0 || k->path[length] != '.') continue;
        int n = fprintf(f, "  %-33s ", k->path);
        wrap_print(f, arena_format(a, "%s (%s)", k->meaning, keys_text_default(k)), n,
                   "                                    ");
    }
}

static void print_presets(FILE *f, const struct key_knob *k, struct arena *a)
{
    for (int i = 0; i < 4; i++)
        fprintf(f, "  %10s", keys_yaml_number(k->preset[i], a));
    fputc('\n', f);
}

static void print_preset_names(FILE *f, int width)
{
    fprintf(f, "  %-*s", width, "");
    for (int i = 0; i < 4; i++)
        fprintf(f, "  %10s", keys_presets[i]);
    fputc('\n', f);
}

void keys_text_print_knob(FILE *f, const struct key_knob *k, struct arena *a)
{
    int n = fprintf(f, "accuracy.%s: ", k->name);
    wrap_print(f, k->meaning, n, MARGIN);
    print_fact(f, "type", k->whole ? "whole number" : "number");
    print_fact(f, "range", arena_format(a, "%.6g to %.6g", k->low, k->high));
    print_preset_names(f, 9);
    fprintf(f, "  %-9s", "preset");
    print_presets(f, k, a);
}

void keys_text_print_accuracy(FILE *f, struct arena *a)
{
    keys_text_print_map(f, "accuracy", a);
    print_preset_names(f, 16);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        fprintf(f, "  %-16s", k->name);
        print_presets(f, k, a);
    }
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        int n = fprintf(f, "  %-16s  ", k->name);
        wrap_print(f, k->meaning, n, "                    ");
    }
}

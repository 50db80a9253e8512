/* See keys_text.h: the phrases, as the texts of `rasp explain KEY`, and as mdoc(7). */
#include "scene/keys_text.h"

#include <ctype.h>
#include <string.h>

#include "base/text.h"
#include "scene/keys_yaml.h"
#include "scene/units.h"

const struct keys_text_frame keys_text_frames[] = {
    {"include", "list of file names",
     "scene files that this one builds on: maps merge, lists are replaced, the including file wins"},
    {"contacts", "list of contacts",
     "several contacts, whose sounds add up: each entry holds a name and what else stands at the top level of a "
     "scene with one (surface, scraper, motion, ...)"},
    {"materials", "map of names",
     "materials of the scene's own, which material of a body takes by name. Each is a map of youngs_modulus (or "
     "wave_speed, sqrt(youngs_modulus/density), where the density is not known), poisson (or like: a wood, whose "
     "ratios of moduli it keeps), density, alpha, beta, loss, source. The command rasp modes material writes such "
     "entries"},
    {"accuracy", "draft, standard, high, reference, or a map",
     "how much time is spent on accuracy: a preset, which is an error to aim at, or a map of preset, error and single "
     "knobs"},
    {"accuracy.error", "number, dB, -240 to below 0",
     "error relative to the sound, rms, that the knobs not given are chosen by, as cheaply as keeps it; what cannot be "
     "kept is refused"},
    {"accuracy.preset", "draft, standard, high or reference",
     "draft, standard and high aim at errors of -40, -70 and -100 dB, by which the knobs not given are chosen; "
     "reference has fixed knobs"},
    {"inputs", "list of file and sha256",
     "the files of an effective scene as they were: one that has changed is an error"},
    {NULL, NULL, NULL},
};

const char *keys_text_unit(enum key_dimension d)
{
    return d == KEY_STIFFNESS ? "" : d == KEY_FORCE_COEFFICIENT ? "N (s/m)^beta2" : units_si(d);
}

const char *keys_text_type(const struct key *k, struct arena *a)
{
    switch (k->type) {
    case KEY_NUMBER:
        return units_type(k->dimension, a);
    case KEY_WHOLE:
        return "frequency, a whole number of Hz";
    case KEY_TIME_OR_AUTO:
        return "time (a bare number is in s), or auto";
    case KEY_COUNT:
        return "whole number";
    case KEY_SEED:
        return "whole number from 0 to 18446744073709551615";
    case KEY_TEXT:
        return "text";
    case KEY_FILE:
        return "file name, as seen from the folder of the file it stands in";
    case KEY_POINT:
        return k->dimension == KEY_LENGTH ? "[x, y], two lengths" : "[x, y], two numbers";
    case KEY_POINTS:
        return "list of 2 to 10000 points [x, y], in lengths";
    case KEY_PLACES:
        return "list of 1 to 64 places [x, y, z], in lengths";
    case KEY_RANGE:
        return k->dimension == KEY_FORCE ? "[least, most], two forces" : "[least, most], two frequencies";
    case KEY_LIST:
        return "list of names";
    case KEY_CHOICE:
        return "one of the words below";
    }
    return "";
}

const char *keys_text_range(const struct key *k, struct arena *a)
{
    if (k->low == 0 && k->high == 0) return NULL;
    if (k->low == k->high) return arena_format(a, "only %s", units_text(k->low, k->dimension, a));
    return arena_format(a, "%s to %s", units_text(k->low, k->dimension, a), units_text(k->high, k->dimension, a));
}

/* "4 um", "must be given", "not given" */
static const char *default_text(const struct key *k)
{
    return !k->standard ? "must be given" : *k->standard ? k->standard : "not given";
}

const char *keys_text_words(const struct key *k, struct arena *a)
{
    const char *all = "", *words = keys_words(k);
    for (size_t n = strcspn(words, "|"); *words; words += n + !!words[n], n = strcspn(words, "|"))
        all = arena_format(a, "%s%s%.*s", all, !*all ? "" : words[n] ? ", " : " or ", (int)n, words);
    return all;
}

const char *keys_text_applies(const struct key *k, struct arena *a)
{
    const char *words = keys_words(k);
    if (!k->applies) return NULL;
    if (words) return arena_format(a, "where %s is %s", keys_decider(k)->path, keys_text_words(k, a));
    return keys_applies_beside(k, true) ? arena_format(a, "beside %s", k->applies)
                                        : arena_format(a, "where %s is not given", keys_decider(k)->path);
}

const char *keys_text_rivals_apply(const struct key_alternative *t, struct arena *a)
{
    const struct key condition = keys_condition(t);
    return t->applies ? arena_format(a, " %s", keys_text_applies(&condition, a)) : "";
}

const char *keys_text_rivals(const struct key_alternative *t, struct arena *a)
{
    const char *all = t->most > 1 ? "at least one of" : t->least ? "exactly one of" : "at most one of";
    for (int i = 0; t->paths[i]; i++)
        all = arena_format(a, "%s%s %s", all, i ? "," : "", t->paths[i]);
    return all;
}

/* Is `path` the map `map`, or in it? */
static bool within(const char *path, const char *map)
{
    size_t n = strlen(map);
    return !strncmp(path, map, n) && (path[n] == '.' || !path[n]);
}

/* Is it one of them, or excluded as a part of one? */
static bool has(const struct key_alternative *t, const char *path)
{
    for (int i = 0; t->paths[i]; i++)
        if (t->most > 1 ? strcmp(path, t->paths[i]) == 0 : within(path, t->paths[i])) return true;
    return false;
}

/* ------------------------------------------------------------------ names */

struct names {
    const char **all;
    int n;
};

static void add(struct names *names, const char *path)
{
    for (int i = 0; i < names->n; i++)
        if (!strcmp(names->all[i], path)) return;
    names->all[names->n++] = path;
}

static void add_with_maps(struct names *names, const char *path, struct arena *a)
{
    for (const char *dot = strchr(path, '.'); dot; dot = strchr(dot + 1, '.'))
        add(names, arena_format(a, "%.*s", (int)(dot - path), path));
    add(names, path);
}

const char **keys_text_names(struct arena *a)
{
    size_t room = 1;
    for (const struct key *k = keys_table; k->path; k++)
        room += 4;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        room++;
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        room += 2;
    struct names names = {ARENA_TAKE(a, const char *, room), 0};
    for (const struct key *k = keys_table; k->path; k++)
        add_with_maps(&names, k->path, a);
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        add_with_maps(&names, p->path, a);
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        add(&names, arena_format(a, "accuracy.%s", k->name));
    return names.all;
}

const char *keys_text_plain(const char *path)
{
    if (strncmp(path, "contacts.", 9) != 0) return path;
    const char *rest = path + 9, *dot = strchr(rest, '.');
    for (const struct key *k = keys_table; k->path; k++)
        if (k->of == KEY_CONTACT && within(k->path, rest)) return rest;
    return dot ? dot + 1 : rest;
}

/* ------------------------------------------------------------------ `rasp explain KEY` */

#define MARGIN "            "

static void print_fact(FILE *f, const char *name, const char *text)
{
    if (!text) return;
    fprintf(f, "  %-10s", name);
    text_wrap(f, text, 12, MARGIN);
}

static void print_choose(FILE *f, const char *path, struct arena *a)
{
    for (const struct key_alternative *t = keys_alternatives; t->paths[0]; t++)
        if (has(t, path))
            print_fact(f, "choose", arena_format(a, "%s%s", keys_text_rivals(t, a), keys_text_rivals_apply(t, a)));
}

void keys_text_print_key(FILE *f, const struct key *k, struct arena *a)
{
    int n = fprintf(f, "%s: ", k->path);
    text_wrap(f, k->meaning, n, MARGIN);
    print_fact(f, "type", keys_text_type(k, a));
    print_fact(f, "range", keys_text_range(k, a));
    print_fact(f, "default", default_text(k));
    print_fact(f, "applies", keys_text_applies(k, a));
    print_choose(f, k->path, a);
    print_fact(f, "belongs",
               k->of == KEY_SCENE ? "to the scene" : "to a contact: at the top level, or in each entry of contacts");
    if (k->choices) fputs("  words\n", f);
    for (const struct choice *c = k->choices; c && c->word; c++) {
        int wide = fprintf(f, "    %-16s", c->word);
        text_wrap(f, c->meaning, wide, "                    ");
    }
}

void keys_text_print_map(FILE *f, const char *path, struct arena *a)
{
    const char *meaning = NULL, *type = NULL;
    for (const struct keys_text_frame *p = keys_text_frames; p->path; p++)
        if (!strcmp(p->path, path)) meaning = p->meaning, type = p->type;
    for (const struct key_section *s = keys_sections; s->path; s++)
        if (!strcmp(s->path, path)) meaning = s->meaning;
    size_t length = strlen(path);
    fprintf(f, "%s%s", path, meaning ? ": " : "\n");
    if (meaning) text_wrap(f, meaning, (int)length + 2, MARGIN);
    if (type) print_fact(f, "type", type);
    print_choose(f, path, a);
    for (const struct key *k = keys_table; k->path; k++) {
        if (strncmp(k->path, path, length) != 0 || k->path[length] != '.') continue;
        int n = fprintf(f, "  %-33s ", k->path);
        text_wrap(f, arena_format(a, "%s (%s)", k->meaning, default_text(k)), n,
                  "                                    ");
    }
}

/* What stands above the knobs of presets. */
static const char presets_text[] =
    "draft, standard and high aim at -40, -70 and -100 dB, and each scene gets the knobs that it needs for that (rasp "
    "plan); these are the knobs of reference, and of the others for coupled balls, of which at most contact_steps is "
    "chosen:";

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
    text_wrap(f, k->meaning, n, MARGIN);
    print_fact(f, "type", k->whole ? "whole number" : "number");
    print_fact(f, "range", arena_format(a, "%.6g to %.6g", k->low, k->high));
    print_fact(f, "presets", presets_text);
    print_preset_names(f, 9);
    fprintf(f, "  %-9s", "");
    print_presets(f, k, a);
}

void keys_text_print_accuracy(FILE *f, struct arena *a)
{
    keys_text_print_map(f, "accuracy", a);
    print_fact(f, "presets", presets_text);
    print_preset_names(f, 16);
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        fprintf(f, "  %-16s", k->name);
        print_presets(f, k, a);
    }
    for (const struct key_knob *k = keys_knobs; k->name; k++) {
        int n = fprintf(f, "  %-16s  ", k->name);
        text_wrap(f, k->meaning, n, "                    ");
    }
}

/* ------------------------------------------------------------------ man rasp-scene(5) */

/* One .Ss for the scene's own keys and one for each top-level map; a sentence begins a line, as mdoc asks for. */

/* Text with roff's own characters made harmless, and a full stop. */
static void put_sentence(FILE *f, const char *text)
{
    if (*text == '.' || *text == '\'') fputs("\\&", f);
    for (const char *s = text; *s; s++)
        if (*s == '\\')
            fputs("\\e", f);
        else if (*s == '-')
            fputs("\\-", f);
        else if (*s == '^')
            fputs("\\(ha", f);
        else
            fputc(s > text && text_ends_sentence(text, s - 1) ? '\n' : *s, f);
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
        put_sentence(f, arena_format(a, "Type: %s", keys_text_type(k, a)));
    if (range) put_sentence(f, arena_format(a, "Range: %s", range));
    put_sentence(f, arena_format(a, "Default: %s", k->standard ? default_text(k) : "none, it must be given"));
    if (when) put_opening(f, arena_format(a, "only %s", when), a);
    put_rivals(f, k->path, a);
    if (!k->choices || keys_same_words(k)) return;
    fputs(".Bl -tag -width Ds -compact\n", f);
    for (const struct choice *c = k->choices; c->word; c++) {
        fprintf(f, ".It Cm %s\n", c->word);
        put_sentence(f, c->meaning);
    }
    fputs(".El\n", f);
}

static void put_group(FILE *f, const char *map, struct arena *a)
{
    fprintf(f, ".Ss %s\n.Bl -tag -width Ds\n", *map ? map : "The scene itself");
    for (const struct key *k = keys_table; k->path; k++) {
        size_t top = strcspn(k->path, ".");
        if (k->path[top] ? strlen(map) != top || strncmp(k->path, map, top) != 0 : *map) continue;
        for (const struct key_section *s = keys_sections; s->path; s++) {
            bool first = within(k->path, s->path) && (k == keys_table || !within(k[-1].path, s->path));
            if (!first) continue;
            fprintf(f, ".It Ic %s\n", s->path);
            put_opening(f, arena_format(a, "Section: %s", s->meaning), a);
            put_rivals(f, s->path, a);
        }
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
    fputs(
        ".Ss accuracy\nThe knobs of\n.Ic accuracy : reference ,\nand of the other presets where none are chosen "
        "(ACCURACY "
        "BY AN ERROR):\n.Bl -column \"oversampling\" \"draft\" \"standard\" \"high\" \"reference\"\n.It knob Ta draft "
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

void keys_text_man(FILE *f, struct arena *a)
{
    put_group(f, "", a);
    for (const struct key *k = keys_table; k->path; k++) {
        size_t n = strcspn(k->path, ".");
        bool first = k->path[n] && (k == keys_table || strncmp(k[-1].path, k->path, n + 1) != 0);
        if (first) put_group(f, arena_format(a, "%.*s", (int)n, k->path), a);
    }
    put_knobs(f, a);
}

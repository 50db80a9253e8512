/* See keys_text.h: the phrases. keys_text_print.c lays them out. */
#include "scene/keys_text.h"

#include <string.h>

#include "scene/units.h"

const struct keys_text_frame keys_text_frames[] = {
    {"include", "list of file names",
     "scene files that this one builds on: maps merge, lists are replaced, the including file wins"},
    {"contacts", "list of contacts",
     "several contacts, whose sounds add up: each entry holds a name and what else stands at the top level of a "
     "scene with one (surface, scraper, motion, ...)"},
    {"accuracy", "draft, standard, high, reference, or a map",
     "how much time is spent on accuracy: a preset, or a map of preset, error and single knobs"},
    {"accuracy.error", "number, dB, -240 to below 0",
     "error relative to the sound, rms, that the knobs not given are chosen by, as cheaply as keeps it; what cannot be "
     "kept is refused"},
    {"accuracy.preset", "draft, standard, high or reference",
     "in a map: the preset that the knobs not given are taken from"},
    {"inputs", "list of file and sha256",
     "the files of an effective scene as they were: one that has changed is an error"},
    {NULL, NULL, NULL},
};

static const struct {
    const char *unit, *type;
} dimensions[] = {
    [KEY_NONE] = {"", "number"},
    [KEY_LENGTH] = {"m", "length (a bare number is in m)"},
    [KEY_TIME] = {"s", "time (a bare number is in s)"},
    [KEY_FREQUENCY] = {"Hz", "frequency (a bare number is in Hz)"},
    [KEY_MASS] = {"kg", "mass (a bare number is in kg)"},
    [KEY_FORCE] = {"N", "force (a bare number is in N)"},
    [KEY_SPEED] = {"m/s", "speed (a bare number is in m/s)"},
    [KEY_ACCELERATION] = {"m/s^2", "acceleration (a bare number is in m/s^2)"},
    [KEY_ANGLE] = {"rad", "angle (a bare number is in rad)"},
    [KEY_PER_AREA] = {"/m^2", "number per area (a bare number is per m^2)"},
    [KEY_DECIBEL] = {"dB", "level (a bare number is in dB)"},
    [KEY_LUFS] = {"LUFS", "loudness (a bare number is in LUFS)"},
    [KEY_FORCE_COEFFICIENT] = {"N (s/m)^beta2", "force coefficient (a bare number is in N (s/m)^beta2)"},
    [KEY_OUTPUT] = {"", "length, speed, acceleration, pressure or force, as it is heard (a bare number is SI)"},
    [KEY_PRESSURE] = {"Pa", "pressure or modulus (a bare number is in Pa)"},
    [KEY_DENSITY] = {"kg/m^3", "density (a bare number is in kg/m^3)"},
    [KEY_FORCE_PER_LENGTH] = {"N/m", "force per length (a bare number is in N/m)"},
    [KEY_PER_TIME] = {"1/s", "rate (a bare number is per second)"},
    [KEY_STIFFNESS] = {"", "stiffness (a bare number is SI: N/m, or N/m^1.5)"},
    [KEY_STIFFNESS_PER_MASS] = {"N/(m^1.5 kg)", "stiffness per mass (a bare number is in N/(m^1.5 kg))"},
    [KEY_PER_SPEED] = {"s/m", "number per speed (a bare number is in s/m)"},
    [KEY_DISSIPATION] = {"N s/m^2.5", "dissipation (a bare number is in N s/m^2.5)"},
};

const char *keys_text_unit(enum key_dimension d) { return dimensions[d].unit; }

const char *keys_text_type(const struct key *k)
{
    switch (k->type) {
    case KEY_NUMBER:
        return dimensions[k->dimension].type;
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

const char *keys_text_default(const struct key *k)
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

bool keys_text_has(const struct key_alternative *t, const char *path)
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

static bool is_known(const char *path)
{
    for (const struct key *k = keys_table; k->path; k++)
        if (k->of == KEY_CONTACT && within(k->path, path)) return true;
    return false;
}

const char *keys_text_plain(const char *path)
{
    if (strncmp(path, "contacts.", 9) != 0) return path;
    const char *rest = path + 9, *dot = strchr(rest, '.');
    return is_known(rest) || !dot ? rest : dot + 1;
}

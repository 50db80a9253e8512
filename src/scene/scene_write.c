/* The effective scene, from the rows of keys.def and accuracy.def: SI bare numbers that read back to the last bit,
   strings quoted. A key is left out when it does not apply, or when it may be left out, is not given, and nothing is
   done instead. One contact is written at the top level, several as a list. */
#include "scene/scene_write.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/relpath.h"
#include "scene/keys.h"
#include "scene/keys_yaml.h"
#include "scene/rules.h"
#include "scene/scene_write_inputs.h"

struct writer {
    FILE *f;
    const char *beside;
    struct arena *a;
    struct keys_line *lines; /* room for one owner's keys */
    int n;
    bool sounds; /* some contact is heard */
};

static const void *field(const struct key *k, const void *owner) { return keys_field(k, owner); }

static double number(const struct key *k, const void *owner) { return *(const double *)field(k, owner); }

static const char *text(const struct key *k, const void *owner) { return *(const char *const *)field(k, owner); }

static const char *word(const struct key *k, const void *owner)
{
    return k->choices[*(const int *)field(k, owner)].word;
}

static const char *numbers_value(const double *x, int n, struct arena *a)
{
    const char *all = "";
    for (int i = 0; i < n; i++)
        all = arena_format(a, "%s%s%s", all, i ? ", " : "", keys_yaml_number(x[i], a));
    return arena_format(a, "[%s]", all);
}

static const char *pair_value(const double *x, struct arena *a) { return isnan(x[0]) ? NULL : numbers_value(x, 2, a); }

static const char *points_value(const void *field, int width, struct arena *a)
{
    const double *at = *(const double *const *)field;
    char *memory = NULL;
    size_t size = 0;
    if (!at) return NULL;
    FILE *f = memory_stream(&memory, &size);
    for (int i = 0; i < *keys_points_count(field); i++)
        fprintf(f, "%s%s", i ? ", " : "[", numbers_value(at + width * i, width, a));
    fputc(']', f);
    memory_stream_end(f, &memory);
    const char *copy = arena_text(a, memory);
    free(memory);
    return copy;
}

static const char *list_value(const char *const *items, struct arena *a)
{
    const char *all = "";
    if (!items) return NULL;
    for (int i = 0; items[i]; i++)
        all = arena_format(a, "%s%s%s", all, i ? ", " : "", keys_yaml_quoted(items[i], a));
    return arena_format(a, "[%s]", all);
}

static const char *text_value(const struct key *k, const void *owner, struct writer *w)
{
    const char *s = text(k, owner);
    if (!s) return NULL;
    return keys_yaml_quoted(k->type == KEY_FILE ? relpath_make(s, w->beside, w->a) : s, w->a);
}

/* Is the key or section of that path given? */
static bool given(const char *path, const void *owner)
{
    const struct key *k = keys_find(path);
    for (const struct key_section *s = keys_sections; !k && s->path; s++)
        if (!strcmp(s->path, path)) return *keys_given(s, owner);
    return k && (k->type == KEY_FILE ? text(k, owner) != NULL : !isnan(number(k, owner)));
}

static bool is_among(const struct key *k, const struct key_alternative *all)
{
    for (int i = 0; all->paths[i]; i++)
        if (!strcmp(all->paths[i], k->path)) return true;
    return false;
}

/* Is one of those given of which the key is an alternative? They have the same owner. */
static bool alternative_given(const struct key *k, const void *owner)
{
    for (const struct key_alternative *all = keys_alternatives; all->paths[0]; all++)
        for (int i = 0; is_among(k, all) && all->paths[i]; i++)
            if (given(all->paths[i], owner)) return true;
    return false;
}

/* Two defaults are no values of their key but what is done when no alternative is given: the scraper's weight as the
   load (a weight beyond the key's range cannot be written, and stays unsaid), and the level of what sounds. NAN:
   neither. */
static double unsaid(const struct key *k, const void *owner, const struct writer *w)
{
    const struct contact *c = owner;
    bool load = !strcmp(k->path, "load.constant"), peak = !strcmp(k->path, "output.level.peak") && w->sounds;
    if ((!load && !peak) || alternative_given(k, owner)) return NAN;
    double x = load ? rules_weight(c) : RULES_PEAK;
    return x >= k->low && x <= k->high ? x : NAN;
}

static const char *number_value(const struct key *k, const void *owner, struct writer *w)
{
    double x = isnan(number(k, owner)) ? unsaid(k, owner, w) : number(k, owner);
    return isnan(x) ? NULL : keys_yaml_number(x, w->a);
}

/* YAML text of the key's value; NULL: not given. */
static const char *value(const struct key *k, const void *owner, struct writer *w)
{
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
        return number_value(k, owner, w);
    case KEY_TIME_OR_AUTO:
        return isnan(number(k, owner)) ? "auto" : keys_yaml_number(number(k, owner), w->a);
    case KEY_COUNT:
        return arena_format(w->a, "%d", *(const int *)field(k, owner));
    case KEY_SEED:
        return arena_format(w->a, "%" PRIu64, *(const uint64_t *)field(k, owner));
    case KEY_TEXT:
    case KEY_FILE:
        return text_value(k, owner, w);
    case KEY_POINT:
    case KEY_RANGE:
        return pair_value(field(k, owner), w->a);
    case KEY_POINTS:
    case KEY_PLACES:
        return points_value(field(k, owner), keys_points_width(k), w->a);
    case KEY_LIST:
        return list_value(*(const char **const *)field(k, owner), w->a);
    case KEY_CHOICE:
        return word(k, owner);
    }
    return NULL;
}

static bool applies(const struct key *k, const void *owner)
{
    const struct key *decides = keys_decider(k);
    if (!decides) return true;
    if (keys_words(k)) return applies(decides, owner) && keys_applies_with(k, word(decides, owner));
    bool there = decides->type == KEY_FILE ? text(decides, owner) != NULL : !isnan(number(decides, owner));
    return applies(decides, owner) &&
           keys_applies_beside(k, there); /* a ball's radius stands where a scraper's would */
}

/* Is every section that the key stands in given? */
static bool in_given_sections(const struct key *k, const void *owner)
{
    for (const struct key_section *s = keys_sections; s->path; s++) {
        size_t n = strlen(s->path);
        if (!strncmp(k->path, s->path, n) && k->path[n] == '.' && !*keys_given(s, owner)) return false;
    }
    return true;
}

static void take(struct writer *w, const struct key *k, const void *owner)
{
    const char *v =
        !scene_write_inputs_only(k) && applies(k, owner) && in_given_sections(k, owner) ? value(k, owner, w) : NULL;
    if (v) w->lines[w->n++] = (struct keys_line){.path = k->path, .value = v};
}

static void flush(struct writer *w, int indent, bool item)
{
    keys_yaml_print(w->f, w->lines, w->n, &(struct keys_style){.indent = indent, .item = item});
    w->n = 0;
}

static void write_contacts(struct writer *w, const struct scene *s)
{
    bool list = s->n_contacts > 1;
    if (list) fputs("contacts:\n", w->f);
    for (int i = 0; i < s->n_contacts; i++) {
        const struct contact *c = &s->contacts[i];
        for (const struct key *k = keys_table; k->path; k++)
            if (k->of == KEY_CONTACT) take(w, k, c);
        flush(w, list ? 4 : 0, list);
    }
}

/* The scene's keys in table order, the contacts where the first of their keys stands. */
static void write_keys(struct writer *w, const struct scene *s)
{
    bool contacts = false;
    for (const struct key *k = keys_table; k->path; k++) {
        if (k->of == KEY_SCENE) {
            take(w, k, s);
        } else if (!contacts) {
            flush(w, 0, false);
            write_contacts(w, s);
            contacts = true;
        }
    }
    flush(w, 0, false);
}

static void write_accuracy(struct writer *w, const struct scene *s)
{
    fputs("accuracy:\n", w->f);
    if (s->accuracy.preset) fprintf(w->f, "  preset: %s\n", s->accuracy.preset);
    if (!isnan(s->accuracy.error)) fprintf(w->f, "  error: %s\n", keys_yaml_number(s->accuracy.error, w->a));
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        fprintf(w->f, "  %s: %s\n", k->name,
                keys_yaml_number(*(const double *)((const char *)&s->accuracy + k->offset), w->a));
}

const char *scene_write(const struct scene *s, const char *beside, struct arena *a)
{
    char *memory = NULL;
    size_t size = 0;
    int n_keys = 0;
    while (keys_table[n_keys].path)
        n_keys++;
    struct writer w = {memory_stream(&memory, &size), beside, a, ARENA_TAKE(a, struct keys_line, n_keys), 0, false};
    for (int i = 0; i < s->n_contacts; i++)
        w.sounds = w.sounds || (s->contacts[i].gain != 0 && rules_audible(&s->contacts[i], &s->output));
    write_keys(&w, s);
    write_accuracy(&w, s);
    scene_write_inputs(w.f, s, beside, a);
    memory_stream_end(w.f, &memory);
    const char *copy = arena_text(a, memory);
    free(memory);
    return copy;
}

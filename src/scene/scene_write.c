/* The effective scene, from the tables of keys and of knobs: SI bare numbers that read back to the last bit,
   strings quoted. A key is left out when it does not apply, or when it may be left out, is not given, and nothing is
   done instead. One contact is written at the top level, several as a list. */
#include "scene/scene_write.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/file_cache.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "base/version.h"
#include "file/csv.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/keys_yaml.h"
#include "scene/params.h"
#include "scene/scene_materials.h"

/* ------------------------------------------------------------------ inputs */

/* `inputs` names every file of the scene once, with its sha256 as it is now: those of its keys (of a folder of
   responses its index.csv and the files that this names, by name), and those that it has pinned besides (such as the
   recipe that an effective scene was made with). An effective scene has them in the same order again. */

struct list {
    const struct scene *scene;
    struct arena *arena;
    const char **files;
    int n;
};

/* A file that is listed here, and not written as a key: a recipe, whose keys are written among the scene's own. */
static bool inputs_only(const struct key *k) { return strcmp(k->path, "surface.recipe") == 0; }

static void add(struct list *l, const char *file)
{
    for (int i = 0; i < l->n; i++)
        if (!strcmp(l->files[i], file)) return;
    l->files = arena_more(l->arena, l->files, l->n, sizeof *l->files);
    l->files[l->n++] = file;
}

static void add_keys(struct list *l, bool only)
{
    for (int i = 0; i < l->scene->n_contacts; i++)
        for (const struct key *k = keys_table; k->path; k++) {
            bool mine = k->of == KEY_CONTACT && k->type == KEY_FILE && inputs_only(k) == only;
            const char *file = mine ? *(const char *const *)keys_field(k, &l->scene->contacts[i]) : NULL;
            int n = 0; /* files that are read of it, where it is a folder */
            const char **files = file ? csv_folder_files(file, &n, l->arena) : NULL;
            if (file && n == 0) add(l, file);
            for (int m = 0; m < n; m++)
                add(l, files[m]);
        }
}

const char **scene_write_inputs(const struct scene *s, int *n, struct arena *a)
{
    struct list l = {s, a, NULL, 0};
    if (!s->inputs_known) {
        add_keys(&l, false);
        add_keys(&l, true);
    }
    for (int i = 0; i < s->n_inputs; i++)
        if (s->inputs[i].file) add(&l, s->inputs[i].file);
    *n = l.n;
    return l.files;
}

/* A file that cannot be read keeps the hash it was pinned to; without one it is listed unpinned, with a remark. */
static void inputs_write(FILE *f, const struct scene *s, const char *beside, struct arena *a)
{
    int n;
    const char **files = scene_write_inputs(s, &n, a);
    if (n) fputs("inputs:\n", f);
    for (int i = 0; i < n; i++) {
        struct err unreadable = {0};
        const char *sha256 = s->inputs_known ? NULL : file_cache_sha256(s->file_cache, files[i], a, &unreadable);
        for (int k = 0; k < s->n_inputs && !sha256; k++)
            if (s->inputs[k].sha256 && !strcmp(s->inputs[k].file, files[i])) sha256 = s->inputs[k].sha256;
        fprintf(f, "  - file: %s\n", keys_yaml_quoted(relpath_make(files[i], beside, a), a));
        if (sha256)
            fprintf(f, "    sha256: \"%s\"\n", sha256);
        else
            fputs("    # could not be read when this was written\n", f);
    }
}

/* ------------------------------------------------------------------ keys */

struct writer {
    FILE *f;
    const char *beside;
    struct arena *a;
    struct keys_line *lines; /* room for one owner's keys */
    int n;
};

static double number(const struct key *k, const void *owner) { return *(const double *)keys_field(k, owner); }

static const char *text(const struct key *k, const void *owner) { return *(const char *const *)keys_field(k, owner); }

static const char *word(const struct key *k, const void *owner)
{
    const char *own = k->of == KEY_CONTACT ? scene_materials_name(k, owner) : NULL;
    if (own) return own;
    return k->choices[*(const int *)keys_field(k, owner)].word;
}

static const char *numbers_value(const double *x, int n, struct arena *a)
{
    const char *all = "";
    for (int i = 0; i < n; i++)
        all = arena_format(a, "%s%s%s", all, i ? ", " : "", keys_yaml_number(x[i], a));
    return arena_format(a, "[%s]", all);
}

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

/* Is the key or section of that path given? */
static bool given(const char *path, const void *owner)
{
    const struct key *k = keys_find(path);
    for (const struct key_section *s = keys_sections; !k && s->path; s++)
        if (!strcmp(s->path, path)) return *keys_given(s, owner);
    return k && (k->type == KEY_FILE ? text(k, owner) != NULL : !isnan(number(k, owner)));
}

/* Is one of those given of which the key is an alternative? They have the same owner. */
static bool alternative_given(const struct key *k, const void *owner)
{
    for (const struct key_alternative *all = keys_alternatives; all->paths[0]; all++) {
        bool among = false, some = false;
        for (int i = 0; all->paths[i]; i++)
            among = among || !strcmp(all->paths[i], k->path);
        for (int i = 0; among && all->paths[i]; i++)
            some = some || given(all->paths[i], owner);
        if (some) return true;
    }
    return false;
}

/* A default that is no value of its key but what is done when no alternative is given, such as the scraper's weight as
   the load; NAN: there is none, or it is beyond the key's range and cannot be written. */
static double instead(const struct key *k, const void *owner)
{
    const struct params *own;
    if (alternative_given(k, owner)) return NAN;
    for (int i = 0; (own = stages_params(i)); i++) {
        double x = own->instead ? own->instead(k, owner) : NAN;
        if (x >= k->low && x <= k->high) return x;
    }
    return NAN;
}

/* YAML text of the key's value; NULL: not given. */
static const char *value(const struct key *k, const void *owner, struct writer *w)
{
    const char *const *items, *all = "";
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE: {
        double x = isnan(number(k, owner)) ? instead(k, owner) : number(k, owner);
        return isnan(x) ? NULL : keys_yaml_number(x, w->a);
    }
    case KEY_TIME_OR_AUTO:
        return isnan(number(k, owner)) ? "auto" : keys_yaml_number(number(k, owner), w->a);
    case KEY_COUNT:
        return arena_format(w->a, "%d", *(const int *)keys_field(k, owner));
    case KEY_SEED:
        return arena_format(w->a, "%" PRIu64, *(const uint64_t *)keys_field(k, owner));
    case KEY_TEXT:
    case KEY_FILE: {
        const char *s = text(k, owner);
        return s ? keys_yaml_quoted(k->type == KEY_FILE ? relpath_make(s, w->beside, w->a) : s, w->a) : NULL;
    }
    case KEY_POINT:
    case KEY_RANGE:
        return isnan(number(k, owner)) ? NULL : numbers_value(keys_field(k, owner), 2, w->a);
    case KEY_POINTS:
    case KEY_PLACES:
        return points_value(keys_field(k, owner), keys_points_width(k), w->a);
    case KEY_LIST:
        items = *(const char **const *)keys_field(k, owner);
        for (int i = 0; items && items[i]; i++)
            all = arena_format(w->a, "%s%s%s", all, i ? ", " : "[", keys_yaml_quoted(items[i], w->a));
        return items ? arena_format(w->a, "%s]", all) : NULL;
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

static void take(struct writer *w, const struct key *k, const void *owner)
{
    if (inputs_only(k) || !applies(k, owner)) return;
    for (const struct key_section *s = keys_sections; s->path; s++) { /* all that it stands in must be given */
        size_t n = strlen(s->path);
        if (!strncmp(k->path, s->path, n) && k->path[n] == '.' && !*keys_given(s, owner)) return;
    }
    const char *v = value(k, owner, w);
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

const char *scene_write(const struct scene *given, const char *beside, struct arena *a)
{
    struct scene own = *given, *s = &own;
    char *memory = NULL;
    size_t size = 0;
    int n_keys = 0;
    own.written_by = "rasp " VERSION;
    while (keys_table[n_keys].path)
        n_keys++;
    struct writer w = {memory_stream(&memory, &size), beside, a, ARENA_TAKE(a, struct keys_line, n_keys), 0};
    bool contacts = false; /* they stand where the first of their keys does */
    for (const struct key *k = keys_table; k->path; k++)
        if (k->of == KEY_SCENE)
            take(&w, k, s);
        else if (!contacts) {
            flush(&w, 0, false);
            write_contacts(&w, s);
            contacts = true;
        }
    flush(&w, 0, false);
    fputs("accuracy:\n", w.f);
    if (s->accuracy.preset) fprintf(w.f, "  preset: %s\n", s->accuracy.preset);
    if (!isnan(s->accuracy.error)) fprintf(w.f, "  error: %s\n", keys_yaml_number(s->accuracy.error, a));
    bool fixed = isnan(s->accuracy.error) && isnan(accuracy_target(&s->accuracy));
    for (int k = 0; k < KNOBS; k++) /* those still to be chosen are not written */
        if (fixed || s->accuracy.by_user & 1u << k)
            fprintf(w.f, "  %s: %s\n", keys_knobs[k].name,
                    keys_yaml_number(accuracy_knob(&s->accuracy, (enum knob)k), a));
    scene_materials_write(w.f, s, a);
    inputs_write(w.f, s, beside, a);
    memory_stream_end(w.f, &memory);
    const char *copy = arena_text(a, memory);
    free(memory);
    return copy;
}

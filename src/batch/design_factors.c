/* `base`, `set` and `factors` of a design. A factor that is named by a key of scenes has values of that key as levels,
   or maps; any other has maps alone.

   What a level, or `set`, changes of a scene are keys and values. A value is read here into a struct that nobody looks
   at, so that what is wrong with it is reported once, with the design's line, and not for each of the scenes that it is
   laid over.

   Columns of the manifest are called lower_snake with the unit at the end (motion_rate_hz, speed_cm_per_s), as tables
   are read by programs that take no other: PsychoPy, R, BIDS. A factor whose labels are all quantities of one dimension
   has numbers: in the unit that they are written with where it is the same for all, else in SI. */
#include "batch/design_reading.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/relpath.h"
#include "base/text.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/params.h"
#include "scene/scene_merge.h"
#include "scene/scene_values.h"
#include "scene/units.h"

/* ------------------------------------------------------------------ what is changed */

static const struct key *design_changes_key(const char *path) { return keys_find(keys_text_plain(path)); }

/* ------------------------------------------------------------------ paths */

static const char *design_changes_near(const struct design_reading *r, const char *word)
{
    const char *found = NULL;
    for (const char *const *name = r->keys; *name; name++) {
        const char *dot = strrchr(*name, '.');
        if (dot && strcmp(dot + 1, word) == 0) found = found ? arena_format(r->arena, "%s or %s", found, *name) : *name;
    }
    const char *near = text_nearest(word, r->keys), *own = strrchr(word, '.'), *last = near ? strrchr(near, '.') : NULL;
    if (own && last && !text_nearest(own + 1, (const char *const[]){last + 1, NULL}))
        near = NULL; /* .tempo is no .to */
    return found ? found : near;
}

static bool design_changes_known(const struct design_reading *r, const struct yaml_node *key)
{
    const char *plain = keys_text_plain(key->text);
    if (text_is_one(plain, r->keys)) return true;
    const char *near = design_changes_near(r, plain);
    return diag_add(r->yaml->diag, key->at,
                    near ? arena_format(r->arena, "did you mean %s?", near) : "rasp explain lists every key of a scene",
                    "'%s' is no key of scenes", diag_shown(r->yaml->diag, key->text));
}

static bool starts(const char *path, const char *map)
{
    size_t n = strlen(map);
    return strncmp(path, map, n) == 0 && (!path[n] || path[n] == '.');
}

/* Keys that are the design's to say. */
static bool reserved(const struct design_reading *r, const struct yaml_node *key)
{
    const char *cure = NULL;
    const struct design *d = r->design;
    if (strcmp(key->text, "seed") == 0)
        cure = "write seed: at the design's top level: each stimulus's seed is made from it; replicates: gives several";
    else if (strcmp(key->text, "include") == 0)
        cure = "write include: into the base scene";
    else if (strcmp(key->text, "rasp") == 0)
        cure = "remove it";
    else if (starts(key->text, "output.level") && d->level_rule != DESIGN_LEVEL_SCENE)
        cure = "the design has one level rule for the set (level:, by default {common: {peak: -3 dB}}); write level: "
               "scene to set levels here";
    else if (starts(key->text, "output.duration") && d->length_rule != DESIGN_LENGTH_OWN)
        cure = "the design has one length rule for the set (length:, by default longest); write length: own to set "
               "durations here";
    bool reported = false; /* a factor's key is looked at for each of its levels */
    for (int i = 0; i < r->yaml->diag->n && i < DIAG_STORED; i++) {
        const struct diag_place *at = &r->yaml->diag->errors[i].at;
        reported =
            reported || (at->source == key->at.source && at->line == key->at.line && at->column == key->at.column);
    }
    if (cure && !reported) diag_add(r->yaml->diag, key->at, cure, "%s cannot be set here", key->text);
    return cure;
}

/* ------------------------------------------------------------------ values */

bool design_factors_key(const struct design_reading *r, const struct yaml_node *key)
{
    return !reserved(r, key) && design_changes_known(r, key);
}

bool design_factors_value(const struct design_reading *r, const struct yaml_node *key, const struct yaml_node *value)
{
    const struct key *k = design_changes_key(key->text);
    if (!k || yaml_null(value)) return true;
    struct arena *own = arena_open(); /* some kilobytes, for each of perhaps thousands of levels */
    void *to = k->of == KEY_CONTACT ? (void *)params_contacts(own, 1) : ARENA_TAKE(own, struct scene, 1);
    int n = (int)(keys_text_plain(key->text) - key->text); /* "contacts.rod." */
    struct scene_part part = {r->yaml, r->root, arena_format(own, "%.*s", n, key->text), k->of, to, NULL};
    bool good = scene_values_read(&part, k, value);
    arena_close(own);
    return good;
}

static bool leaf_add(const struct design_reading *r, struct design_change *c, const struct yaml_node *key,
                     const struct yaml_node *value)
{
    if (!design_factors_key(r, key) || !design_factors_value(r, key, value)) return false;
    struct yaml_node **path = scene_merge_layer_path(r->yaml, key);
    if (!path) return false;
    c->keys = arena_more(r->arena, c->keys, c->n, sizeof *c->keys);
    c->keys[c->n++] = (struct scene_layer_key){path, value};
    return true;
}

static bool design_changes_add(const struct design_reading *r, struct design_change *c, const struct yaml_node *key,
                               const struct yaml_node *value)
{
    bool good = true;
    if (value->kind != YAML_MAP || value->n == 0) return leaf_add(r, c, key, value);
    for (const struct yaml_node *item = value->first; item; item = item->next) {
        struct yaml_node *path =
            yaml_make(r->yaml, YAML_SCALAR, item->key->at, arena_format(r->arena, "%s.%s", key->text, item->key->text));
        path->plain = false; /* its place is that of the last part */
        good = design_changes_add(r, c, path, item) && good;
    }
    return good;
}

static bool design_changes_map(const struct design_reading *r, struct design_change *c, const struct yaml_node *map)
{
    bool good = true;
    if (map->kind != YAML_MAP)
        return design_reading_must(r, map, "set", "a map of keys of a scene",
                                   "write for instance: set: {motion.rate: 2 Hz}");
    for (const struct yaml_node *item = map->first; item; item = item->next)
        good = design_changes_add(r, c, item->key, item) && good;
    return good;
}

/* ------------------------------------------------------------------ texts */

static const char *scalar_text(const struct yaml_node *node, bool alone, struct arena *a)
{
    static const char safe[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./+-^() ";
    bool plain = *node->text && node->plain &&
                 (alone ? !strchr("[{\"'", node->text[0]) : node->text[strspn(node->text, safe)] == '\0');
    return plain ? node->text : keys_yaml_quoted(node->text, a);
}

static void put_text(FILE *f, const struct yaml_node *node, bool alone, struct arena *a)
{
    if (node->kind == YAML_SCALAR) {
        fputs(scalar_text(node, alone, a), f);
        return;
    }
    fputc(node->kind == YAML_MAP ? '{' : '[', f);
    for (const struct yaml_node *item = node->first; item; item = item->next) {
        if (node->kind == YAML_MAP) fprintf(f, "%s: ", scalar_text(item->key, false, a));
        put_text(f, item, false, a);
        fputs(item->next ? ", " : "", f);
    }
    fputc(node->kind == YAML_MAP ? '}' : ']', f);
}

static const char **design_changes_texts(const struct design_change *c, struct arena *a)
{
    const char **all = ARENA_TAKE(a, const char *, c->n + 1);
    for (int i = 0; i < c->n; i++) {
        char *memory = NULL;
        size_t size = 0;
        FILE *f = memory_stream(&memory, &size);
        for (struct yaml_node *const *path = c->keys[i].path; *path; path++)
            fprintf(f, "%s%s", path == c->keys[i].path ? "" : ".", (*path)->text);
        fputc('=', f);
        put_text(f, c->keys[i].value, true, a);
        memory_stream_end(f, &memory);
        all[i] = arena_text(a, memory);
        free(memory);
    }
    return all;
}

/* ------------------------------------------------------------------ columns */

struct measure {
    const char *number, *unit; /* as written; the unit "": none */
    size_t size;               /* characters of the number      */
    enum key_dimension dimension;
};

/* ------------------------------------------------------------------ quantities */

/* Are the labels quantities of one dimension, those of levels that scenes have? Then that of each (number NULL: a
   recorded one that is none), and whether all have the same unit; the first. NULL: they are not */
static const struct measure *quantities(const struct design_factor *f, struct measure *q, bool *same)
{
    const struct key *k = design_changes_key(f->name);
    const struct measure *first = NULL;
    bool numbers =
        !k || k->type == KEY_NUMBER || k->type == KEY_WHOLE || k->type == KEY_COUNT || k->type == KEY_TIME_OR_AUTO;
    for (int i = 0; numbers && i < f->n_levels; i++) {
        enum key_dimension bare = k ? k->dimension : KEY_NONE; /* of a number without a unit */
        int power;
        double x;
        const char *label = f->levels[i].label;
        size_t n = text_number_length(label);
        const char *unit = label + n + strspn(label + n, " \t");
        const struct units_unit *u = *unit ? units_find(unit, &power) : NULL;
        bool good = n > 0 && (!*unit || u) && text_scaled(label, n, 0, &x);
        if (good) q[i] = (struct measure){label, *unit ? unit : keys_text_unit(bare), n, u ? u->dimension : bare};
        if (f->levels[i].recorded) continue;
        if (!good || (first && q[i].dimension != first->dimension)) return NULL;
        first = first ? first : &q[i];
    }
    *same = true;
    for (int i = 0; first && i < f->n_levels; i++)
        if (q[i].number && q[i].dimension == first->dimension)
            *same = *same && strcmp(q[i].unit, first->unit) == 0;
        else
            q[i].number = NULL;
    return first;
}

static void values_make(const struct design_reading *r, struct design_factor *f)
{
    struct arena *all = arena_open();
    struct measure *q = ARENA_TAKE(all, struct measure, f->n_levels + 1);
    bool same;
    const struct measure *first = quantities(f, q, &same);
    for (int i = 0; i < f->n_levels; i++) {
        bool number = first && q[i].number;
        struct arena *own = arena_open();
        struct units_fault fault;
        double x = 0; /* as written, else in SI units */
        if (number && same)
            text_scaled(q[i].number, q[i].size, 0, &x);
        else if (number)
            units_read(f->levels[i].label, q[i].dimension, &x, own, &fault);
        f->levels[i].value = f->levels[i].label;
        const char *text = number ? keys_yaml_number(x, own) : f->levels[i].label;
        if (strcmp(text, f->levels[i].label) != 0) f->levels[i].value = arena_text(r->arena, text);
        arena_close(own);
        if (first && !number)
            diag_add(r->yaml->diag, design_reading_item(r, (int)(f - r->design->factors), i)->at,
                     "leave the factor out of the recording, whose cell in that column is n/a then; a condition of its "
                     "own is a level of a factor that is a word",
                     "'%s' is no quantity as the other levels of %s are, whose column holds numbers",
                     diag_shown(r->yaml->diag, f->levels[i].label), f->name);
    }
    const char *unit = !first ? "" : same ? first->unit : keys_text_unit(first->dimension);
    f->unit = *unit ? unit : NULL;
    f->numbers = first;
    arena_close(all);
}

struct sorted_level {
    const char *text;
    int index;
};

static int by_text(const void *pa, const void *pb)
{
    const struct sorted_level *a = pa, *b = pb;
    int order = strcmp(a->text, b->text);
    return order ? order : a->index - b->index;
}

/* Calls for each level, and that before it, that has the same label, or the same value, as another. */
static void find_twice(const struct design_reading *r, int f, bool values,
                       void (*take)(const struct design_reading *r, int f, const int *two,
                                    const struct yaml_node *item))
{
    const struct design_factor *factor = &r->design->factors[f];
    struct arena *own = arena_open();
    struct sorted_level *sorted = ARENA_TAKE(own, struct sorted_level, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        sorted[i] = (struct sorted_level){values ? factor->levels[i].value : factor->levels[i].label, i};
    qsort(sorted, (size_t)factor->n_levels, sizeof *sorted, by_text);
    for (int i = 1; i < factor->n_levels; i++)
        if (strcmp(sorted[i].text, sorted[i - 1].text) == 0)
            take(r, f, (const int[2]){sorted[i - 1].index, sorted[i].index},
                 design_reading_item(r, f, sorted[i].index));
    arena_close(own);
}

/* 2 Hz and 2.0 Hz would be one in the manifest. */
static void same_value(const struct design_reading *r, int f, const int *two, const struct yaml_node *item)
{
    const struct design_factor *factor = &r->design->factors[f];
    const char *labels[2] = {factor->levels[two[0]].label, factor->levels[two[1]].label};
    if (strcmp(labels[0], labels[1]) != 0)
        diag_add(r->yaml->diag, item->at, "remove one of them, or label them with words: - {label: slow, value: 2 Hz}",
                 "the levels '%s' and '%s' of %s are the same number", diag_shown(r->yaml->diag, labels[0]),
                 diag_shown(r->yaml->diag, labels[1]), factor->name);
}

/* ------------------------------------------------------------------ names */

struct name {
    char *to;
    size_t n;
};

static void put(struct name *name, const char *s)
{
    for (; *s; s++)
        if (*s != '_' || (name->n > 0 && name->to[name->n - 1] != '_'))
            name->to[name->n++] = (char)tolower((unsigned char)*s);
}

/* "_cm_per_s"; mega is written out, as milli and mega differ by case alone. */
static void put_unit(struct name *name, const char *unit)
{
    static const struct {
        const char *of, *by; /* what stands for a character that no name has */
    } signs[] = {{"/", "_per_"},    {"^", ""},         {"(", ""},         {")", ""},          {"\xc2\xb5", "u"},
                 {"\xce\xbc", "u"}, {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "deg"}};
    put(name, "_");
    if (strncmp(unit, "1/", 2) == 0) unit++;
    if (unit[0] == 'M' && unit[1]) {
        put(name, "mega");
        unit++;
    }
    for (size_t n; *unit; unit += n) {
        const char letter[2] = {*unit, '\0'}, *by = isalnum((unsigned char)*unit) ? letter : "_";
        n = 1;
        for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
            if (strncmp(unit, signs[i].of, strlen(signs[i].of)) == 0) {
                n = strlen(signs[i].of);
                by = signs[i].by;
            }
        put(name, by);
    }
}

static const char *column_of(const struct design_factor *f, struct arena *a)
{
    struct name name = {arena_take(a, 8 * (strlen(f->name) + (f->unit ? strlen(f->unit) : 0)) + 16, 1), 0};
    for (const char *s = f->name; *s; s++) {
        const char letter[2] = {*s, '\0'};
        put(&name, isalnum((unsigned char)*s) ? letter : "_");
    }
    if (f->unit) put_unit(&name, f->unit);
    while (name.n > 0 && name.to[name.n - 1] == '_')
        name.n--;
    name.to[name.n] = '\0';
    return name.to;
}

static void column_check(const struct design_reading *r, int f)
{
    static const char taken[] =
        " file_name stimulus_id stim_file name scene_file scene_sha256 plan_row row seed sample split sample_rate_hz "
        "channels frames duration_s encoding level_mode gain_db rms_dbfs peak_dbfs true_peak_dbtp "
        "loudness_lufs onset_ramp_s offset_ramp_s audio_sha256 file_sha256 job_hash tool_version status recording "
        "full_scale replicate text error error_code ";
    const char *column = r->design->factors[f].column;
    const char *of = strstr(taken, arena_format(r->arena, " %s ", column)) ? "the manifest's own" : NULL;
    for (int i = 0; i < f; i++)
        of = strcmp(column, r->design->factors[i].column) == 0
                 ? arena_format(r->arena, "that of %s", r->design->factors[i].name)
                 : of;
    if (of)
        diag_add(r->yaml->diag, r->factors[f]->key->at, "call the factor otherwise",
                 "the manifest's column of %s would be called %s, as is %s", r->design->factors[f].name, column, of);
}

/* ------------------------------------------------------------------ factors */

static const char map_cure[] = "write for instance: - {label: wood, set: {surface.response: wood.csv}}";

struct reading_level { /* one that is being read */
    struct design_reading *r;
    int factor, index;
    bool key; /* the factor's name is a key of scenes */
    const struct yaml_node *name;
};

static struct design_level *level_of(const struct reading_level *l)
{
    return &l->r->design->factors[l->factor].levels[l->index];
}

static struct design_change *change_of(const struct reading_level *l)
{
    return &l->r->texts->levels[l->factor][l->index];
}

/* ------------------------------------------------------------------ labels */

static void label_set(const struct reading_level *l, const struct yaml_node *node)
{
    const char *text = node->text;
    bool good = node->kind == YAML_SCALAR && *text && strlen(text) <= 100;
    for (const char *s = text; good && *s; s++)
        good = (unsigned char)*s >= ' ' && *s != 127;
    if (good)
        level_of(l)->label = text;
    else
        design_reading_must(l->r, node, "label", "a text of 1 to 100 bytes in one line",
                            "write for instance: label: wood");
}

static void same_label(const struct design_reading *r, int f, const int *two, const struct yaml_node *item)
{
    const struct design_factor *factor = &r->design->factors[f];
    const struct yaml_node *label = yaml_get(item, "label");
    if (*factor->levels[two[1]].label)
        diag_add(r->yaml->diag, label ? label->at : item->at,
                 item->kind == YAML_SCALAR ? "remove one of them, or write - {label: ..., value: ...}"
                                           : "give each level a label of its own",
                 "two levels of %s are labelled '%s'", factor->name,
                 diag_shown(r->yaml->diag, factor->levels[two[1]].label));
}

/* ------------------------------------------------------------------ levels */

static void scalar_read(const struct reading_level *l, const struct yaml_node *item)
{
    const struct key *k = design_changes_key(l->name->text);
    struct arena *a = l->r->arena;
    if (!l->key) { /* reported at the first such level: with a word that should be a key, all are */
        const char *near = design_changes_near(l->r, l->name->text);
        if (l->index == 0 || l->r->factors[l->factor]->first->kind != YAML_SCALAR)
            diag_add(l->r->yaml->diag, item->at,
                     near ? arena_format(a, "did you mean %s? else %s", near, map_cure) : map_cure,
                     "a level of %s must be a map, not %s: %s is no key of scenes whose values could be levels",
                     l->name->text, scene_values_kind(l->r->yaml, item), l->name->text);
        return;
    }
    if (*item->text) {
        struct yaml_node *label = yaml_make(l->r->yaml, YAML_SCALAR, item->at,
                                            k && k->type == KEY_FILE ? relpath_stem(item->text, a) : item->text);
        label_set(l, label);
    }
    design_changes_add(l->r, change_of(l), l->name, item);
}

static void map_read(const struct reading_level *l, const struct yaml_node *map)
{
    static const char *const names[] = {"label", "text", "set", "base", "value", "of", NULL};
    const struct yaml_node *label = yaml_get(map, "label"), *set = yaml_get(map, "set"), *base = yaml_get(map, "base"),
                           *value = yaml_get(map, "value");
    const struct yaml_node *text = yaml_get(map, "text");
    design_reading_known(l->r, map, names, " in a level");
    if (label)
        label_set(l, label);
    else
        diag_add(l->r->yaml->diag, map->at, map_cure, "a level of %s has no label", l->name->text);
    if (value && l->key)
        design_changes_add(l->r, change_of(l), l->name, value);
    else if (value)
        diag_add(l->r->yaml->diag, value->key->at, map_cure,
                 "value needs a factor that is a key of scenes, which %s is not", l->name->text);
    if (set && !yaml_null(set)) design_changes_map(l->r, change_of(l), set);
    if (text && text->kind != YAML_SCALAR)
        design_reading_must(l->r, text, "text", "what a trial says of the level",
                            "write for instance: text: a plank of poplar");
    else if (text)
        level_of(l)->text = text->text;
    if (base && (base->kind != YAML_SCALAR || !*base->text))
        design_reading_must(l->r, base, "base", "the file name of a scene", "write for instance: base: scrape.yaml");
    else if (base) {
        change_of(l)->base = base;
        level_of(l)->base = scene_merge_path(l->r->yaml, base->at.source, base->text);
    }
    const struct yaml_node *of = yaml_get(map, "of");
    static const char cure[] = "write for instance: - {label: recorded, of: recordings}";
    if (!of) return;
    if (of->kind != YAML_SCALAR || strcmp(of->text, "recordings") != 0)
        design_reading_must(l->r, of, "of", "the word recordings", cure);
    level_of(l)->recorded = true; /* a level of recordings has no scene to change */
    for (const char *const *other = (const char *const[]){"set", "base", "value", NULL}; *other; other++)
        if (yaml_get(map, *other))
            diag_add(l->r->yaml->diag, yaml_get(map, *other)->key->at, cure,
                     "a level that only recordings have has no %s", *other);
}

/* ------------------------------------------------------------------ factors */

static bool name_good(const struct design_reading *r, const struct yaml_node *name, bool *key)
{
    static const char *const taken[] = {"replicate", "order", "cell", "sample", NULL};
    *key = design_changes_key(name->text) || strcmp(name->text, "accuracy") == 0 || strchr(name->text, '.');
    if (*key) return design_changes_known(r, name);
    if (text_is_one(name->text, taken))
        return diag_add(r->yaml->diag, name->at, "call the factor otherwise",
                        "%s has a meaning of its own in names: a factor cannot be called so", name->text);
    const char *s = name->text;
    while (isalnum((unsigned char)*s) || *s == '_' || *s == '-')
        s++;
    return (isalpha((unsigned char)name->text[0]) && !*s) ||
           diag_add(r->yaml->diag, name->at, "write for instance: material",
                    "a factor must be a key of scenes, or a word (letters, digits, _ and -, a letter first), not '%s'",
                    diag_shown(r->yaml->diag, name->text));
}

static void factor_read(struct design_reading *r, int f, const struct yaml_node *list)
{
    struct design_factor *factor = &r->design->factors[f];
    const struct yaml_node *name = list->key;
    bool key, good = name_good(r, name, &key);
    factor->name = name->text;
    r->factors[f] = list;
    if (list->kind == YAML_MAP || (list->kind == YAML_SCALAR && strcmp(list->text, "cells") == 0)) {
        if (good) list = design_made_read(r, f, list);
        if (!good || list == r->factors[f] || !list) return;
        r->factors[f] = list;
    }
    factor->levels = ARENA_TAKE(r->arena, struct design_level, list->n + 1);
    r->texts->levels[f] = ARENA_TAKE(r->arena, struct design_change, list->n + 1);
    if (list->kind != YAML_LIST || list->n == 0) {
        design_reading_must(r, list, factor->name,
                            list->kind == YAML_LIST ? "a list of one level or more" : "a list of levels",
                            key ? "write the values in brackets: [1 Hz, 2 Hz]" : map_cure);
        return;
    }
    for (const struct yaml_node *item = list->first; good && item; item = item->next) {
        struct reading_level l = {r, f, factor->n_levels++, key, name};
        level_of(&l)->label = "";
        if (item->kind == YAML_MAP)
            map_read(&l, item);
        else if (item->kind == YAML_SCALAR)
            scalar_read(&l, item);
        else
            diag_add(r->yaml->diag, item->at, key ? "write: - {label: ..., value: [...]}" : map_cure,
                     "a level of %s that is a list needs a label", factor->name);
        level_of(&l)->set = design_changes_texts(change_of(&l), r->arena);
    }
    find_twice(r, f, false, same_label);
    if (factor->drawn) design_made_choose(r, f);
}

/* The value of a key that is a factor is what its levels say: another factor must not change it. */
static void keys_once(const struct design_reading *r, int f, int other)
{
    const struct design_factor *g = &r->design->factors[other];
    size_t n = strlen(r->design->factors[f].name);
    for (int i = 0; r->texts->levels[other] && i < g->n_levels; i++)
        for (int k = 0; k < r->texts->levels[other][i].n; k++) {
            struct yaml_node *const *path = r->texts->levels[other][i].keys[k].path;
            if (!*g->levels[i].label || strncmp(g->levels[i].set[k], r->design->factors[f].name, n) != 0 ||
                g->levels[i].set[k][n] != '=')
                continue;
            while (path[1])
                path++;
            diag_add(r->yaml->diag, (*path)->at,
                     "remove it here, or make the other a factor of levels {label: ..., set: ...}",
                     "%s is a factor: '%s' of %s must not set it", r->design->factors[f].name,
                     diag_shown(r->yaml->diag, g->levels[i].label), g->name);
        }
}

static void factors_read(struct design_reading *r, const struct yaml_node *map)
{
    int n = map && map->kind == YAML_MAP ? map->n : 0;
    r->design->factors = ARENA_TAKE(r->arena, struct design_factor, n + 1);
    r->texts->levels = ARENA_TAKE(r->arena, struct design_change *, n + 1);
    r->texts->made = ARENA_TAKE(r->arena, struct design_made, n + 1);
    r->factors = ARENA_TAKE(r->arena, const struct yaml_node *, n + 1);
    r->drawn = ARENA_TAKE(r->arena, const int *, n + 1);
    if (map && map->kind != YAML_MAP)
        design_reading_must(r, map, "factors", "a map of factors with their levels",
                            "write for instance: factors: {motion.rate: [1 Hz, 2 Hz]}");
    for (const struct yaml_node *item = n ? map->first : NULL; item; item = item->next)
        factor_read(r, r->design->n_factors++, item);
    for (int f = 0; f < n; f++)
        for (int g = 0; g < n; g++)
            if (f != g) keys_once(r, f, g);
    bool drawn = false;
    for (int f = 0; f < n; f++)
        drawn = drawn || r->design->factors[f].drawn;
    if (r->design->samples && !drawn)
        diag_add(
            r->yaml->diag, design_reading_value(r, "samples")->key->at,
            "write a rule for a factor: motion.rate: {uniform: [1 Hz, 4 Hz]}; the same stimulus with other noise is "
            "asked for by replicates",
            "samples is given, and no factor is drawn");
}

/* ------------------------------------------------------------------ bases */

/* A stimulus has one base: the design's, or that of the one factor whose levels have some. */
static void bases_check(const struct design_reading *r)
{
    const struct yaml_node *one = NULL;
    bool all = false, some = false;
    for (int f = 0; f < r->design->n_factors; f++) {
        int n = 0;
        bool every = true;
        for (int i = 0; i < r->design->factors[f].n_levels && r->texts->levels[f]; i++)
            if (r->texts->levels[f][i].base) {
                one = r->texts->levels[f][i].base;
                n++;
            } else if (!r->design->factors[f].levels[i].recorded)
                every = false;
        if (n && some)
            diag_add(r->yaml->diag, one->key->at, "let one factor choose the scene",
                     "levels of two factors have a base");
        some = some || n;
        all = all || (n && every);
    }
    if (!r->texts->base && !(all && some))
        diag_add(r->yaml->diag, (struct diag_place){r->root->at.source, 1, 1, 0},
                 "write for instance: base: scrape.yaml",
                 some ? "base is missing, and not every level has one" : "base is missing");
}

void design_factors_read(struct design_reading *r)
{
    const struct yaml_node *base = design_reading_value(r, "base"), *set = design_reading_value(r, "set");
    if (base && (base->kind != YAML_SCALAR || !*base->text))
        design_reading_must(r, base, "base", "the file name of a scene", "write for instance: base: scrape.yaml");
    r->texts->base = base;
    r->design->base = base && base->kind == YAML_SCALAR ? scene_merge_path(r->yaml, base->at.source, base->text) : NULL;
    if (set) design_changes_map(r, &r->texts->set, set);
    r->design->set = design_changes_texts(&r->texts->set, r->arena);
    design_made_table(r);
    factors_read(r, design_reading_value(r, "factors"));
    bases_check(r);
    for (int f = 0; f < r->design->n_factors; f++) {
        struct design_factor *factor = &r->design->factors[f];
        const struct key *k = design_changes_key(factor->name);
        values_make(r, factor);
        find_twice(r, f, true, same_value);
        factor->column = column_of(factor, r->arena);
        factor->meaning = k ? k->meaning : NULL;
        column_check(r, f);
    }
}

/* Values: see scene_values.h. */
#include "scene/scene_values.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "file/yaml.h"
#include "num/real.h"
#include "scene/scene_materials.h"
#include "scene/scene_merge.h"
#include "scene/units.h"

/* ------------------------------------------------------------------ examples */

const char *scene_values_example(struct yaml *y, const struct key *k)
{
    const char *one = units_example(k->dimension);
    if (k->standard && *k->standard) return k->standard;
    if (k->example) return k->example;
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_TIME_OR_AUTO:
        return one;
    case KEY_WHOLE:
        return "48 kHz";
    case KEY_COUNT:
    case KEY_SEED:
        return arena_format(y->arena, "%.0f", k->low);
    case KEY_TEXT:
        return "some words";
    case KEY_FILE:
    case KEY_LIST:
        return "modes.csv";
    case KEY_POINT:
        return arena_format(y->arena, "[%s, 0]", one);
    case KEY_POINTS:
        return arena_format(y->arena, "[[0, 0], [%s, 0]]", one);
    case KEY_PLACES:
        return "[[0, 0, 1 m]]";
    case KEY_RANGE:
        return arena_format(y->arena, "[%s, %s]", units_text(1, k->dimension, y->arena),
                            units_text(5, k->dimension, y->arena));
    case KEY_CHOICE:
        return k->choices[0].word;
    }
    return "";
}

/* ------------------------------------------------------------------ what is read */

struct value {
    const struct scene_part *part;
    const struct key *key;
    const struct yaml_node *node;
    const char *label;
    void *field;
};

const char *scene_values_kind(struct yaml *y, const struct yaml_node *node)
{
    if (node->kind == YAML_MAP) return "a map of keys";
    if (node->kind == YAML_LIST) return "a list";
    if (yaml_null(node) || (node->plain && !*node->text)) return "an empty value";
    return arena_format(y->arena, "'%s'", diag_shown(y->diag, node->text));
}

static const char *example_cure(const struct value *v)
{
    const char *last = strrchr(v->key->path, '.');
    if (scene_materials_key(v->key))
        return arena_format(v->part->yaml->arena,
                            "rasp explain %s says what each is; one of your own goes under materials", v->key->path);
    return arena_format(v->part->yaml->arena, "write for instance: %s: %s", last ? last + 1 : v->key->path,
                        scene_values_example(v->part->yaml, v->key));
}

/* What stands where a list is needed, for "not ...": "of 3" for one of the wrong length. */
static const char *given_list(const struct value *v)
{
    struct yaml *y = v->part->yaml;
    return v->node->kind == YAML_LIST ? arena_format(y->arena, "of %d", v->node->n) : scene_values_kind(y, v->node);
}

/* ------------------------------------------------------------------ numbers */

bool scene_values_quantity(struct yaml *y, const struct yaml_node *node, const char *label, enum key_dimension d,
                           double *x)
{
    struct units_fault fault;
    double value;
    if (node->kind != YAML_SCALAR)
        return diag_add(y->diag, node->at, arena_format(y->arena, "write for instance: %s", units_example(d)),
                        "%s needs %s, not %s", label, units_name(d), scene_values_kind(y, node));
    if (!units_read(yaml_null(node) ? "" : node->text, d, &value, y->arena, &fault))
        return diag_add(y->diag, node->at, fault.cure, "%s %s", label, fault.text);
    *x = value;
    return true;
}

/* The key whose name goes on, where that takes what this one does not, as contact.smoothing_length takes 0.1 mm. */
static const struct key *longer_key(struct yaml *y, const struct key *k, const struct yaml_node *node)
{
    struct units_fault fault;
    double value;
    size_t n = strlen(k->path);
    if (node->kind != YAML_SCALAR || yaml_null(node) || units_read(node->text, k->dimension, &value, y->arena, &fault))
        return NULL;
    for (const struct key *other = keys_table; other->path; other++)
        if (!strncmp(other->path, k->path, n) && other->path[n] == '_' && other->type == KEY_NUMBER &&
            units_read(node->text, other->dimension, &value, y->arena, &fault))
            return other;
    return NULL;
}

/* What is out of range, and would not be with a prefix: 48 Hz for 48 kHz, 20 kg for 20 g; NULL: it is not that. */
static const char *prefix_meant(const struct key *k, const char *text, double value, struct arena *a)
{
    int power = 0;
    if (k->dimension == KEY_NONE || k->dimension == KEY_DECIBEL || k->dimension == KEY_LUFS ||
        k->dimension == KEY_ANGLE)
        return NULL;
    const char *example = units_example(k->dimension), *unit = strchr(example, ' ');
    bool bare = text_number_length(text) == strlen(text);
    if (!bare || !unit || !units_find(unit + 1, &power)) power = 0;
    double factors[] = {real_exp10(power), 1e3, 1e-3, 1e-6}; /* of a bare number the usual unit first: 68 GPa */
    for (int i = 0; i < 4; i++)
        if (value * factors[i] >= k->low && value * factors[i] <= k->high)
            return units_text(value * factors[i], k->dimension, a);
    return NULL;
}

bool scene_values_number(const struct scene_part *p, const struct key *k, const struct yaml_node *node,
                         const char *label, double *x)
{
    struct yaml *y = p->yaml;
    double value;
    const struct key *longer = longer_key(y, k, node);
    if (longer)
        return diag_add(y->diag, node->at,
                        arena_format(y->arena, "write for instance: %s; or %s: %s", units_example(k->dimension),
                                     longer->path, diag_shown(y->diag, node->text)),
                        "%s needs %s; %s is %s", label, units_name(k->dimension), diag_shown(y->diag, node->text),
                        units_name(longer->dimension));
    if (!scene_values_quantity(y, node, label, k->dimension, &value)) return false;
    if (value < k->low || value > k->high) {
        const char *range = units_text(k->low, k->dimension, y->arena);
        if (k->low < k->high)
            range = arena_format(y->arena, "from %s to %s", range, units_text(k->high, k->dimension, y->arena));
        const char *meant = prefix_meant(k, node->text, value, y->arena);
        return diag_add(y->diag, node->at,
                        meant ? arena_format(y->arena, "did you mean %s?", meant)
                              : arena_format(y->arena, "%s: %s", k->path, k->meaning),
                        "%s must be %s, not %s", label, range, scene_values_kind(y, node));
    }
    *x = value;
    return true;
}

static bool number_read(const struct value *v, const struct yaml_node *node, const char *label, double *x)
{
    return scene_values_number(v->part, v->key, node, label, x);
}

static bool whole_read(const struct value *v, double *x)
{
    struct yaml *y = v->part->yaml;
    double value;
    if (!number_read(v, v->node, v->label, &value)) return false;
    if (value != floor(value))
        return diag_add(
            y->diag, v->node->at,
            arena_format(y->arena, "write for instance: %s", units_text(rint(value), v->key->dimension, y->arena)),
            "%s must be a whole number, not %s", v->label, scene_values_kind(y, v->node));
    *x = value;
    return true;
}

static bool number_set(const struct value *v) { return number_read(v, v->node, v->label, v->field); }

static bool whole_set(const struct value *v) { return whole_read(v, v->field); }

static bool count_set(const struct value *v)
{
    double value;
    if (!whole_read(v, &value)) return false;
    *(int *)v->field = (int)value;
    return true;
}

static bool time_or_auto_set(const struct value *v)
{
    if (v->node->kind != YAML_SCALAR || strcmp(v->node->text, "auto") != 0) return number_set(v);
    *(double *)v->field = NAN;
    return true;
}

static bool seed_set(const struct value *v)
{
    if (v->node->kind == YAML_SCALAR && text_u64(v->node->text, v->field) &&
        (v->node->text[0] != '0' || !v->node->text[1]))
        return true;
    return diag_add(v->part->yaml->diag, v->node->at, "write for instance: seed: 7",
                    "%s must be a whole number from 0 to 18446744073709551615, not %s", v->label,
                    scene_values_kind(v->part->yaml, v->node));
}

/* ------------------------------------------------------------------ lists of points */

#define DISTINCT 1e-9 /* m, of one point of a path from the next */

static const struct kind {
    int least, most;
    const char *one, *many, *form, *example; /* example: of the coordinates after x */
} kinds[] = {{2, 10000, "point", "points", "a pair [x, y]", "0"},
             {1, 64, "place", "places", "three numbers [x, y, z]", "0, 1 m"}};

static bool point_read(const struct value *v, const struct kind *kind, const struct yaml_node *node, int number,
                       double *point)
{
    struct yaml *y = v->part->yaml;
    struct arena *a = y->arena;
    const int width = keys_points_width(v->key);
    const char *label = arena_format(a, "%s %d of %s", kind->one, number, v->label);
    const struct yaml_node *item = node->first;
    bool good = true;
    if (node->kind != YAML_LIST || node->n != width)
        return diag_add(
            y->diag, node->at,
            arena_format(a, "write for instance: [%s, %s]", units_example(v->key->dimension), kind->example),
            "%s must be %s, not %s", label, kind->form,
            node->kind == YAML_LIST ? arena_format(a, "a list of %d", node->n) : scene_values_kind(y, node));
    for (int i = 0; i < width; i++, item = item->next)
        good = number_read(v, item, arena_format(a, "%c of %s", "xyz"[i], label), &point[i]) && good;
    return good;
}

/* [n][keys_points_width(k)] in the arena; a point of KEY_POINTS lies at least 1 nm from the one before. NULL: errors,
   each reported where it stands. */
static bool points_set(const struct value *v)
{
    struct yaml *y = v->part->yaml;
    const int width = keys_points_width(v->key);
    const struct kind *kind = &kinds[width == 3];
    bool good = true, before = false;
    int i = 0;
    if (v->node->kind != YAML_LIST || v->node->n < kind->least || v->node->n > kind->most)
        return diag_add(y->diag, v->node->at,
                        arena_format(y->arena, "write for instance: %s", scene_values_example(y, v->key)),
                        "%s must be a list of %d to %d %s %s, not %s", v->label, kind->least, kind->most, kind->many,
                        strchr(kind->form, '['), given_list(v));
    double *all = ARENA_TAKE(y->arena, double, (size_t)width *(size_t)v->node->n), *at = all;
    for (const struct yaml_node *item = v->node->first; item; item = item->next, at += width) {
        bool read = point_read(v, kind, item, ++i, at);
        good = good && read;
        if (read && before && v->key->type != KEY_PLACES) {
            double dx = at[0] - at[-2], dy = at[1] - at[-1];
            if (sqrt(dx * dx + dy * dy) < DISTINCT)
                good = diag_add(y->diag, item->at, "remove one of the two", "point %d of %s lies where point %d does",
                                i, v->label, i - 1);
        }
        before = read;
    }
    *(const double **)v->field = good ? all : NULL;
    *keys_points_count(v->field) = good ? i : 0;
    return good;
}

/* ------------------------------------------------------------------ pairs */

static bool pair_set(const struct value *v)
{
    static const char *const ordinal[2] = {"the first number", "the second number"};
    struct yaml *y = v->part->yaml;
    double pair[2];
    bool good = true;
    const struct yaml_node *item = v->node->first;
    if (v->node->kind != YAML_LIST || v->node->n != 2)
        return diag_add(y->diag, v->node->at, example_cure(v), "%s must be a list of 2 numbers, not %s", v->label,
                        given_list(v));
    for (int i = 0; i < 2; i++, item = item->next)
        good = number_read(v, item, arena_format(y->arena, "%s of %s", ordinal[i], v->label), &pair[i]) && good;
    if (good) memcpy(v->field, pair, sizeof pair);
    return good;
}

static bool range_set(const struct value *v)
{
    double *pair = v->field;
    if (!pair_set(v)) return false;
    if (pair[0] < pair[1]) return true;
    pair[0] = pair[1] = NAN;
    return diag_add(v->part->yaml->diag, v->node->at, example_cure(v),
                    "the first number of %s must be less than the second", v->label);
}

/* ------------------------------------------------------------------ words */

static const char *text_of(const struct value *v, const char *needs)
{
    if (v->node->kind == YAML_SCALAR && *v->node->text) return v->node->text;
    diag_add(v->part->yaml->diag, v->node->at, example_cure(v), "%s must be %s, not %s", v->label, needs,
             scene_values_kind(v->part->yaml, v->node));
    return NULL;
}

static bool text_set(const struct value *v)
{
    const char *text = text_of(v, "a text");
    *(const char **)v->field = text;
    return text;
}

static bool file_set(const struct value *v)
{
    const char *name = text_of(v, "a file name");
    *(const char **)v->field = name ? scene_merge_path(v->part->yaml, v->node->at.source, name) : NULL;
    return name;
}

static bool item_good(const struct value *v, const struct yaml_node *item)
{
    struct yaml *y = v->part->yaml;
    if (item->kind != YAML_SCALAR || !*item->text || yaml_null(item))
        return diag_add(y->diag, item->at, example_cure(v), "an entry of %s must be a text, not %s", v->label,
                        scene_values_kind(y, item));
    for (const struct yaml_node *other = v->node->first; other != item; other = other->next)
        if (other->kind == YAML_SCALAR && strcmp(other->text, item->text) == 0)
            return diag_add(y->diag, item->at, "remove one of them", "%s has '%s' twice", v->label,
                            diag_shown(y->diag, item->text));
    return true;
}

static bool list_set(const struct value *v)
{
    bool good = v->node->kind == YAML_LIST && v->node->n > 0 && v->node->n <= 1000;
    const char **list = ARENA_TAKE(v->part->yaml->arena, const char *, v->node->n + 1);
    int n = 0;
    if (!good)
        return diag_add(v->part->yaml->diag, v->node->at, example_cure(v),
                        "%s must be a list of 1 to 1000 texts, not %s", v->label, given_list(v));
    for (const struct yaml_node *item = v->node->first; item; item = item->next) {
        good = item_good(v, item) && good;
        list[n++] = item->text;
    }
    *(const char ***)v->field = good ? list : NULL;
    return good;
}

int scene_values_choice(const struct choice *choices, const struct yaml_node *node)
{
    if (node->kind != YAML_SCALAR) return -1;
    for (int i = 0; choices[i].word; i++)
        if (strcmp(choices[i].word, node->text) == 0) return i;
    return -1;
}

static bool choice_set(const struct value *v)
{
    struct yaml *y = v->part->yaml;
    int i = scene_values_choice(v->key->choices, v->node), n = 0;
    const char *words[32] = {NULL}, *all = "", *near = NULL;
    if (i >= 0) {
        *(int *)v->field = i;
        return true;
    }
    for (; v->key->choices[n].word && n < 31; n++) {
        words[n] = v->key->choices[n].word;
        all = arena_format(y->arena, "%s%s%s", all, n ? ", " : "", words[n]);
    }
    const struct scene *s = v->part->scene;
    for (int k = 0; scene_materials_key(v->key) && s && k < s->n_materials; k++) {
        const char *own = s->materials[k].m.name;
        all = arena_format(y->arena, "%s, %s", all, own);
        if (n < 31) words[n++] = own;
        if (v->node->kind == YAML_SCALAR && !strcmp(own, v->node->text)) {
            *(int *)v->field = MATERIAL_CUSTOM; /* scene_materials_assign */
            return true;
        }
    }
    if (scene_materials_key(v->key) && !s && v->node->kind == YAML_SCALAR && *v->node->text) {
        *(int *)v->field = MATERIAL_CUSTOM;
        return true;
    }
    const char *former = v->node->kind == YAML_SCALAR ? keys_former(v->key->path, v->node->text) : NULL;
    if (former) return diag_add(y->diag, v->node->at, former, "%s: %s is no longer there", v->label, v->node->text);
    if (v->node->kind == YAML_SCALAR) near = text_nearest(v->node->text, words);
    return diag_add(y->diag, v->node->at, near ? arena_format(y->arena, "did you mean '%s'?", near) : example_cure(v),
                    "%s must be %s%s, not %s", v->label, n > 1 ? "one of: " : "", all, scene_values_kind(y, v->node));
}

/* ------------------------------------------------------------------ all types */

static bool (*const setters[])(const struct value *) = {
    [KEY_NUMBER] = number_set, [KEY_WHOLE] = whole_set, [KEY_TIME_OR_AUTO] = time_or_auto_set,
    [KEY_COUNT] = count_set,   [KEY_SEED] = seed_set,   [KEY_TEXT] = text_set,
    [KEY_FILE] = file_set,     [KEY_POINT] = pair_set,  [KEY_POINTS] = points_set,
    [KEY_PLACES] = points_set, [KEY_RANGE] = range_set, [KEY_LIST] = list_set,
    [KEY_CHOICE] = choice_set,
};

bool scene_values_read(const struct scene_part *p, const struct key *k, const struct yaml_node *node)
{
    struct value v = {p, k, node, arena_format(p->yaml->arena, "%s%s", p->prefix, k->path), keys_field(k, p->to)};
    scene_values_clear(p, k);
    return setters[k->type](&v);
}

void scene_values_clear(const struct scene_part *p, const struct key *k)
{
    void *field = keys_field(k, p->to);
    switch (k->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
    case KEY_TIME_OR_AUTO:
        *(double *)field = NAN;
        break;
    case KEY_POINT:
    case KEY_RANGE:
        ((double *)field)[0] = ((double *)field)[1] = NAN;
        break;
    case KEY_POINTS:
    case KEY_PLACES:
        *(const double **)field = NULL;
        *keys_points_count(field) = 0;
        break;
    case KEY_COUNT:
    case KEY_CHOICE:
        *(int *)field = 0;
        break;
    case KEY_SEED:
        *(uint64_t *)field = 0;
        break;
    case KEY_TEXT:
    case KEY_FILE:
        *(const char **)field = NULL;
        break;
    case KEY_LIST:
        *(const char ***)field = NULL;
        break;
    }
}

void scene_values_default(const struct scene_part *p, const struct key *k)
{
    scene_values_clear(p, k);
    if (!k->standard || !*k->standard) return;
    const char *name = arena_format(p->yaml->arena, "default of %s", k->path);
    struct diag_source *source = yaml_source(p->yaml, name, k->standard, strlen(k->standard));
    source->option = true;
    struct yaml_node *node = yaml_parse_value(p->yaml, source, 0);
    if (node) scene_values_read(p, k, node);
}

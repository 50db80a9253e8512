/* See design_columns.h. Names of columns are lower_snake with the unit at the end (motion_rate_hz, speed_cm_per_s), as tables are read by programs that
   take no other: PsychoPy, R, BIDS. */
#include "batch/design_columns.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "batch/design_changes.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/units.h"
#include "scene/units_table.h"

struct measure {
    const char *number, *unit; /* as written; the unit "": none */
    size_t size;               /* characters of the number      */
    enum key_dimension dimension;
};

/* ------------------------------------------------------------------ quantities */

/* `bare` is the dimension of a number without a unit. False: the label is none. */
static bool quantity_of(const char *label, enum key_dimension bare, struct measure *q)
{
    int power;
    double x;
    size_t n = text_number_length(label);
    const char *unit = label + n + strspn(label + n, " \t");
    const struct units_table_unit *u = *unit ? units_table_find(unit, &power) : NULL;
    if (n == 0 || (*unit && !u) || !text_scaled(label, n, 0, &x))
        return false;
    *q = (struct measure){label, *unit ? unit : keys_text_unit(bare), n, u ? u->dimension : bare};
    return true;
}

static const char *number_as_written(const struct measure *q, struct arena *a)
{
    double x = 0;
    text_scaled(q->number, q->size, 0, &x);
    return keys_yaml_number(x, a);
}

static const char *number_si(const char *label, enum key_dimension d, struct arena *a)
{
    struct units_fault fault;
    double x = 0;
    units_read(label, d, &x, a, &fault);
    return keys_yaml_number(x, a);
}

static bool of_numbers(const struct key *k)
{
    return k->type == KEY_NUMBER || k->type == KEY_WHOLE || k->type == KEY_COUNT || k->type == KEY_TIME_OR_AUTO;
}

/* Are the labels quantities of one dimension, those of levels that scenes have? Then that of each (number NULL: a recorded one that is none), and whether all have the same unit; the first.
   NULL: they are not */
static const struct measure *quantities(const struct design_factor *f, struct measure *q, bool *same)
{
    const struct key *k = design_changes_key(f->name);
    const struct measure *first = NULL;
    for (int i = 0; i < f->n_levels && !(k && !of_numbers(k)); i++) {
        bool good = quantity_of(f->levels[i].label, k ? k->dimension : KEY_NONE, &q[i]);
        if (f->levels[i].recorded)
            continue;
        if (!good || (first && q[i].dimension != first->dimension))
            return NULL;
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
    struct measure *q = ARENA_TAKE(r->arena, struct measure, f->n_levels + 1);
    const struct yaml_node *item = r->factors[f - r->design->factors]->first;
    bool same;
    const struct measure *first = quantities(f, q, &same);
    for (int i = 0; i < f->n_levels; i++, item = item->next) {
        bool number = first && q[i].number;
        f->levels[i].value = !number ? f->levels[i].label : same ? number_as_written(&q[i], r->arena) : number_si(f->levels[i].label, q[i].dimension, r->arena);
        if (first && !number)
            diag_add(r->yaml->diag, item->at, "leave the factor out of the recording, whose cell in that column is n/a then; a condition of its own is a level of a factor that is a word",
                     "'%s' is no quantity as the other levels of %s are, whose column holds numbers", diag_shown(r->yaml->diag, f->levels[i].label), f->name);
    }
    const char *unit = !first ? "" : same ? first->unit : keys_text_unit(first->dimension);
    f->unit = *unit ? unit : NULL;
}

static int by_value(const void *pa, const void *pb)
{
    const struct design_level *const *a = pa, *const *b = pb;
    int order = strcmp((*a)->value, (*b)->value);
    return order ? order : *a < *b ? -1 : *a > *b;
}

/* 2 Hz and 2.0 Hz would be one in the manifest. */
static void values_differ(const struct design_reading *r, int f)
{
    const struct design_factor *factor = &r->design->factors[f];
    struct design_level **sorted = ARENA_TAKE(r->arena, struct design_level *, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        sorted[i] = &factor->levels[i];
    qsort(sorted, (size_t)factor->n_levels, sizeof *sorted, by_value);
    for (int i = 1; i < factor->n_levels; i++) {
        const struct yaml_node *item = r->factors[f]->first;
        const char *labels[2] = {sorted[i - 1]->label, sorted[i]->label};
        if (strcmp(sorted[i]->value, sorted[i - 1]->value) != 0 || strcmp(labels[0], labels[1]) == 0)
            continue;
        for (long at = sorted[i] - factor->levels; at > 0; at--)
            item = item->next;
        diag_add(r->yaml->diag, item->at, "remove one of them, or label them with words: - {label: slow, value: 2 Hz}", "the levels '%s' and '%s' of %s are the same number",
                 diag_shown(r->yaml->diag, labels[0]), diag_shown(r->yaml->diag, labels[1]), factor->name);
    }
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

/* What stands for a character of a unit that no name has; *n: its bytes. */
static const char *spelt(const char *s, int *n)
{
    static const struct {
        const char *of, *by;
    } signs[] = {{"/", "_per_"}, {"^", ""}, {"(", ""}, {")", ""}, {"\xc2\xb5", "u"}, {"\xce\xbc", "u"}, {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "deg"}};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (strncmp(s, signs[i].of, strlen(signs[i].of)) == 0) {
            *n = (int)strlen(signs[i].of);
            return signs[i].by;
        }
    *n = 1;
    return "_";
}

/* "_cm_per_s"; mega is written out, as milli and mega differ by case alone. */
static void put_unit(struct name *name, const char *unit)
{
    put(name, "_");
    if (strncmp(unit, "1/", 2) == 0)
        unit++;
    if (unit[0] == 'M' && unit[1]) {
        put(name, "mega");
        unit++;
    }
    for (int n; *unit; unit += n) {
        const char letter[2] = {*unit, '\0'};
        n = 1;
        put(name, isalnum((unsigned char)*unit) ? letter : spelt(unit, &n));
    }
}

static const char *column_of(const struct design_factor *f, struct arena *a)
{
    struct name name = {arena_take(a, 8 * (strlen(f->name) + (f->unit ? strlen(f->unit) : 0)) + 16, 1), 0};
    for (const char *s = f->name; *s; s++) {
        const char letter[2] = {*s, '\0'};
        put(&name, isalnum((unsigned char)*s) ? letter : "_");
    }
    if (f->unit)
        put_unit(&name, f->unit);
    while (name.n > 0 && name.to[name.n - 1] == '_')
        name.n--;
    name.to[name.n] = '\0';
    return name.to;
}

static void column_check(const struct design_reading *r, int f)
{
    static const char *const taken[] = {"file_name", "stimulus_id", "stim_file", "name", "scene_file", "scene_sha256", "plan_row", "row", "seed", "sample_rate_hz", "channels",
                                        "frames", "duration_s", "encoding", "level_mode", "gain_db", "rms_dbfs", "peak_dbfs", "true_peak_dbtp",
                                        "loudness_lufs", "onset_ramp_s", "offset_ramp_s", "audio_sha256", "file_sha256", "job_hash", "tool_version",
                                        "status", "recording", "full_scale", "replicate", "text", "error", "error_code", NULL};
    const char *column = r->design->factors[f].column, *of = NULL;
    for (int i = 0; taken[i]; i++)
        of = strcmp(column, taken[i]) == 0 ? "the manifest's own" : of;
    for (int i = 0; i < f; i++)
        of = strcmp(column, r->design->factors[i].column) == 0 ? arena_format(r->arena, "that of %s", r->design->factors[i].name) : of;
    if (of)
        diag_add(r->yaml->diag, r->factors[f]->key->at, "call the factor otherwise", "the manifest's column of %s would be called %s, as is %s",
                 r->design->factors[f].name, column, of);
}

void design_columns_make(struct design_reading *r)
{
    for (int f = 0; f < r->design->n_factors; f++) {
        struct design_factor *factor = &r->design->factors[f];
        const struct key *k = design_changes_key(factor->name);
        values_make(r, factor);
        values_differ(r, f);
        factor->column = column_of(factor, r->arena);
        factor->meaning = k ? k->meaning : NULL;
        column_check(r, f);
    }
}

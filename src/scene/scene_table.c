/* Diagnostics: see scene_table.h. */
#include "scene/scene_table.h"

#include <string.h>

#include "base/text.h"

static const struct params_column columns[] = {
#define COLUMN(id, name, exists, needs, meaning) {name, meaning, NULL},
#include "scene/columns.def"
#undef COLUMN
};
enum { COLUMNS = sizeof columns / sizeof *columns };

const struct params_column *scene_table_column(int k, const struct params **whose)
{
    *whose = NULL;
    return k < COLUMNS ? &columns[k] : params_column(k - COLUMNS, whose);
}

/* What a contact lacks for a column; "" if it lacks nothing. */
static const char *lacks(const struct contact *c, int column)
{
    const char *const lacking[] = {
#define COLUMN(id, name, exists, needs, meaning) (exists) ? "" : needs,
#include "scene/columns.def"
#undef COLUMN
    };
    const struct params *whose;
    if (column < COLUMNS) return lacking[column];
    params_column(column - COLUMNS, &whose);
    return params_given(c, whose) ? "" : whose->section;
}

static int column_find(const struct yaml_node *item)
{
    const struct params *whose;
    const struct params_column *c;
    for (int k = 0; item->kind == YAML_SCALAR && (c = scene_table_column(k, &whose)); k++)
        if (strcmp(c->name, item->text) == 0) return k;
    return -1;
}

static const struct yaml_node *column_first(struct yaml_node *root)
{
    const struct yaml_node *list = yaml_find(root, "output.diagnostics.columns");
    return list && list->kind == YAML_LIST ? list->first : NULL;
}

static const char *const *names_of(struct arena *a)
{
    const struct params *whose;
    int n = 0;
    while (scene_table_column(n, &whose))
        n++;
    const char **names = ARENA_TAKE(a, const char *, n + 1);
    for (int k = 0; k < n; k++)
        names[k] = scene_table_column(k, &whose)->name;
    return names;
}

void scene_table_names(struct yaml *y, struct yaml_node *root)
{
    for (const struct yaml_node *item = column_first(root); item; item = item->next) {
        if (item->kind != YAML_SCALAR || !*item->text || yaml_null(item) || column_find(item) >= 0) continue;
        const char *near = text_nearest(item->text, names_of(y->arena));
        diag_add(y->diag, item->at,
                 near ? arena_format(y->arena, "did you mean '%s'?", near)
                      : "rasp explain output.diagnostics.columns lists them",
                 "output.diagnostics.columns: there is no column '%s'", diag_shown(y->diag, item->text));
    }
}

void scene_table_columns(const struct scene_part *p, struct yaml_node *root, const struct scene *s)
{
    const struct contact *c = p->to;
    for (const struct yaml_node *item = column_first(root); item && s->output.diagnostics.given; item = item->next) {
        int k = column_find(item);
        const char *needs = k < 0 ? "" : lacks(c, k);
        if (*needs)
            diag_add(p->yaml->diag, item->at, "leave the column out, or give what it needs",
                     "output.diagnostics.columns: %s has no %s: it needs %s", scene_part_contact(p, c->name),
                     item->text, needs);
    }
}

void scene_table_rate(const struct scene_part *top)
{
    static const char *const rates[2] = {"output.diagnostics.rate", "output.sample_rate"};
    const struct scene *s = top->to;
    if (s->output.diagnostics.given && s->output.diagnostics.rate > s->output.sample_rate)
        diag_add(top->yaml->diag, scene_part_later(top, rates[0], rates[1]), "lower output.diagnostics.rate",
                 "%s, %.9g Hz, is above %s, %.9g Hz: some rows would have no samples of the force", rates[0],
                 s->output.diagnostics.rate, rates[1], s->output.sample_rate);
}

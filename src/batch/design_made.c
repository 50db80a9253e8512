/* Levels that nobody wrote out: values that are drawn, or the column of a table (cells: FILE.csv). Equal values are one
   level, called by its text; what it changes is made when a scene is (design_made_change), so that a level takes some
   bytes.

   Sample k of a factor is a quantile of u, 53 bits of SHA-256 of

       rasp sample\0 SEED \0 FACTOR \0 K \0

   over 2^53, of 0 that of 1: it depends on nothing else. With a < b the bounds,

       uniform        a + u (b - a)
       log_uniform    a exp(u log(b/a))
       normal         mean + sd Q(u), or with `within`, P the normal distribution, mean + sd Q(P(a) + u (P(b) - P(a))),
                      on the side where P is small
       choose         the level of number floor(u n)

   in the unit that is written, rounded to DIGITS digits, which the bounds have at most, and written out: label, scene
   and column are that number. All by arithmetic that has the same bits everywhere (num/real.h, num/special.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "batch/design_reading.h"
#include "file/bytes.h"
#include "file/csv.h"
#include "num/real.h"
#include "num/special.h"
#include "scene/keys.h"
#include "scene/keys_text.h"
#include "scene/keys_yaml.h"
#include "scene/scene_merge.h"

enum { DIGITS = 4, TABLE_ERRORS = 20 /* of a column that are reported */ };

/* Standard deviations: of the smallest u; where P is still a normal number. */
#define FARTHEST 8.3
#define FARTHEST_WITHIN 30

/* ------------------------------------------------------------------ levels from texts */

struct text_at {
    const char *text;
    int i, first; /* first: the smallest i that has this text */
};

static int by_text(const void *pa, const void *pb)
{
    const struct text_at *a = pa, *b = pb;
    int order = strcmp(a->text, b->text);
    return order ? order : a->i - b->i;
}

static int by_place(const void *pa, const void *pb)
{
    return ((const struct text_at *)pa)->i - ((const struct text_at *)pb)->i;
}

/* The factor's levels are the texts that differ, in the order in which they come; lines[i]: where text i stands. */
static const int *levels_make(const struct design_reading *r, int f, const char *const *texts, const int *lines, int n)
{
    struct design_factor *factor = &r->design->factors[f];
    int *level = ARENA_TAKE(r->arena, int, n + 1), *line = NULL;
    struct arena *own = arena_open();
    struct text_at *all = ARENA_TAKE(own, struct text_at, n);
    int *number = ARENA_TAKE(own, int, n + 1);
    for (int i = 0; i < n; i++)
        all[i] = (struct text_at){texts[i], i, i};
    qsort(all, (size_t)n, sizeof *all, by_text);
    for (int i = 0, first = 0; i < n; i++) {
        first = strcmp(all[i].text, all[first].text) == 0 ? first : i;
        all[i].first = all[first].i;
        factor->n_levels += i == first;
    }
    qsort(all, (size_t)n, sizeof *all, by_place);
    factor->levels = ARENA_TAKE(r->arena, struct design_level, factor->n_levels + 1);
    if (lines) line = ARENA_TAKE(r->arena, int, factor->n_levels + 1);
    for (int i = 0, next = 0; i < n; i++) {
        if (all[i].first == i) {
            number[i] = next;
            if (lines) line[next] = lines[i];
            factor->levels[next++].label = texts[i];
        }
        level[i] = number[all[i].first];
    }
    arena_close(own);
    r->texts->made[f].lines = line;
    return level;
}

struct design_change design_made_change(const struct design *d, int f, int level, struct arena *a)
{
    const struct design_made *m = &d->texts->made[f];
    if (!m->path) return d->texts->levels[f][level];
    struct yaml_node *value = ARENA_TAKE(a, struct yaml_node, 1);
    *value =
        (struct yaml_node){.kind = YAML_SCALAR, .at = m->at, .text = d->factors[f].levels[level].label, .plain = true};
    if (m->lines) value->at = (struct diag_place){m->at.source, m->lines[level], 1, 0};
    struct scene_layer_key *key = ARENA_TAKE(a, struct scene_layer_key, 1);
    *key = (struct scene_layer_key){m->path, value};
    return (struct design_change){key, 1, NULL};
}

/* ------------------------------------------------------------------ what is drawn */

enum rule { UNIFORM, LOG_UNIFORM, NORMAL, RULES };

static const char *const rules[] = {"uniform", "log_uniform", "normal", "choose", "within", NULL};

static const char cure[] = "write {uniform: [1 Hz, 4 Hz]}, {log_uniform: [0.1 N, 10 N]}, {normal: [20 g, 5 g], within: "
                           "[5 g, 50 g]} or {choose: [LEVEL, ...]}";

struct draw {
    const struct design_reading *r;
    const struct key *key;
    enum rule rule;
    const char *unit;        /* NULL: not known yet */
    double of[2], within[2]; /* in that unit; within NAN: not given */
};

/* A number with the unit that all of the rule have. */
static bool bound_read(struct draw *w, const struct yaml_node *node, const char *label, double *x)
{
    const struct design_reading *r = w->r;
    char digits[20];
    int exponent;
    size_t n = node->kind == YAML_SCALAR ? text_number_length(node->text) : 0;
    if (!n || !text_scaled(node->text, n, 0, x))
        return design_reading_must(r, node, label, "a number with its unit", cure);
    const char *unit = node->text + n + strspn(node->text + n, " \t");
    if (w->unit && strcmp(unit, w->unit) != 0)
        return diag_add(r->yaml->diag, node->at, "write all numbers of a rule in one unit: values are drawn in it",
                        "%s has the units '%s' and '%s'", label, w->unit, diag_shown(r->yaml->diag, unit));
    w->unit = unit;
    text_digits(fabs(*x), digits, &exponent);
    return strlen(digits) <= DIGITS ||
           diag_add(r->yaml->diag, node->at, "round it: values are drawn to that many digits",
                    "%s must have at most %d digits, not %s", label, DIGITS, diag_shown(r->yaml->diag, node->text));
}

/* [a, b] */
static bool pair_read(struct draw *w, const struct yaml_node *node, const char *label, bool rising, double x[2])
{
    if (node->kind != YAML_LIST || node->n != 2)
        return design_reading_must(w->r, node, label, "a list of two numbers", cure);
    if (!bound_read(w, node->first, label, &x[0]) || !bound_read(w, node->last, label, &x[1])) return false;
    return !rising || x[0] < x[1] ||
           diag_add(w->r->yaml->diag, node->at, "write the smaller one first", "%s is empty: %s is not below %s", label,
                    diag_shown(w->r->yaml->diag, node->first->text), diag_shown(w->r->yaml->diag, node->last->text));
}

static double probability(const struct draw *w, double x) { return special_normal_cdf((x - w->of[0]) / w->of[1]); }

/* The normal distribution within bounds, on whose left side it is. */
static double normal(const struct draw *w, double u)
{
    double a = w->within[0], b = w->within[1], mean = w->of[0], sd = w->of[1];
    if (isnan(a)) return mean + sd * special_normal_quantile(u);
    if (a > mean) { /* mirrored, where the tail is not 1 less what is lost in it */
        struct draw m = *w;
        m.within[0] = 2 * mean - b, m.within[1] = 2 * mean - a;
        return 2 * mean - normal(&m, 1 - u);
    }
    double from = probability(w, a), to = probability(w, b);
    return mean + sd * special_normal_quantile(from + u * (to - from));
}

static double drawn(const struct draw *w, double u)
{
    const double *x = w->rule == NORMAL ? w->within : w->of;
    double y = w->rule == NORMAL ? normal(w, u) : x[0] + u * (x[1] - x[0]);
    if (w->rule == LOG_UNIFORM) y = x[0] * real_exp(u * real_log(x[1] / x[0]));
    return isnan(x[0]) ? y : fmin(fmax(y, x[0]), x[1]);
}

static const char *number_text(double x, const char *unit, struct arena *a)
{
    char text[32];
    snprintf(text, sizeof text, "%.*e", DIGITS - 1, x);
    return arena_format(a, "%s%s%s", keys_yaml_number(strtod(text, NULL) + 0.0, a), *unit ? " " : "", unit);
}

static double uniform(const struct design_reading *r, int f, int sample)
{
    char hex[HASH_TEXT], text[48];
    struct hash x = hash_start();
    hash_text(&x, "rasp sample");
    snprintf(text, sizeof text, "%llu", (unsigned long long)r->design->seed);
    hash_text(&x, text);
    hash_text(&x, r->design->factors[f].name);
    snprintf(text, sizeof text, "%d", sample);
    hash_text(&x, text);
    hash_end(&x, hex);
    hex[16] = '\0';
    uint64_t bits = strtoull(hex, NULL, 16) >> 11;
    return (double)(bits ? bits : 1) * 0x1p-53;
}

void design_made_choose(struct design_reading *r, int f)
{
    const struct design_factor *factor = &r->design->factors[f];
    int n = r->design->samples ? r->design->samples : 1, most = 0, *level = ARENA_TAKE(r->arena, int, n),
        *from = ARENA_TAKE(r->arena, int, factor->n_levels + 1);
    for (int i = 0; i < factor->n_levels; i++)
        if (!factor->levels[i].recorded) from[most++] = i;
    for (int k = 0; k < n && most; k++)
        level[k] = from[(int)(uniform(r, f, k + 1) * most)];
    r->drawn[f] = level;
}

static bool draw_check(struct draw *w, const struct yaml_node *list, const struct yaml_node *within)
{
    const struct design_reading *r = w->r;
    struct diag *diag = r->yaml->diag;
    const char *label = rules[w->rule];
    if (!pair_read(w, list, label, w->rule != NORMAL, w->of)) return false;
    if (within && w->rule != NORMAL)
        return diag_add(diag, within->key->at, "leave it out: the bounds are those of the list",
                        "within goes with normal");
    if (within && !pair_read(w, within, "within", true, w->within)) return false;
    if (w->rule == LOG_UNIFORM && !(w->of[0] > 0))
        return diag_add(diag, list->first->at, "write two numbers above 0, or uniform",
                        "log_uniform must be above 0, not %s", diag_shown(diag, list->first->text));
    if (w->rule == NORMAL && !(w->of[1] > 0))
        return diag_add(diag, list->last->at, "write [mean, standard deviation]",
                        "the standard deviation must be above 0, not %s", diag_shown(diag, list->last->text));
    if (within && fmax(w->within[0] - w->of[0], w->of[0] - w->within[1]) > FARTHEST_WITHIN * w->of[1])
        return diag_add(diag, within->at, "take bounds that are nearer to the mean",
                        "within is too far from the mean: nothing would be drawn there");
    return true;
}

/* The ends of what can be drawn are values of the key. */
static bool ends_check(const struct draw *w, const struct yaml_node *factor, const struct yaml_node *list,
                       const struct yaml_node *within)
{
    const struct yaml_node *ends[2] = {list->first, list->last};
    struct yaml_node far[2];
    if (within) ends[0] = within->first, ends[1] = within->last;
    for (int i = 0; i < 2; i++) {
        if (w->rule == NORMAL && !within) {
            double x = w->of[0] + (i ? FARTHEST : -FARTHEST) * w->of[1];
            far[i] = *list;
            far[i].kind = YAML_SCALAR, far[i].plain = true, far[i].text = number_text(x, w->unit, w->r->arena);
            ends[i] = &far[i];
        }
        if (!design_factors_value(w->r, factor->key, ends[i])) return false;
    }
    return true;
}

static void draw_read(struct design_reading *r, int f, const struct yaml_node *factor, const struct yaml_node *list,
                      enum rule rule)
{
    const struct yaml_node *within = yaml_get(factor, "within");
    struct design_factor *to = &r->design->factors[f];
    const struct key *k = keys_find(keys_text_plain(to->name));
    if (!k || (k->type != KEY_NUMBER && k->type != KEY_TIME_OR_AUTO)) {
        diag_add(r->yaml->diag, list->key->at, "let it choose: {choose: [LEVEL, ...]}",
                 "%s is no key of scenes whose value is any number: it cannot be %s", to->name, rules[rule]);
        return;
    }
    struct draw w = {.r = r, .key = k, .rule = rule, .within = {NAN, NAN}};
    if (!design_factors_key(r, factor->key) || !draw_check(&w, list, within) || !ends_check(&w, factor, list, within))
        return;
    int n = r->design->samples ? r->design->samples : 1;
    struct arena *own = arena_open();
    const char **texts = ARENA_TAKE(own, const char *, n);
    for (int i = 0; i < n; i++)
        texts[i] = number_text(drawn(&w, uniform(r, f, i + 1)), w.unit, own);
    r->drawn[f] = levels_make(r, f, texts, NULL, n);
    for (int i = 0; i < to->n_levels; i++)
        to->levels[i].label = arena_text(r->arena, to->levels[i].label);
    arena_close(own);
    r->texts->made[f].at = list->at;
    to->rule = arena_format(r->arena, "%s, %s and %s", rules[rule], list->first->text, list->last->text);
    if (within)
        to->rule = arena_format(r->arena, "%s, within %s and %s", to->rule, within->first->text, within->last->text);
}

/* ------------------------------------------------------------------ tables */

void design_made_table(struct design_reading *r)
{
    const struct yaml_node *cells = yaml_get(r->root, "cells");
    if (!cells || cells->kind != YAML_SCALAR || yaml_null(cells) || !*cells->text) return;
    const char *file = scene_merge_path(r->yaml, cells->at.source, cells->text);
    struct csv *t = ARENA_TAKE(r->arena, struct csv, 1);
    struct err e = {0};
    struct bytes b; /* once more, as csv_read takes its own apart: messages show lines of it */
    if (!csv_read_file(file, r->arena, t, &e) || !bytes_read(file, r->arena, &b, &e)) {
        diag_add(r->yaml->diag, cells->at, "write for instance: cells: rows.csv, with a column for each factor", "%s",
                 e.text);
        r->yaml->missing = r->yaml->missing || e.kind == ERR_INPUT;
        return;
    }
    r->table_source = yaml_source(r->yaml, arena_text(r->arena, file), b.at, b.n);
    r->table_source->named = cells->at;
    r->table = t;
    r->rows = ARENA_TAKE(r->arena, const int *, t->columns);
    r->design->sources[1] = r->table_source->name;
}

static struct yaml_node cell_node(const struct design_reading *r, size_t row, int column)
{
    struct diag_place at = {r->table_source, r->table->lines[row], 1, 0};
    return (struct yaml_node){.kind = YAML_SCALAR,
                              .at = at,
                              .plain = true,
                              .text = r->table->cells[row * r->table->columns + (size_t)column]};
}

/* The values of the factor's column. */
static void column_read(struct design_reading *r, int f, const struct yaml_node *factor)
{
    struct design_factor *to = &r->design->factors[f];
    int column = r->table ? csv_column(r->table, to->name) : -1, n = r->table ? (int)r->table->rows : 0, bad = 0;
    if (!keys_find(keys_text_plain(to->name))) {
        diag_add(r->yaml->diag, factor->at, "list its levels: [{label: wood, set: {surface.response: wood.csv}}]",
                 "%s is no key of scenes whose values a table could have", to->name);
        return;
    }
    if (!design_factors_key(r, factor->key)) return;
    if (column < 0) { /* a missing column is reported with the others */
        if (!yaml_get(r->root, "cells") || yaml_get(r->root, "cells")->kind != YAML_SCALAR)
            diag_add(r->yaml->diag, factor->at, "write for instance: cells: rows.csv",
                     "%s has its levels from the table of cells, and there is none", to->name);
        return;
    }
    const char **texts = ARENA_TAKE(r->arena, const char *, n + 1);
    for (int i = 0; i < n; i++)
        texts[i] = r->table->cells[(size_t)i * r->table->columns + (size_t)column];
    r->rows[column] = levels_make(r, f, texts, r->table->lines, n);
    for (int i = 0, done = 0; i < n && bad < TABLE_ERRORS; i++) {
        struct yaml_node node = cell_node(r, (size_t)i, column);
        if (r->rows[column][i] != done) continue; /* each level once, where it stands first */
        done++;
        bad += !*node.text
                   ? !diag_add(r->yaml->diag, node.at, "write a value into each row", "%s is empty here", to->name)
                   : !design_factors_value(r, factor->key, &node);
    }
    r->texts->made[f].at = (struct diag_place){r->table_source, 1, 1, 0};
    to->rule = "as the table of cells has them";
}

void design_made_row(struct design_reading *r, size_t row, int *level)
{
    for (int f = 0; f < r->design->n_factors; f++) {
        int column = csv_column(r->table, r->design->factors[f].name);
        struct yaml_node node;
        level[f] = -1;
        if (column < 0) continue;
        if (r->rows[column]) {
            level[f] = r->rows[column][row];
            continue;
        }
        node = cell_node(r, row, column);
        level[f] = design_reading_level(r, f, &node, false);
    }
}

/* ------------------------------------------------------------------ all */

const struct yaml_node *design_made_read(struct design_reading *r, int f, const struct yaml_node *value)
{
    struct design_factor *factor = &r->design->factors[f];
    const struct yaml_node *choose = yaml_get(value, "choose");
    int n = 0;
    factor->drawn = value->kind == YAML_MAP;
    if (value->kind == YAML_MAP) design_reading_known(r, value, rules, arena_format(r->arena, " in %s", factor->name));
    for (int k = 0; k <= RULES && value->kind == YAML_MAP; k++)
        n += yaml_get(value, rules[k]) != NULL;
    if (factor->drawn && n != 1)
        diag_add(r->yaml->diag, value->at, cure, "%s must be a list of levels, or one rule to draw them by",
                 factor->name);
    if (factor->drawn && !design_reading_value(r, "samples"))
        diag_add(r->yaml->diag, value->key->at, "write at the top level, for instance: samples: 100",
                 "%s is drawn, and samples does not say how often", factor->name);
    if (factor->drawn && choose && n == 1) return choose;
    if (factor->drawn && n != 1) return NULL;
    r->texts->made[f].path = scene_merge_layer_path(r->yaml, value->key);
    r->texts->levels[f] = NULL;
    if (!factor->drawn) column_read(r, f, value);
    for (int k = 0; k < RULES && factor->drawn; k++)
        if (yaml_get(value, rules[k])) draw_read(r, f, value, yaml_get(value, rules[k]), (enum rule)k);
    return NULL;
}

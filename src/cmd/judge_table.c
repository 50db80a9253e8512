/* Tables that `rasp judge` reads: their columns by role, words as levels, confusion matrices from answers or as they
   are. A fault is reported by file, line and column. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/choices.h"
#include "base/outfile.h"
#include "base/text.h"
#include "batch/tables.h"
#include "cmd/judge.h"
#include "output/mark.h"

struct row {
    const char **cells, *key[2]; /* trial, stimulus */
    int line;
};

static int by_trial(const void *pa, const void *pb)
{
    const struct row *a = pa, *b = pb;
    int order = strcmp(a->key[0], b->key[0]);
    order = order ? order : strcmp(a->key[1], b->key[1]);
    return order ? order : a->line - b->line;
}

/* Each listener had an order of their own; trials are numbered by the design's levels, which so come in its order. */
static void page_sort(struct csv *t, struct arena *a)
{
    int stimulus = csv_column(t, "stimulus_id"), trial = csv_column(t, "trial_id");
    struct row *rows = ARENA_TAKE(a, struct row, t->rows + 1);
    const char **cells = ARENA_TAKE(a, const char *, t->rows * t->columns + 1);
    for (size_t i = 0; i < t->rows; i++) {
        const char **row = t->cells + i * t->columns;
        rows[i] = (struct row){row, {row[trial], stimulus < 0 ? "" : row[stimulus]}, t->lines[i]};
    }
    qsort(rows, t->rows, sizeof *rows, by_trial);
    for (size_t i = 0; i < t->rows; i++) {
        memcpy(cells + i * t->columns, rows[i].cells, t->columns * sizeof *cells);
        t->lines[i] = rows[i].line;
    }
    t->cells = cells;
}

bool judge_table_answers(struct judge *j, const char *file, struct csv *t, struct err *e)
{
    size_t n = 0;
    if (!csv_table_read(file, j->arena, t, e)) return false;
    if (!t->numbers && csv_column(t, "session_test_id") >= 0 && !judge_webmushra(j, t, e)) return false;
    int training = t->numbers || csv_column(t, "trial_id") < 0 ? -1 : csv_column(t, "training");
    if (training < 0) return true;
    for (size_t i = 0; i < t->rows; i++) {
        const char **row = t->cells + i * t->columns;
        if (!strcmp(row[training], "1")) continue;
        memmove(t->cells + n * t->columns, row, t->columns * sizeof *row);
        t->lines[n++] = t->lines[i];
    }
    if (n < t->rows) report_text(&j->report, "%s: %zu rows are of training and do not count\n", file, t->rows - n);
    t->rows = n;
    page_sort(t, j->arena);
    return true;
}

int judge_table_column(const struct judge *j, const struct csv *t, const char *role, bool must, struct err *e)
{
    int n;
    const char **given = args_values(&j->call->args, "column", &n), *name = role;
    size_t length = strlen(role);
    for (int i = 0; i < n; i++)
        if (!strncmp(given[i], role, length) && given[i][length] == '=') {
            name = given[i] + length + 1;
            must = true;
        }
    int column = csv_column(t, name);
    if (column < 0 && must)
        err_set(e, ERR_SCENE, "%s: there is no column '%s': add it, or say which it is by --column %s=NAME", t->file,
                name, role);
    return column;
}

static int by_size(const void *a, const void *b)
{
    double x = 0, y = 0;
    text_double(*(const char *const *)a, &x);
    text_double(*(const char *const *)b, &y);
    return (x > y) - (x < y);
}

bool judge_table_factor(const struct csv *t, int column, struct arena *a, struct judge_factor *f, struct err *e)
{
    char room[CSV_ROOM];
    bool numbers = true;
    double x;
    *f = (struct judge_factor){column < 0 ? "condition" : t->names[column], column, NULL, 0,
                               ARENA_TAKE(a, int, t->rows + 1)};
    if (t->rows == 0) return err_set(e, ERR_SCENE, "%s: has no rows", t->file);
    for (size_t i = 0; i < t->rows; i++) {
        const char *word = column < 0 ? "all" : csv_text(t, i, column, room);
        if (!*word)
            return err_set(e, ERR_SCENE, "%s:%d: column '%s': is empty: fill the cell, or take the row out", t->file,
                           t->lines[i], f->name);
        if (judge_place(f->levels, f->n, word) >= 0) continue;
        if (f->n == JUDGE_LEVELS)
            return err_set(e, ERR_SCENE, "%s:%d: column '%s': more than %d different words: is it the right column?",
                           t->file, t->lines[i], f->name, JUDGE_LEVELS);
        numbers = numbers && text_double(word, &x);
        judge_add(a, &f->levels, &f->n, arena_text(a, word));
    }
    if (numbers) qsort(f->levels, (size_t)f->n, sizeof *f->levels, by_size);
    for (size_t i = 0; column >= 0 && i < t->rows; i++)
        f->of_row[i] = judge_place(f->levels, f->n, csv_text(t, i, column, room));
    return true;
}

bool judge_table_role(const struct judge *j, const struct csv *t, const char *role, bool must, struct judge_factor *f,
                      struct err *e)
{
    int column = judge_table_column(j, t, role, must, e);
    return !e->kind && judge_table_factor(t, column, j->arena, f, e);
}

/* ------------------------------------------------------------------ classes */

struct classes { /* words that may stand in a cell, and what each counts as */
    const char **word;
    int n, *as;
};

static const char *listed(const struct classes *c, struct arena *a)
{
    const char *all = "";
    for (int i = 0; i < c->n; i++)
        all = arena_format(a, "%s%s%s", all, i ? ", " : "", c->word[i]);
    return all;
}

/* --groups a+b,c+d: each counts as one; what is in none stands for itself. */
static bool group(struct judge *j, struct classes *c, struct judge_choices *m, struct err *e)
{
    int groups, words;
    const char **given = judge_words(j->call, "groups", &groups, e);
    c->as = ARENA_TAKE(j->arena, int, c->n);
    for (int i = 0; i < c->n; i++)
        c->as[i] = -1;
    for (int g = 0; g < groups; g++) {
        const char **word = judge_split(j->arena, given[g], '+', &words);
        for (int w = 0; w < words && !e->kind; w++) {
            int k = judge_place(c->word, c->n, word[w]);
            if (k < 0 || c->as[k] >= 0)
                return err_set(e, ERR_USAGE, "--groups: '%s' is %s; the classes are: %s", word[w],
                               k < 0 ? "no class" : "in two groups", listed(c, j->arena));
            c->as[k] = g;
        }
    }
    for (int i = 0; i < c->n && !e->kind; i++) /* in the classes' order */
        c->as[i] = judge_add(j->arena, &m->class_name, &m->classes, c->as[i] < 0 ? c->word[i] : given[c->as[i]]);
    return judge_table_open(j, m, e);
}

bool judge_table_open(struct judge *j, struct judge_choices *m, struct err *e)
{
    if (e->kind) return false;
    if (m->classes < 2)
        return err_set(e, ERR_SCENE, "%s: only '%s' can be chosen: at least 2 classes are needed", m->file,
                       m->class_name[0]);
    if (m->classes > JUDGE_CLASSES)
        return err_set(e, ERR_SCENE, "%s: %d classes: at most %d can be confused", m->file, m->classes, JUDGE_CLASSES);
    m->cell = ARENA_TAKE(j->arena, double, m->conditions * m->classes * m->classes);
    return true;
}

static bool class_of(const struct csv *t, size_t row, int column, const struct classes *c, struct arena *a, int *k,
                     struct err *e)
{
    char room[CSV_ROOM];
    const char *word = csv_text(t, row, column, room);
    *k = judge_place(c->word, c->n, word);
    if (*k >= 0) return true;
    const char **names = ARENA_TAKE(a, const char *, c->n + 1);
    memcpy(names, c->word, (size_t)c->n * sizeof *names);
    const char *meant = text_nearest(word, names);
    return err_set(e, ERR_SCENE, "%s:%d: column '%s': '%s' is no class (%s; --classes names them)%s%s%s", t->file,
                   t->lines[row], t->names[column], word, listed(c, a), meant ? ": did you mean '" : "",
                   meant ? meant : "", meant ? "'?" : "");
}

double *judge_table_row(const struct judge_choices *m, int condition, int played)
{
    return m->cell + (condition * m->classes + played) * m->classes;
}

/* ------------------------------------------------------------------ answers */

static bool answers_take(struct judge *j, const struct csv *t, const struct judge_factor *condition, int chosen,
                         struct judge_choices *m, struct err *e)
{
    struct judge_factor played, person;
    struct classes c;
    if (!judge_table_role(j, t, "played", true, &played, e) ||
        !judge_table_role(j, t, "participant", false, &person, e))
        return false;
    c.word = judge_words(j->call, "classes", &c.n, e);
    if (!c.n) c = (struct classes){played.levels, played.n, NULL};
    m->counted = true;
    m->person = person.levels;
    m->people = person.column < 0 ? 0 : person.n;
    if (!group(j, &c, m, e)) return false;
    m->right = ARENA_TAKE(j->arena, double, m->people * m->conditions + 1);
    m->asked = ARENA_TAKE(j->arena, double, m->people * m->conditions + 1);
    for (size_t i = 0; i < t->rows; i++) {
        int p, k, of = condition->of_row[i], at = person.of_row[i] * m->conditions + of;
        if (!class_of(t, i, played.column, &c, j->arena, &p, e) || !class_of(t, i, chosen, &c, j->arena, &k, e))
            return false;
        judge_table_row(m, of, c.as[p])[c.as[k]]++;
        if (!m->people) continue;
        m->asked[at]++;
        m->right[at] += c.as[p] == c.as[k];
    }
    return true;
}

/* ------------------------------------------------------------------ matrices */

/* The rows [rows][n] of the columns. Are they answers, or shares (of 1 or of 100)? "# cells: answers", shares or
   percent says it; else whole numbers are answers. */
static const double *cells_read(const struct csv *t, const struct judge_factor *condition, const int *columns, int n,
                                bool *counted, struct arena *a, struct err *e)
{
    static const char *const kinds[] = {"answers", "shares", "percent"};
    const char *stated = csv_comment(t, "cells");
    int kind = stated ? judge_place(kinds, 3, stated) : -1;
    double *cells = ARENA_TAKE(a, double, t->rows *(size_t)n), *sums = ARENA_TAKE(a, double, t->rows), most = 0;
    bool whole = true;
    if (stated && kind < 0)
        err_set(e, ERR_SCENE, "%s: '# cells: %s' is not answers, shares or percent", t->file, stated);
    for (size_t i = 0; i < t->rows && !e->kind; i++) {
        for (int k = 0; k < n; k++) {
            double *x = &cells[i * (size_t)n + (size_t)k];
            if (csv_number(t, i, columns[k], x, e) && (*x < 0 || *x > 1e9))
                err_set(e, ERR_SCENE, "%s:%d: column '%s': %g is not from 0 to 1e9", t->file, t->lines[i],
                        t->names[columns[k]], *x);
            whole = whole && *x == rint(*x);
            sums[i] += *x;
        }
        most = fmax(most, sums[i]);
    }
    if (kind < 0) kind = whole ? 0 : most < 1.5 ? 1 : 2;
    *counted = kind == 0;
    for (size_t i = 0; i < t->rows; i++) {
        double sum = sums[i], want = kind == 1 ? 1 : 100;
        if (!(*counted ? whole && sum > 0 : fabs(sum - want) <= 0.02 * want))
            err_set(e, ERR_SCENE,
                    "%s:%d: the row of condition '%s' sums to %g: answers are whole numbers, more than 0 a row; shares "
                    "sum to 1, percent to 100, within 2 %%",
                    t->file, t->lines[i], condition->levels[condition->of_row[i]], sum);
        for (int k = 0; k < n && !*counted; k++)
            cells[i * (size_t)n + (size_t)k] /= sum;
    }
    return cells;
}

static bool matrices_take(struct judge *j, const struct csv *t, const struct judge_factor *condition,
                          struct judge_choices *m, struct err *e)
{
    struct classes c = {0};
    int played = judge_table_column(j, t, "played", true, e), *columns = ARENA_TAKE(j->arena, int, t->columns);
    if (e->kind) return false;
    c.word = ARENA_TAKE(j->arena, const char *, t->columns);
    for (int k = 0; k < (int)t->columns; k++)
        if (k != played && k != condition->column) {
            columns[c.n] = k;
            c.word[c.n++] = t->names[k];
        }
    const double *cells = cells_read(t, condition, columns, c.n, &m->counted, j->arena, e);
    if (e->kind || !group(j, &c, m, e)) return false;
    bool *seen = ARENA_TAKE(j->arena, bool, m->conditions *c.n);
    for (size_t i = 0; i < t->rows; i++) {
        int p, of = condition->of_row[i];
        if (!class_of(t, i, played, &c, j->arena, &p, e)) return false;
        if (seen[of * c.n + p])
            return err_set(e, ERR_SCENE, "%s:%d: column '%s': '%s' of condition '%s' has a row already", t->file,
                           t->lines[i], t->names[played], c.word[p], m->condition[of]);
        seen[of * c.n + p] = true;
        for (int k = 0; k < c.n; k++)
            judge_table_row(m, of, c.as[p])[c.as[k]] += cells[i * (size_t)c.n + (size_t)k];
    }
    return true;
}

bool judge_table_choices(struct judge *j, const char *file, struct judge_choices *m, struct err *e)
{
    struct csv t;
    struct judge_factor condition;
    if (!judge_table_answers(j, file, &t, e) || !judge_table_role(j, &t, "condition", false, &condition, e))
        return false;
    *m = (struct judge_choices){.file = file, .conditions = condition.n, .condition = condition.levels};
    bool answers = judge_table_column(j, &t, "participant", false, e) >= 0;
    int chosen = judge_table_column(j, &t, "chosen", answers, e);
    return !e->kind &&
           (chosen >= 0 ? answers_take(j, &t, &condition, chosen, m, e) : matrices_take(j, &t, &condition, m, e)) &&
           judge_table_whole(m, e);
}

bool judge_table_whole(const struct judge_choices *m, struct err *e)
{
    for (int i = 0; i < m->conditions * m->classes; i++) {
        double sum = 0;
        for (int k = 0; k < m->classes; k++)
            sum += m->cell[i * m->classes + k];
        if (sum == 0)
            return err_set(e, ERR_SCENE,
                           "%s: condition '%s' has no '%s': each needs every class; --groups joins classes", m->file,
                           m->condition[i / m->classes], m->class_name[i % m->classes]);
    }
    return true;
}

const double *judge_table_shares(const struct judge_choices *m, int condition, struct arena *a)
{
    double *shares = ARENA_TAKE(a, double, m->classes * m->classes);
    choices_shares(judge_table_row(m, condition, 0), m->classes, shares);
    return shares;
}

bool judge_table_write(struct judge *j, const struct judge_choices *m, struct err *e)
{
    struct outfile o;
    const char *to = args_value(&j->call->args, "output");
    if (!to) return true;
    if (!mark_absent(to, args_given(&j->call->args, "force"), e) ||
        !cmd_spares(to, "the table", m->file, "-o OTHER.csv", e) || !outfile_open(&o, to, e))
        return false;
    int n = m->classes;
    fprintf(o.stream, "# cells: %s\ncondition,played", m->counted ? "answers" : "shares");
    for (int k = 0; k < n; k++) {
        fputc(',', o.stream);
        tables_text(o.stream, m->class_name[k]);
    }
    for (int i = 0; i < m->conditions * n; i++) {
        fputc('\n', o.stream);
        tables_text(o.stream, m->condition[i / n]);
        fputc(',', o.stream);
        tables_text(o.stream, m->class_name[i % n]);
        for (int k = 0; k < n; k++) {
            fputc(',', o.stream);
            csv_put_number(o.stream, m->cell[i * n + k]);
        }
    }
    fputc('\n', o.stream);
    return outfile_commit(&o, e);
}

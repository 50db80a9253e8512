/* rasp judge ratings, pairs: means and their errors, analysis of variance with repeated measures, Tukey's
   comparisons. */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cmd/judge.h"

struct ratings {
    const char *file;
    struct anova_design design;
    struct judge_factor factor[ANOVA_FACTORS];
    struct anova_effect effect[1 << ANOVA_FACTORS];
};

/* "kappa:mu", of a mask. */
static const char *effect_name(const struct ratings *t, unsigned mask, struct arena *a)
{
    const char *name = "";
    for (int k = 0; k < t->design.factors; k++)
        if (mask >> k & 1) name = arena_format(a, "%s%s%s", name, *name ? ":" : "", t->factor[k].name);
    return name;
}

/* 5e9 for 5000000000. */
static const char *level_name(const char *word, struct arena *a)
{
    size_t n = strlen(word), zeros = 0;
    while (zeros < n && word[n - 1 - zeros] == '0')
        zeros++;
    return zeros < 5 || zeros == n || strspn(word, "0123456789") < n
               ? word
               : arena_format(a, "%.*se%zu", (int)(n - zeros), word, zeros);
}

/* "kappa=1:mu=2", of a cell's levels of a mask. */
static const char *cell_name(const struct ratings *t, unsigned mask, int cell, struct arena *a)
{
    const char *name = "";
    for (int k = 0, below = t->design.cells; k < t->design.factors; k++) {
        below /= t->design.levels[k];
        if (mask >> k & 1)
            name = arena_format(a, "%s%s%s=%s", name, *name ? ":" : "", t->factor[k].name,
                                level_name(t->factor[k].levels[cell / below % t->design.levels[k]], a));
    }
    return name;
}

/* ------------------------------------------------------------------ the report */

struct means { /* of the combinations of a mask's levels */
    int n, width;
    const char **name;
    double *mean, *sem;
};

static struct means means_of(const struct ratings *t, unsigned mask, struct arena *a)
{
    const struct anova_design *d = &t->design;
    struct means m = {.name = ARENA_TAKE(a, const char *, d->cells),
                      .mean = ARENA_TAKE(a, double, d->cells),
                      .sem = ARENA_TAKE(a, double, d->cells)};
    anova_means(d, mask, a, m.mean, m.sem);
    for (int c = 0; c < d->cells; c++) {
        bool first = true; /* of the cells that have these levels */
        for (int k = 0, below = d->cells; k < d->factors; k++) {
            below /= d->levels[k];
            first = first && (mask >> k & 1 || c / below % d->levels[k] == 0);
        }
        if (!first) continue;
        m.name[m.n] = cell_name(t, mask, c, a);
        m.mean[m.n] = m.mean[c];
        m.sem[m.n] = m.sem[c];
        m.width = (int)fmax(m.width, (double)strlen(m.name[m.n++]));
    }
    return m;
}

static void report_means(struct judge *j, const struct ratings *t, unsigned mask)
{
    struct means m = means_of(t, mask, j->arena);
    double t95 = gsl_cdf_tdist_Pinv(0.975, t->design.people - 1);
    for (int i = 0; i < m.n; i++) {
        double mean = m.mean[i], sem = m.sem[i], low = mean - t95 * sem, high = mean + t95 * sem;
        report_text(&j->report, "  %-*s %9.4g   SEM %-9.4g 95 %%: %.4g to %.4g\n", m.width, m.name[i], mean, sem, low,
                    high);
        report_set(&j->report, ":{ cell:s mean:n sem:n low:n high:n }", m.name[i], mean, sem, low, high);
        judge_figure(j, mean, "mean(%s)", m.name[i]);
        judge_figure(j, sem, "sem(%s)", m.name[i]);
    }
}

/* Of n means n (n - 1)/2 comparisons, each an integral of some milliseconds. */
static bool report_tukey(struct judge *j, const struct ratings *t, unsigned mask, struct err *e)
{
    struct means m = means_of(t, mask, j->arena);
    const char *effect = effect_name(t, mask, j->arena);
    if (m.n > JUDGE_COMPARED)
        return err_set(e, ERR_SCENE, "%s: %s has %d means: Tukey's comparisons are of %d at most", t->file, effect, m.n,
                       JUDGE_COMPARED);
    report_text(&j->report, "\nTukey's comparisons of %s\n", effect);
    for (int b = 0; b < m.n; b++)
        for (int a = 0; a < b; a++) {
            const char *name = arena_format(j->arena, "%s - %s", m.name[a], m.name[b]);
            double off = m.mean[a] - m.mean[b], p = anova_tukey(&t->design, &t->effect[mask - 1], off);
            report_text(&j->report, p < 1e-10 ? "  %-*s %9.4g   p <1e-10\n" : "  %-*s %9.4g   p %.4g\n",
                        2 * m.width + 3, name, off, p);
            report_set(&j->report, ":{ effect:s pair:s difference:n p:n }", effect, name, off, p);
            judge_figure(j, p, "tukey(%s)", name);
        }
    return true;
}

static void report_effect(struct judge *j, const struct anova_effect *f, const char *name, int width)
{
    report_text(&j->report, "  %-*s %3d, %-5d F %-10.6g p %-9.4g epsilon %.4f p %-9.4g eta2 %.4f\n", width, name, f->df,
                f->df_error, f->f, f->p, f->epsilon, f->p_gg, f->eta);
    report_set(&j->report,
               ":{ effect:s df:i df_error:i ss:n ss_error:n f:n p:n epsilon:n p_greenhouse_geisser:n eta_squared:n }",
               name, f->df, f->df_error, f->ss, f->ss_error, f->f, f->p, f->epsilon, f->p_gg, f->eta);
    judge_figure(j, f->f, "F(%s)", name);
    judge_figure(j, f->p, "p(%s)", name);
    judge_figure(j, f->df, "df(%s)", name);
    judge_figure(j, f->df_error, "df_error(%s)", name);
}

/* tukey [n]: masks. */
static bool report_anova(struct judge *j, struct ratings *t, const unsigned *tukey, int n, struct err *e)
{
    const struct anova_design *d = &t->design;
    unsigned effects = 1u << d->factors;
    struct report *r = &j->report;
    int width = (int)strlen(effect_name(t, effects - 1, j->arena));
    anova_within(d, t->effect);
    judge_figure(j, d->people, "listeners");
    report_set(r, "listeners:i cells:i means:[", d->people, d->cells);
    for (int k = 0; k < d->factors; k++)
        report_means(j, t, 1u << k);
    for (int k = 0; k < n; k++)
        if (tukey[k] & (tukey[k] - 1)) report_means(j, t, tukey[k]);
    report_set(r, "] effects:[");
    report_text(r, "\nrepeated measures\n");
    for (unsigned m = 1; m < effects; m++)
        report_effect(j, &t->effect[m - 1], effect_name(t, m, j->arena), width);
    report_set(r, "] tukey:[");
    for (int k = 0; k < n; k++)
        if (!report_tukey(j, t, tukey[k], e)) return false;
    report_end(r);
    return true;
}

/* ------------------------------------------------------------------ ratings */

static bool design_check(struct ratings *t, struct err *e)
{
    struct anova_design *d = &t->design;
    double cells = 1;
    for (int k = 0; k < d->factors; k++) {
        if (t->factor[k].n < 2)
            return err_set(e, ERR_SCENE, "%s: column '%s' has one level only, '%s': leave it out of --factors", t->file,
                           t->factor[k].name, t->factor[k].levels[0]);
        cells *= d->levels[k] = t->factor[k].n;
    }
    d->cells = (int)fmin(cells, 1e6);
    if (cells > 5000 || cells * d->people > 1e7)
        return err_set(e, ERR_SCENE, "%s: %g combinations of levels, %d listeners: at most 5000, and 1e7 cells",
                       t->file, cells, d->people);
    return d->people >= 2 ||
           err_set(e, ERR_SCENE, "%s: %d listener: at least 2 are needed, or nothing is repeated", t->file, d->people);
}

/* Means of each listener's ratings in each cell. */
static bool cells_take(struct judge *j, struct ratings *t, const struct csv *v, const struct judge_factor *person,
                       int rating, struct err *e)
{
    struct anova_design *d = &t->design;
    double *y = ARENA_TAKE(j->arena, double, d->people * d->cells), x;
    int *n = ARENA_TAKE(j->arena, int, d->people * d->cells);
    for (size_t i = 0; i < v->rows; i++) {
        int at = person->of_row[i];
        for (int k = 0; k < d->factors; k++)
            at = at * d->levels[k] + t->factor[k].of_row[i];
        if (!csv_number(v, i, rating, &x, e)) return false;
        y[at] += x;
        n[at]++;
    }
    for (int i = 0; i < d->people * d->cells; i++) {
        if (n[i] == 0 || n[i] != n[0]) {
            const char *who = person->levels[i / d->cells],
                       *cell = cell_name(t, (1u << d->factors) - 1, i % d->cells, j->arena);
            return n[i] == 0 ? err_set(e, ERR_SCENE,
                                       "%s: listener '%s' has no rating of %s: each must rate every combination",
                                       v->file, who, cell)
                             : err_set(e, ERR_SCENE,
                                       "%s: listener '%s' has %d ratings of %s, where '%s' has %d of the first: as "
                                       "many are needed in every cell",
                                       v->file, who, n[i], cell, person->levels[0], n[0]);
        }
        y[i] /= n[i];
    }
    d->y = y;
    report_set(&j->report, "ratings_in_a_cell:i", n[0]);
    report_text(&j->report, "%s: %d listeners, %d cell%s of %d rating%s\n", v->file, d->people, d->cells,
                d->cells == 1 ? "" : "s", n[0], n[0] == 1 ? "" : "s");
    return true;
}

/* Without --factors: all columns but two; of the table of a page of rasp export those between role and rating. */
static bool factors_take(struct judge *j, struct ratings *t, const struct csv *v, int person, int rating, struct err *e)
{
    int n;
    const char **given = judge_words(j->call, "factors", &n, e);
    bool page = !n && csv_column(v, "trial_id") >= 0 && csv_column(v, "role") >= 0;
    int begin = page ? csv_column(v, "role") + 1 : 0, end = n ? n : page ? rating : (int)v->columns;
    for (int k = begin; k < end && !e->kind; k++) {
        int column = n ? csv_column(v, given[k]) : k;
        if (!n && (k == person || k == rating)) continue;
        if (column < 0) return err_set(e, ERR_USAGE, "--factors: %s has no column '%s'", v->file, given[k]);
        if (t->design.factors == ANOVA_FACTORS)
            return err_set(e, ERR_USAGE, "%s: more than %d factors: say by --factors which columns are", v->file,
                           ANOVA_FACTORS);
        judge_table_factor(v, column, j->arena, &t->factor[t->design.factors++], e);
    }
    return !e->kind && (t->design.factors || err_set(e, ERR_SCENE, "%s: no column is a factor", v->file));
}

/* --tukey kappa:mu, in whatever order; one factor has them anyway, if it has no more levels than can be compared. */
static bool tukey_of(const struct judge *j, const struct ratings *t, unsigned *mask, int *n, struct err *e)
{
    int given, words;
    const char **names = args_values(&j->call->args, "tukey", &given);
    if (given > 16) return err_set(e, ERR_USAGE, "--tukey was given %d times, and may be 16 times", given);
    for (int i = 0; i < given; i++) {
        const char **word = judge_split(j->arena, names[i], ':', &words);
        mask[i] = 0;
        for (int w = 0; w < words; w++) {
            unsigned was = mask[i];
            for (int k = 0; k < t->design.factors; k++)
                if (!strcmp(word[w], t->factor[k].name)) mask[i] |= 1u << k;
            if (mask[i] == was) return err_set(e, ERR_USAGE, "--tukey: '%s' is no factor, or comes twice", word[w]);
        }
    }
    *n = given;
    if (t->design.factors == 1 && !given && t->factor[0].n <= JUDGE_COMPARED) mask[(*n)++] = 1;
    return true;
}

bool judge_ratings_run(struct judge *j, struct err *e)
{
    struct csv v;
    struct ratings *t = arena_take(j->arena, 1, sizeof *t);
    struct judge_factor person;
    unsigned tukey[16];
    int n = 0;
    t->file = j->call->args.operands[0];
    if (!judge_table_answers(j, t->file, &v, e) || !judge_table_role(j, &v, "participant", true, &person, e))
        return false;
    int rating = judge_table_column(j, &v, "rating", true, e);
    if (e->kind || !factors_take(j, t, &v, person.column, rating, e)) return false;
    t->design.people = person.n;
    return design_check(t, e) && tukey_of(j, t, tukey, &n, e) && cells_take(j, t, &v, &person, rating, e) &&
           report_anova(j, t, tukey, n, e);
}

/* ------------------------------------------------------------------ pairs: 002 VI-C. The printed weights are lost in
   our text of the paper (it has 1 for all): taken are 1 of a sound that has more, 1/2 each of two alike, 1 on the
   diagonal, which adds the same to every score */

struct pairs {
    int a, b, answer; /* columns */
    struct judge_factor person, set, control;
    struct judge_factor level; /* of a and b together, of one control: of_row 2 i and 2 i + 1 are those of its row i */
};

/* 1, 1/2 or 0 of "A>B", "A=B", "B>A", with blanks or without. */
static bool answer_take(const struct csv *t, size_t row, int column, double *more, struct err *e)
{
    char room[CSV_ROOM], bare[5] = "";
    size_t n = 0;
    const char *text = csv_text(t, row, column, room);
    for (const char *p = text; *p && n < 4; p++)
        if (*p != ' ') bare[n++] = *p;
    *more = !strcmp(bare, "A>B") ? 1 : !strcmp(bare, "A=B") ? 0.5 : 0;
    return *more > 0 || !strcmp(bare, "B>A") ||
           err_set(e, ERR_SCENE, "%s:%d: column '%s': '%s' is not A>B, A=B or B>A", t->file, t->lines[row],
                   t->names[column], text);
}

/* score[people][levels] of one control: means over sets. */
static bool score(struct judge *j, const struct csv *t, const struct pairs *q, int control, double *score_of,
                  struct err *e)
{
    int n = q->level.n, sets = q->set.n, people = q->person.n;
    bool *seen = ARENA_TAKE(j->arena, bool, people *sets *n *n);
    for (int i = 0; i < people * n; i++)
        score_of[i] = 1;
    const int *level = q->level.of_row;
    for (size_t i = 0; i < t->rows; i++) {
        double more;
        if (q->control.of_row[i] != control) continue;
        int a = *level++, b = *level++, who = q->person.of_row[i];
        int at = (who * sets + q->set.of_row[i]) * n * n;
        if (!answer_take(t, i, q->answer, &more, e)) return false;
        if (a == b || seen[at + a * n + b])
            return err_set(e, ERR_SCENE, "%s:%d: column '%s': listener '%s' compares '%s' with %s", t->file,
                           t->lines[i], t->names[q->b], q->person.levels[who], q->level.levels[a],
                           a == b ? "itself"
                                  : "this one a second time: each pair comes once in a set of a condition; --column "
                                    "set=NAME says which "
                                    "column that is");
        seen[at + a * n + b] = seen[at + b * n + a] = true;
        score_of[who * n + a] += more / sets;
        score_of[who * n + b] += (1 - more) / sets;
    }
    for (int i = 0; i < people * sets * n * n; i++)
        if (!seen[i] && i / n % n != i % n)
            return err_set(e, ERR_SCENE, "%s: listener '%s' has not compared '%s' with '%s' in set '%s' of '%s'",
                           t->file, q->person.levels[i / n / n / sets], q->level.levels[i / n % n],
                           q->level.levels[i % n], q->set.levels[i / n / n % sets], q->control.levels[control]);
    return true;
}

static bool pairs_read(const struct judge *j, const struct csv *t, struct pairs *q, struct err *e)
{
    q->a = judge_table_column(j, t, "a", true, e);
    q->b = judge_table_column(j, t, "b", true, e);
    q->answer = judge_table_column(j, t, "answer", true, e);
    return judge_table_role(j, t, "participant", true, &q->person, e) &&
           judge_table_role(j, t, "set", false, &q->set, e) &&
           judge_table_role(j, t, "condition", false, &q->control, e);
}

/* What is compared in a control: each may have levels of its own. */
static bool levels_read(const struct judge *j, const struct csv *t, struct pairs *q, int control, struct err *e)
{
    struct csv both = {.file = t->file, .columns = 1};
    both.names = (const char *[]){arena_format(j->arena, "%s', '%s", t->names[q->a], t->names[q->b])};
    both.cells = ARENA_TAKE(j->arena, const char *, 2 * t->rows);
    both.lines = ARENA_TAKE(j->arena, int, 2 * t->rows);
    for (size_t i = 0; i < 2 * t->rows; i++) {
        char room[CSV_ROOM];
        if (q->control.of_row[i / 2] != control) continue;
        both.lines[both.rows] = t->lines[i / 2];
        both.cells[both.rows++] = arena_text(j->arena, csv_text(t, i / 2, i % 2 ? q->b : q->a, room));
    }
    return judge_table_factor(&both, 0, j->arena, &q->level, e);
}

bool judge_ratings_pairs(struct judge *j, struct err *e)
{
    struct csv v;
    struct pairs q;
    if (!judge_table_answers(j, j->call->args.operands[0], &v, e) || !pairs_read(j, &v, &q, e)) return false;
    report_list(&j->report, "conditions");
    for (int k = 0; k < q.control.n; k++) {
        if (!levels_read(j, &v, &q, k, e)) return false;
        double all = (double)q.person.n * q.set.n * q.level.n * q.level.n;
        if (all > 1e8)
            return err_set(e, ERR_SCENE, "%s: %d listeners, %d sets, %d levels: %g cells, at most 1e8", v.file,
                           q.person.n, q.set.n, q.level.n, all);
        struct ratings *t = arena_take(j->arena, 1, sizeof *t);
        double *y = ARENA_TAKE(j->arena, double, q.person.n *q.level.n);
        *t = (struct ratings){
            .file = v.file, .design = {.people = q.person.n, .factors = 1, .y = y}, .factor = {q.level}};
        t->factor[0].name = q.control.column < 0 ? "level" : q.control.levels[k];
        if (!design_check(t, e) || !score(j, &v, &q, k, y, e)) return false;
        report_text(&j->report, "%s%s: scores of %d listeners, means of %d set%s (1 more, 1/2 alike, 1 of itself)\n",
                    k ? "\n" : "", t->factor[0].name, q.person.n, q.set.n, q.set.n == 1 ? "" : "s");
        report_set(&j->report, ":{ condition:s sets:i", t->factor[0].name, q.set.n);
        if (!report_anova(j, t, (const unsigned[]){1}, 1, e)) return false;
        report_end(&j->report);
    }
    report_end(&j->report);
    return true;
}

/* rasp judge choices, similarity: confusion matrices, how sure their shares are, and how alike they are. */
#include <math.h>
#include <string.h>

#include "analysis/choices.h"
#include "base/text.h"
#include "cmd/judge.h"

struct asked { /* options */
    double confidence, bound;
    long draws, seed;
    int all; /* intervals that hold at once */
};

static bool options_of(const struct judge *j, const struct judge_choices *m, struct asked *o, struct err *e)
{
    const struct args *g = &j->call->args;
    *o = (struct asked){0.95, 10, 10000, 1, args_given(g, "simultaneous") ? m->classes * m->classes : 1};
    return args_number(g, "confidence", (const double[]){0.5, 0.9999}, &o->confidence, e) &&
           args_number(g, "bound", (const double[]){0.1, 100}, &o->bound, e) &&
           args_whole(g, "draws", (const long[]){100, 10000000}, &o->draws, e) &&
           args_whole(g, "seed", (const long[]){0, 1L << 53}, &o->seed, e);
}

static int widest(const struct judge_choices *m)
{
    int width = 7;
    for (int k = 0; k < m->classes; k++)
        width = (int)fmax(width, (double)text_utf8_count(m->class_name[k], strlen(m->class_name[k])));
    return width;
}

/* ------------------------------------------------------------------ one matrix */

static void report_row_of(struct judge *j, const struct judge_choices *m, int c, int p, const double *share, double z)
{
    const double *cell = judge_table_row(m, c, p);
    double n = 0, *low = ARENA_TAKE(j->arena, double, m->classes), *high = ARENA_TAKE(j->arena, double, m->classes);
    struct report *r = &j->report;
    int width = widest(m);
    for (int k = 0; k < m->classes; k++)
        n += cell[k];
    report_text(r, "  %-*s", width, m->class_name[p]);
    for (int k = 0; k < m->classes; k++) {
        double hold[2] = {0};
        if (m->counted) choices_wilson(cell[k], n, z, hold);
        low[k] = hold[0];
        high[k] = hold[1];
        report_text(r, " %*.1f", width, 100 * share[k]);
        judge_figure(j, 100 * share[k], "%s/%s/%s", m->condition[c], m->class_name[p], m->class_name[k]);
    }
    report_set(r, ":{ played:s shares:a", m->class_name[p], share, m->classes);
    if (m->counted) {
        report_text(r, " %7.0f   %.1f to %.1f", n, 100 * low[p], 100 * high[p]);
        report_set(r, "answers:n low:a high:a", n, low, m->classes, high, m->classes);
    }
    report_text(r, "\n");
    report_set(r, "}");
}

static void report_matrix(struct judge *j, const struct judge_choices *m, int c, const struct asked *o)
{
    const double *share = judge_table_shares(m, c, j->arena), *cell = judge_table_row(m, c, 0);
    double mean = 0, right = 0, all = 0, hold[2];
    struct report *r = &j->report;
    int n = m->classes, width = widest(m);
    for (int i = 0; i < n * n; i++) {
        all += cell[i];
        if (i % (n + 1)) continue; /* not on the diagonal */
        mean += share[i] / n;
        right += cell[i];
    }
    report_set(r, ":{ condition:s right_mean_of_rows:n", m->condition[c], mean);
    report_text(r, "\n%s: right %.1f %% in the mean of rows", m->condition[c], 100 * mean);
    judge_figure(j, 100 * mean, "%s/right", m->condition[c]);
    if (m->counted) {
        choices_wilson(right, all, choices_deviations(o->confidence, 1), hold);
        report_text(r, "; of %.0f answers %.1f %% (%.1f to %.1f)", all, 100 * right / all, 100 * hold[0],
                    100 * hold[1]);
        report_set(r, "answers:n right:n right_low:n right_high:n", all, right / all, hold[0], hold[1]);
    }
    report_text(r, "\n  %-*s", width, "");
    for (int k = 0; k < n; k++)
        report_text(r, " %*s", width, m->class_name[k]);
    report_text(r, m->counted ? " answers   right\n" : "\n");
    report_list(r, "rows");
    for (int p = 0; p < n; p++)
        report_row_of(j, m, c, p, share + p * n, choices_deviations(o->confidence, o->all));
    report_set(r, "] }");
}

/* ------------------------------------------------------------------ against a reference */

/* label: what the line begins with */
static void report_similarity(struct judge *j, const char *label, const char *name, const double *const shares[2],
                              int n)
{
    double both[2];
    for (int f = 0; f < 2; f++)
        both[f] = choices_similarity(shares[0], shares[1], n, f);
    report_row(&j->report, label, "%7.3f   %7.3f", both[0], both[1]);
    report_set(&j->report, "condition:s spectral:n frobenius:n", name, both[0], both[1]);
    judge_figure(j, both[0], "similarity(%s)", name);
}

static bool differences(const struct judge_choices *m, int c, int reference, double *d, struct err *e)
{
    for (int i = 0; i < m->people; i++) {
        const double *asked = m->asked + i * m->conditions, *right = m->right + i * m->conditions;
        int none = asked[c] == 0 ? c : reference;
        if (asked[none] == 0)
            return err_set(e, ERR_SCENE,
                           "%s: listener '%s' has no answers of condition '%s': comparison in pairs needs both of each",
                           m->file, m->person[i], m->condition[none]);
        d[i] = 100 * (right[c] / asked[c] - right[reference] / asked[reference]);
    }
    return m->people > 1 ||
           err_set(e, ERR_SCENE, "%s: %d listener: at least 2 are needed to compare conditions", m->file, m->people);
}

static bool report_pair(struct judge *j, const struct judge_choices *m, int c, int reference, const struct asked *o,
                        struct err *e)
{
    double *d = ARENA_TAKE(j->arena, double, m->people + 1), p;
    struct report *r = &j->report;
    int df;
    if (m->people) {
        bool all;
        if (!differences(m, c, reference, d, e)) return false;
        struct choices_equivalence q = choices_equivalence(d, m->people, o->bound);
        p = choices_permutation(d, m->people, o->draws, (uint64_t)o->seed, &all);
        report_row(r, "  right",
                   "%+.1f points (90 %%: %+.1f to %+.1f), permutation p %.4g (%s), within %g points p %.4g", q.mean,
                   q.low, q.high, p, all ? "all" : "drawn", o->bound, q.p);
        report_set(r, "difference:n low90:n high90:n permutation_p:n all_permutations:b bound:n equivalence_p:n",
                   q.mean, q.low, q.high, p, all, o->bound, q.p);
    }
    report_list(r, "chi_squared");
    for (int k = 0; k < m->classes && m->counted; k++) {
        double x = choices_chi_squared(judge_table_row(m, c, k), judge_table_row(m, reference, k), m->classes, &df, &p);
        report_row(r, arena_format(j->arena, "  %s", m->class_name[k]),
                   "chi-squared %.4g, %d degrees of freedom, p %.4g", x, df, p);
        report_set(r, ":{ played:s x:n df:i p:n }", m->class_name[k], x, df, p);
    }
    report_end(r);
    return true;
}

/* The place of --reference among the conditions; none given: `otherwise`. */
static bool reference_of(const struct judge *j, const struct judge_choices *m, int otherwise, int *reference,
                         struct err *e)
{
    const char *name = args_value(&j->call->args, "reference");
    *reference = name ? judge_place(m->condition, m->conditions, name) : otherwise;
    return !name || *reference >= 0 || err_set(e, ERR_USAGE, "--reference: %s has no condition '%s'", m->file, name);
}

bool judge_choices_report(struct judge *j, const struct judge_choices *m, struct err *e)
{
    struct asked o;
    int reference;
    struct report *r = &j->report;
    if (!options_of(j, m, &o, e) || !reference_of(j, m, -1, &reference, e)) return false;
    report_set(r, "file:v classes:t conditions:[", m->file, m->class_name, m->classes);
    if (m->people) judge_figure(j, m->people, "listeners");
    for (int c = 0; c < m->conditions; c++)
        report_matrix(j, m, c, &o);
    report_end(r);
    if (reference < 0) return true;
    const double *own = judge_table_shares(m, reference, j->arena);
    report_text(r, "\nbeside %s       spectral, Frobenius (equation 14)\n", m->condition[reference]);
    report_set(r, "reference:s compared:[", m->condition[reference]);
    for (int c = 0; c < m->conditions; c++) {
        if (c == reference) continue;
        report_object(r, NULL);
        const double *both[] = {own, judge_table_shares(m, c, j->arena)};
        report_similarity(j, m->condition[c], m->condition[c], both, m->classes);
        if (!report_pair(j, m, c, reference, &o, e)) return false;
        report_end(r);
    }
    report_end(r);
    return true;
}

bool judge_choices_run(struct judge *j, struct err *e)
{
    struct judge_choices m;
    return judge_table_choices(j, j->call->args.operands[0], &m, e) && judge_choices_report(j, &m, e) &&
           judge_table_write(j, &m, e);
}

/* ------------------------------------------------------------------ similarity */

bool judge_choices_similarity(struct judge *j, struct err *e)
{
    struct judge_choices first, m;
    int reference;
    const char **files = j->call->args.operands;
    if (!judge_table_choices(j, files[0], &first, e) ||
        !reference_of(j, &first, first.conditions == 1 ? 0 : -1, &reference, e))
        return false;
    if (reference < 0)
        return err_set(e, ERR_USAGE, "%s has %d conditions: say by --reference which one the others are compared with",
                       files[0], first.conditions);
    const double *own = judge_table_shares(&first, reference, j->arena);
    report_set(&j->report, "reference:s compared:[", first.condition[reference]);
    report_text(&j->report, "like %s of %s (equation 14): spectral norm, Frobenius's\n", first.condition[reference],
                files[0]);
    for (int f = 0; files[f]; f++) {
        if (!judge_table_choices(j, files[f], &m, e)) return false;
        for (int k = 0; k < m.classes; k++)
            if (m.classes != first.classes || strcmp(m.class_name[k], first.class_name[k]) != 0)
                return err_set(e, ERR_SCENE, "%s: its classes are not those of %s, or in another order: '%s'", files[f],
                               files[0], m.class_name[k]);
        for (int k = 0; k < m.conditions; k++) {
            if (f == 0 && k == reference) continue;
            const char *label = f == 0             ? m.condition[k]
                                : m.conditions > 1 ? arena_format(j->arena, "%s: %s", m.file, m.condition[k])
                                                   : m.file;
            report_set(&j->report, ":{ file:v", files[f]);
            report_similarity(j, label, m.condition[k], (const double *[]){own, judge_table_shares(&m, k, j->arena)},
                              m.classes);
            report_end(&j->report);
        }
    }
    report_end(&j->report);
    return true;
}

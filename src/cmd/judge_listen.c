/* rasp judge listen: a listener that is a program chooses among the classes that templates have, from sounds alone.
   A sound that is a template itself is judged without it. */
#include <math.h>
#include <string.h>

#include "analysis/machine_listener.h"
#include "base/text.h"
#include "cmd/judge.h"

struct sounds { /* sounds of one or several sets */
    int n;
    const char **file, **class, **condition;
    struct machine_listener_sound *sound;
};

/* The manifest of a set: its folder's, or the table itself. */
static const char *manifest_of(const char *set, struct arena *a)
{
    return text_ends_in(set, ".csv") ? set : arena_format(a, "%s/manifest.csv", set);
}

/* --where NAME=VALUE, all of them. */
static bool wanted(const struct judge *j, const struct csv *t, size_t row, bool *is, struct err *e)
{
    int n;
    char room[CSV_ROOM];
    const char **where = args_values(&j->call->args, "where", &n);
    *is = true;
    for (int i = 0; i < n; i++) {
        size_t length = strcspn(where[i], "=");
        const char *name = arena_format(j->arena, "%.*s", (int)length, where[i]);
        int column = csv_column(t, name);
        if (!where[i][length] || column < 0)
            return err_set(e, ERR_USAGE, "--where %s: %s", where[i],
                           where[i][length] ? arena_format(j->arena, "%s has no column '%s'", t->file, name)
                                            : "write COLUMN=VALUE");
        *is = *is && !strcmp(csv_text(t, row, column, room), where[i] + length + 1);
    }
    return true;
}

static bool hear(struct judge *j, const char *path, struct machine_listener_sound *s, struct err *e)
{
    struct arena *scratch = arena_open();
    struct wav w;
    bool ok = wav_read(path, scratch, &w, e) && machine_listener_hear(path, &w, j->arena, s, e);
    arena_close(scratch);
    return ok;
}

/* Adds a set's sounds; those of --where alone if `some`. */
static bool add(struct judge *j, const char *set, bool some, struct sounds *h, struct err *e)
{
    struct csv t;
    struct judge_factor class, condition;
    const char *file = manifest_of(set, j->arena), *factor = args_value(&j->call->args, "factor"),
               *end = strrchr(file, '/');
    const char *folder = end ? arena_format(j->arena, "%.*s/", (int)(end - file), file) : "";
    if (!csv_read(file, j->arena, &t, e)) return false;
    int played = csv_column(&t, factor ? factor : "motion"), name = csv_column(&t, "file_name"),
        of = judge_table_column(j, &t, "condition", false, e), before = h->n;
    if (played < 0 || name < 0)
        return err_set(e, ERR_SCENE, "%s: there is no column '%s'%s", file,
                       name < 0 ? "file_name"
                       : factor ? factor
                                : "motion",
                       name < 0 ? "" : ": --factor says which one names the classes");
    if (e->kind || !judge_table_factor(&t, played, j->arena, &class, e) ||
        !judge_table_factor(&t, of, j->arena, &condition, e))
        return false;
    for (size_t i = 0; i < t.rows; i++) {
        bool is = true;
        const char *sound = t.cells[i * t.columns + (size_t)name];
        if (some && !wanted(j, &t, i, &is, e)) return false;
        if (!is) continue;
        if (!*sound || !strcmp(sound, "n/a"))
            return err_set(e, ERR_SCENE, "%s:%d: column 'file_name': there is no sound: render the set whole", file,
                           t.lines[i]);
        h->file = arena_more(j->arena, h->file, h->n, sizeof *h->file);
        h->class = arena_more(j->arena, h->class, h->n, sizeof *h->class);
        h->condition = arena_more(j->arena, h->condition, h->n, sizeof *h->condition);
        h->sound = arena_more(j->arena, h->sound, h->n, sizeof *h->sound);
        h->file[h->n] = arena_format(j->arena, "%s%s", *sound == '/' ? "" : folder, sound);
        h->class[h->n] = class.levels[class.of_row[i]];
        h->condition[h->n] = condition.levels[condition.of_row[i]];
        if (!hear(j, h->file[h->n], &h->sound[h->n], e)) return err_at(e, "%s:%d", file, t.lines[i]);
        h->n++;
    }
    return h->n > before || err_set(e, ERR_SCENE, "%s: no row is as --where says", file);
}

/* Words in the order in which they come, each once. */
static const char **distinct(const char *const *words, int n, int *count, struct arena *a)
{
    const char **all = ARENA_TAKE(a, const char *, n + 1);
    *count = 0;
    for (int i = 0; i < n; i++)
        if (judge_place(all, *count, words[i]) < 0) all[(*count)++] = words[i];
    return all;
}

/* How far apart takes of one class are, by which the listener errs: of templates, or --spread. */
static bool spread_of(const struct judge *j, const struct sounds *t, double *spread, struct err *e)
{
    *spread = NAN;
    if (!args_number(&j->call->args, "spread", (const double[]){1e-6, 100}, spread, e)) return false;
    if (args_given(&j->call->args, "spread")) return true;
    *spread = machine_listener_spread(t->sound, t->n);
    return *spread > 0 ||
           err_set(e, ERR_SCENE,
                   "--templates: %s: give takes of other seeds, or say by --spread how far apart takes are",
                   isnan(*spread) ? "a class has one sound only" : "all takes of each class are the same");
}

static bool judge_all(struct judge *j, const struct sounds *s, const struct sounds *t, double spread,
                      struct judge_choices *m, struct err *e)
{
    int own = 0;
    double *share = ARENA_TAKE(j->arena, double, m->classes), nearest = 0;
    for (int i = 0; i < s->n; i++) {
        int skip = -1, left = 0, played = judge_place(m->class, m->classes, s->class[i]), best = 0;
        for (int k = 0; k < t->n; k++)
            if (cmd_same_file(s->file[i], t->file[k])) {
                if (skip >= 0)
                    return err_set(e, ERR_USAGE, "%s: is a template twice: name each set of templates once",
                                   s->file[i]);
                skip = k;
            }
        if (played < 0)
            return err_set(e, ERR_SCENE, "%s: no template is a '%s', which %s is", m->file, s->class[i], s -> file[i]);
        for (int k = 0; k < t->n; k++)
            left += k != skip && t->sound[k].class == played;
        if (!left)
            return err_set(e, ERR_SCENE, "%s: is the only template of '%s': it cannot be judged by itself", s->file[i],
                           s->class[i]);
        machine_listener_choose(&s->sound[i], t->sound, t->n, skip, m->classes, spread, share);
        double *row =
            m->cell + (judge_place(m->condition, m->conditions, s->condition[i]) * m->classes + played) * m->classes;
        for (int k = 0; k < m->classes; k++) {
            row[k] += share[k];
            if (share[k] > share[best]) best = k;
        }
        own += skip >= 0;
        nearest += best == played;
    }
    report_set(&j->report, "sounds:i templates:i are_templates:i spread:n nearest_right:n", s->n, t->n, own, spread,
               nearest / s->n);
    report_text(&j->report, "%s: %d sounds by %d templates%s; spread %.4g, nearest template right %.1f %%\n", m->file,
                s->n, t->n, own ? arena_format(j->arena, " (%d judged without itself)", own) : "", spread,
                100 * nearest / s->n);
    return true;
}

bool judge_listen_run(struct judge *j, struct err *e)
{
    struct sounds s = {0}, t = {0};
    struct judge_choices m = {.file = j->call->args.operands[0]};
    double spread;
    int n;
    const char **sets = args_values(&j->call->args, "templates", &n);
    if (!n) return err_set(e, ERR_USAGE, "--templates SET is needed: sounds whose class the listener knows");
    for (int i = 0; i < n; i++)
        if (!add(j, sets[i], true, &t, e)) return false;
    if (!add(j, m.file, false, &s, e)) return false;
    m.class = distinct(t.class, t.n, &m.classes, j->arena);
    m.condition = distinct(s.condition, s.n, &m.conditions, j->arena);
    if (!judge_table_open(j, &m, e)) return false;
    for (int i = 0; i < t.n; i++)
        t.sound[i].class = judge_place(m.class, m.classes, t.class[i]);
    if (!spread_of(j, &t, &spread, e) || !judge_all(j, &s, &t, spread, &m, e)) return false;
    for (int i = 0; i < m.conditions * m.classes; i++) {
        double sum = 0;
        for (int k = 0; k < m.classes; k++)
            sum += m.cell[i * m.classes + k];
        if (sum == 0)
            return err_set(e, ERR_SCENE, "%s: condition '%s' has no '%s': each needs every class", m.file,
                           m.condition[i / m.classes], m.class[i % m.classes]);
        for (int k = 0; k < m.classes; k++)
            m.cell[i * m.classes + k] /= sum;
    }
    return judge_choices_report(j, &m, e) && judge_table_write(j, &m, e);
}

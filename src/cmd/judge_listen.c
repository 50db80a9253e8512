/* rasp judge listen: a listener that is a program chooses among the classes that templates have, from sounds alone.
   A sound that is a template itself is judged without it. */
#include <math.h>
#include <string.h>

#include "analysis/choices.h"
#include "analysis/machine_listener.h"
#include "base/text.h"
#include "cmd/judge.h"

struct sounds { /* of one or several sets */
    int cue;    /* enum machine_listener_cue */
    int n, *condition;
    const char **file;
    struct machine_listener_sound *sound;
};

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

static bool listen(struct judge *j, const char *path, struct machine_listener_sound *s, struct err *e)
{
    struct arena *scratch = arena_open();
    struct wav w;
    bool ok = wav_read(path, scratch, &w, e) && machine_listener_hear(path, &w, j->arena, s, e);
    arena_close(scratch);
    return ok;
}

/* Adds a set's sounds to h: templates, of which those of --where count and name the classes, or what is judged, which
   names the conditions. */
static bool add(struct judge *j, const char *set, bool templates, struct judge_choices *m, struct sounds *h,
                struct err *e)
{
    struct csv t;
    struct judge_factor class, condition;
    struct arena *a = j->arena;
    const char *given = args_value(&j->call->args, "factor"), *factor = given ? given : "motion";
    const char *file = text_ends_in(set, ".csv") ? set : arena_format(a, "%s/manifest.csv", set);
    const char *end = strrchr(file, '/');
    int folder = end ? (int)(end + 1 - file) : 0;
    if (!csv_read(file, a, &t, e)) return false;
    int played = csv_column(&t, factor), name = csv_column(&t, "file_name"), before = h->n;
    if (name < 0) return err_set(e, ERR_SCENE, "%s: there is no column 'file_name'", file);
    if (played < 0)
        return err_set(e, ERR_SCENE, "%s: there is no column '%s': --factor says which one names the classes", file,
                       factor);
    if (!judge_table_role(j, &t, "condition", false, &condition, e) || !judge_table_factor(&t, played, a, &class, e))
        return false;
    for (size_t i = 0; i < t.rows; i++) {
        bool is = true;
        const char *sound = t.cells[i * t.columns + (size_t)name], *word = class.levels[class.of_row[i]];
        if (templates && !wanted(j, &t, i, &is, e)) return false;
        if (!is) continue;
        if (!*sound || !strcmp(sound, "n/a"))
            return err_set(e, ERR_SCENE, "%s:%d: column 'file_name': there is no sound: render the set whole", file,
                           t.lines[i]);
        if (*sound != '/') sound = arena_format(a, "%.*s%s", folder, file, sound);
        h->file = arena_more(a, h->file, h->n, sizeof *h->file);
        h->condition = arena_more(a, h->condition, h->n, sizeof *h->condition);
        h->sound = arena_more(a, h->sound, h->n, sizeof *h->sound);
        h->file[h->n] = sound;
        if (!listen(j, sound, &h->sound[h->n], e)) return err_at(e, "%s:%d", file, t.lines[i]);
        h->sound[h->n].cue = h->cue;
        if (templates)
            h->sound[h->n].class = judge_add(a, &m->class_name, &m->classes, word);
        else if ((h->sound[h->n].class = judge_place(m->class_name, m->classes, word)) < 0)
            return err_set(e, ERR_SCENE, "%s: no template is a '%s', which %s is: templates are needed of every class",
                           m->file, word, sound);
        else
            h->condition[h->n] = judge_add(a, &m->condition, &m->conditions, condition.levels[condition.of_row[i]]);
        h->n++;
    }
    return h->n > before || err_set(e, ERR_SCENE, "%s: no row matches --where", file);
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
        int skip = -1, others = 0, played = s->sound[i].class, best = 0;
        for (int k = 0; k < t->n; k++) {
            bool same = cmd_same_file(s->file[i], t->file[k]);
            if (same && skip >= 0)
                return err_set(e, ERR_USAGE, "%s: is a template twice: name each set of templates once", s->file[i]);
            if (same) skip = k;
            others += !same && t->sound[k].class == played;
        }
        if (!others)
            return err_set(e, ERR_SCENE, "%s: is the only template of '%s': it cannot be judged by itself", s->file[i],
                           m->class_name[played]);
        machine_listener_choose(&s->sound[i], t->sound, t->n, skip, m->classes, spread, share);
        double *row = judge_table_row(m, s->condition[i], played);
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
    return judge_table_whole(m, e);
}

bool judge_listen_run(struct judge *j, struct err *e)
{
    struct sounds s = {0}, t = {0};
    struct judge_choices m = {.file = j->call->args.operands[0]};
    double spread;
    int n;
    const char **sets = args_values(&j->call->args, "templates", &n);
    if (!n) return err_set(e, ERR_USAGE, "--templates SET is needed: sounds whose class the listener knows");
    if (!args_word(&j->call->args, "by", machine_listener_cues, &t.cue, e)) return false;
    s.cue = t.cue;
    for (int i = 0; i < n; i++)
        if (!add(j, sets[i], true, &m, &t, e)) return false;
    if (!add(j, m.file, false, &m, &s, e) || !judge_table_open(j, &m, e) || !spread_of(j, &t, &spread, e) ||
        !judge_all(j, &s, &t, spread, &m, e))
        return false;
    for (int c = 0; c < m.conditions; c++)
        choices_shares(judge_table_row(&m, c, 0), m.classes, judge_table_row(&m, c, 0));
    return judge_choices_report(j, &m, e) && judge_table_write(j, &m, e);
}

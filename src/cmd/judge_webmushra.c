/* Answers as webMUSHRA's service writes them, by page: mushra.csv (columns session_test_id, those of a questionnaire,
   session_uuid, trial_id, rating_stimulus, rating_score, rating_time, rating_comment), lms.csv and lss.csv
   (session_test_id, ..., trial_id, stimuli_rating, stimuli, rating_time; in some the answer has blanks around it). It
   knows sounds by name alone, and the reference of a page as "reference": what they are stands in the design. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "batch/batch.h"
#include "batch/trials.h"
#include "cmd/judge.h"
#include "cmd/message.h"

struct answers {
    const struct csv *from;
    const struct design *design;
    struct trials trials;
    int person, trial, sound, answer; /* columns */
};

static const char *cell(const struct answers *x, size_t row, int column)
{
    return x->from->cells[row * x->from->columns + (size_t)column];
}

static const char *trimmed(const char *text, struct arena *a)
{
    text += strspn(text, " ");
    size_t n = strlen(text);
    while (n > 0 && text[n - 1] == ' ')
        n--;
    return arena_format(a, "%.*s", (int)n, text);
}

/* The trial of a row, and which stimulus the row is of. ERR_SCENE */
static const struct trial *trial_of(const struct answers *x, size_t row, int *stimulus, bool *training, struct err *e)
{
    static const char practice[] = "training_", head[] = "trial_";
    const char *id = cell(x, row, x->trial), *name = cell(x, row, x->sound), *number = id;
    *training = !strncmp(number, practice, strlen(practice));
    if (*training) number += strlen(practice);
    long k = strncmp(number, head, strlen(head)) ? 0 : strtol(number + strlen(head), NULL, 10);
    const struct trial *t = k > 0 && k <= x->trials.n ? &x->trials.all[k - 1] : NULL;
    *stimulus = t && !strcmp(name, "reference") ? t->reference : -1;
    for (int i = 0; t && i < t->n; i++)
        if (!strcmp(x->design->stimuli[t->stimuli[i]].name, name)) *stimulus = t->stimuli[i];
    if (t && *stimulus >= 0) return t;
    err_set(e, ERR_SCENE, "%s:%d: '%s' has no sound '%s' in %s: is it the design that was exported?", x->from->file,
            x->from->lines[row], id, name, x->design->file);
    return NULL;
}

/* A sitting of several, NAME_p01_s2, is of one participant. */
static const char *person_of(const struct answers *x, size_t row, struct arena *a)
{
    const char *id = cell(x, row, x->person), *end = strrchr(id, '_');
    bool sitting = x->trials.n_sessions > 1 && end && end[1] == 's' && isdigit((unsigned char)end[2]);
    return sitting ? arena_format(a, "%.*s", (int)(end - id), id) : id;
}

/* As the table of a page of rasp export: participant, trial_id, training, stimulus_id, role, a column a factor, played,
   and the answer. */
static bool rows_make(const struct answers *x, struct csv *t, struct arena *a, struct err *e)
{
    const struct design *d = x->design;
    bool choose = d->trials->task == DESIGN_TASK_CHOOSE;
    static const char *const first[] = {"participant", "trial_id", "training", "stimulus_id", "role"};
    enum { FIRST = sizeof first / sizeof first[0] };
    t->columns = (size_t)(FIRST + d->n_factors + choose + 1);
    t->names = ARENA_TAKE(a, const char *, t->columns);
    t->cells = ARENA_TAKE(a, const char *, t->rows * t->columns);
    memcpy(t->names, first, sizeof first);
    for (int f = 0; f < d->n_factors; f++)
        t->names[FIRST + f] = d->factors[f].column;
    if (choose) t->names[FIRST + d->n_factors] = "played";
    t->names[t->columns - 1] = choose ? "chosen" : "rating";
    for (size_t i = 0; i < t->rows; i++) {
        const char **row = t->cells + i * t->columns;
        int stimulus, right;
        bool training;
        const struct trial *trial = trial_of(x, i, &stimulus, &training, e);
        if (!trial) return false;
        row[0] = person_of(x, i, a);
        row[1] = cell(x, i, x->trial);
        row[2] = training ? "1" : "0";
        row[3] = d->stimuli[stimulus].name;
        row[4] = design_trials_roles[d->trials->roles[stimulus]];
        for (int f = 0; f < d->n_factors; f++)
            row[FIRST + f] = design_value(d, stimulus, f);
        right = trials_right(&x->trials, trial);
        if (choose) row[FIRST + d->n_factors] = right < 0 ? "n/a" : d->trials->answers[right].label;
        row[t->columns - 1] = trimmed(cell(x, i, x->answer), a);
    }
    return true;
}

bool judge_webmushra(struct judge *j, struct csv *t, struct err *e)
{
    const char *file = args_value(&j->call->args, "design");
    const struct csv from = *t;
    struct batch_report r = {.messages = ""};
    struct answers x = {.from = &from, .design = &r.design, .person = csv_column(t, "session_test_id")};
    bool mushra = csv_column(t, "rating_stimulus") >= 0;
    const char *const needed[] = {"trial_id", mushra ? "rating_stimulus" : "stimuli",
                                  mushra ? "rating_score" : "stimuli_rating"};
    int *const columns[] = {&x.trial, &x.sound, &x.answer};
    for (int k = 0; k < 3; k++)
        if ((*columns[k] = csv_column(t, needed[k])) < 0)
            return err_set(e, ERR_SCENE, "%s: has session_test_id, as of webMUSHRA, but no column %s", t->file,
                           needed[k]);
    if (!file)
        return err_set(e, ERR_USAGE,
                       "%s is of webMUSHRA, which knows sounds by name alone: say by --design DESIGN what was exported",
                       t->file);
    message_group(j->call);
    if (!design_read(file, j->arena, &r.design, &r.messages, e)) {
        batch_message_unread(j->call, file, &r, e);
        return false;
    }
    if (!r.design.trials) return err_set(e, ERR_SCENE, "%s: has no trials", file);
    return trials_make(&r.design, j->arena, &x.trials, e) && rows_make(&x, t, j->arena, e);
}

/* `trials` of a design: what listeners do with the stimuli, once all else of it is known. trials.c makes
   the trials; here they are made to check that this is possible. Nothing that is rendered depends on them. */
#include <string.h>

#include "base/text.h"
#include "batch/design_reading.h"
#include "batch/trials.h"

const char *const design_trials_tasks[] = {"rate", "choose", "compare", NULL};
const char *const design_trials_roles[] = {"test", "reference", "anchor", NULL};

static const char cure[] = "write for instance: trials: {task: rate, question: How real is it?, within: [condition]}";

struct reading_trials {
    const struct design_reading *r;
    struct diag *diag;
    const struct yaml_node *map;
    struct design_trials *t;
};

static const struct yaml_node *value(const struct reading_trials *x, const char *key)
{
    const struct yaml_node *node = yaml_get(x->map, key);
    return node && yaml_null(node) ? NULL : node;
}

/* One line that listeners read; NULL: there is no node, or it is no line, which is reported. */
static const char *line(const struct reading_trials *x, const struct yaml_node *node, const char *label)
{
    if (!node) return NULL;
    bool good = node->kind == YAML_SCALAR && *node->text;
    for (const char *s = good ? node->text : ""; *s; s++)
        good = good && ((unsigned char)*s >= ' ' || (!s[1] && *s == '\n')) && *s != 127;
    if (!good) design_reading_must(x->r, node, label, "a text of one line", cure);
    return good ? arena_format(x->r->arena, "%.*s", (int)strcspn(node->text, "\n"), node->text) : NULL;
}

/* A factor by its name; -1: none is given, or it is wrong, which is reported. */
static int factor_of(const struct reading_trials *x, const struct yaml_node *node, const char *label)
{
    if (node && node->kind == YAML_SCALAR) return design_reading_factor(x->r, node);
    if (node) design_reading_must(x->r, node, label, "the name of a factor", cure);
    return -1;
}

static void within_read(const struct reading_trials *x)
{
    const struct yaml_node *node = value(x, "within");
    bool list = node && node->kind == YAML_LIST;
    for (const struct yaml_node *one = list ? node->first : node; one; one = list ? one->next : NULL) {
        int f = factor_of(x, one, "trials.within");
        if (f >= 0) x->t->within[f] = true;
    }
    if (x->t->task == DESIGN_TASK_CHOOSE && node)
        diag_add(x->diag, node->at, "leave it out", "a trial has one sound where listeners choose: no within");
    if (x->t->task == DESIGN_TASK_COMPARE && !node)
        diag_add(x->diag, x->map->at, cure, "trials.within must say in which factors two compared sounds differ");
}

/* The levels of a factor that sounds have, in order. */
static void answers_of_factor(const struct reading_trials *x, const struct yaml_node *node)
{
    struct design_trials *t = x->t;
    t->asked = factor_of(x, node, "trials.answers");
    if (t->task != DESIGN_TASK_CHOOSE)
        diag_add(x->diag, node->at, "write for instance: answers: [not at all, somewhat, exactly]",
                 "trials.answers can be a factor only where the task is to choose");
    if (t->asked < 0) return;
    const struct design_factor *factor = &x->r->design->factors[t->asked];
    t->answers = ARENA_TAKE(x->r->arena, struct design_answer, factor->n_levels + 1);
    for (const struct design_level *l = factor->levels; l < factor->levels + factor->n_levels; l++)
        if (!l->recorded) t->answers[t->n_answers++] = (struct design_answer){l->label, l->text ? l->text : l->label};
}

/* A list of texts, or, not given, those that the task usually has. */
static void answers_of_list(const struct reading_trials *x, const struct yaml_node *node)
{
    static const char *const usual[][6] = {[DESIGN_TASK_RATE] = {"Bad", "Poor", "Fair", "Good", "Excellent"},
                                           [DESIGN_TASK_CHOOSE] = {NULL},
                                           [DESIGN_TASK_COMPARE] = {"A", "equal", "B"}};
    struct design_trials *t = x->t;
    t->answers = ARENA_TAKE(x->r->arena, struct design_answer, node ? node->n + 1 : 6);
    for (const char *const *text = usual[t->task]; !node && *text; text++)
        t->answers[t->n_answers++] = (struct design_answer){*text, *text};
    if (node && node->kind != YAML_LIST) design_reading_must(x->r, node, "trials.answers", "a list of texts", cure);
    for (const struct yaml_node *one = node && node->kind == YAML_LIST ? node->first : NULL; one; one = one->next) {
        const char *text = line(x, one, "an entry of trials.answers");
        for (int i = 0; text && i < t->n_answers; i++)
            if (!strcmp(t->answers[i].label, text))
                diag_add(x->diag, one->at, "remove one of them", "the answer '%s' is there twice", text);
        if (text) t->answers[t->n_answers++] = (struct design_answer){text, text};
    }
    if (t->task != DESIGN_TASK_COMPARE) return;
    if (node && t->n_answers != 2 && t->n_answers != 3)
        diag_add(x->diag, node->at, "write for instance: answers: [A is larger, the same, B is larger]",
                 "of two sounds there are two or three answers: A, neither perhaps, B");
    for (int i = 0; i < t->n_answers; i++)
        t->answers[i].label = i == t->n_answers - 1 ? "B>A" : i == 0 ? "A>B" : "A=B";
}

/* Which stimuli an entry of the list picks; it has *n. */
static bool *picked(const struct reading_trials *x, const char *key, int *n)
{
    const struct design *d = x->r->design;
    const char *label = arena_format(x->r->arena, "trials.%s", key);
    bool *is = ARENA_TAKE(x->r->arena, bool, d->n_stimuli + 1);
    struct design_match *all = design_rows_matches(x->r, value(x, key), label, n);
    for (int i = 0; *n > 0 && i < d->n_stimuli && x->diag->n == 0; i++)
        is[i] = design_rows_match(d, d->stimuli[i].level, all, *n);
    for (int i = 0; i < *n && x->diag->n == 0; i++)
        if (!all[i].matched)
            diag_add(x->diag, all[i].entry->at, "remove it, or mend it", "%s: no stimulus has these levels", label);
    return is;
}

static void role_read(const struct reading_trials *x, enum design_role role, const char *key)
{
    int n;
    const bool *is = picked(x, key, &n);
    for (int i = 0; i < x->r->design->n_stimuli; i++)
        if (is[i]) x->t->roles[i] = role;
    if (n > 0 && (x->t->task != DESIGN_TASK_RATE || !value(x, "within")))
        diag_add(x->diag, value(x, key)->at, "leave it out",
                 "trials.%s: only a trial in which several sounds are rated (task: rate, within) has such", key);
}

static void training_read(const struct reading_trials *x)
{
    const struct yaml_node *node = value(x, "training");
    if (!node || node->kind != YAML_SCALAR)
        x->t->for_training = picked(x, "training", &(int){0});
    else if (!text_int(node->text, 0, 1000, &x->t->training))
        design_reading_must(x->r, node, "trials.training",
                            "a number of trials from 0 to 1000, or a list of maps of levels",
                            "write for instance: training: 3");
}

void design_trials_read(struct design_reading *r)
{
    static const char *const names[] = {"task",    "question", "instructions", "within", "answers", "reference",
                                        "anchors", "training", "session",      "blocks", NULL};
    const struct yaml_node *map = design_reading_value(r, "trials"), *task = map ? yaml_get(map, "task") : NULL;
    struct diag *diag = r->yaml->diag;
    struct trials all;
    struct err e = {0};
    int k = 0;
    if (!map) return;
    if (map->kind != YAML_MAP) {
        design_reading_must(r, map, "trials", "a map", cure);
        return;
    }
    design_reading_known(r, map, names, " in trials");
    while (task && task->kind == YAML_SCALAR && design_trials_tasks[k] && strcmp(design_trials_tasks[k], task->text))
        k++;
    if (!task)
        diag_add(diag, map->at, cure, "trials.task is missing: rate, choose or compare");
    else if (task->kind != YAML_SCALAR || !design_trials_tasks[k])
        design_reading_must(r, task, "trials.task", "rate, choose or compare", cure);
    if (diag->n) return;
    struct design_trials *t = ARENA_TAKE(r->arena, struct design_trials, 1);
    const struct reading_trials x = {r, diag, map, t};
    const struct yaml_node *answers = value(&x, "answers");
    *t = (struct design_trials){.task = (enum design_task)k, .asked = -1};
    t->question = line(&x, value(&x, "question"), "trials.question");
    t->instructions = line(&x, value(&x, "instructions"), "trials.instructions");
    t->session = factor_of(&x, value(&x, "session"), "trials.session");
    t->block = factor_of(&x, value(&x, "blocks"), "trials.blocks");
    t->within = ARENA_TAKE(r->arena, bool, r->design->n_factors + 1);
    t->roles = ARENA_TAKE(r->arena, enum design_role, r->design->n_stimuli + 1);
    t->for_training = ARENA_TAKE(r->arena, bool, r->design->n_stimuli + 1);
    within_read(&x);
    if (answers && answers->kind == YAML_SCALAR)
        answers_of_factor(&x, answers);
    else
        answers_of_list(&x, answers);
    if (t->n_answers < 2 && diag->n == 0)
        diag_add(diag, answers ? answers->at : map->at,
                 "write answers: [rubbing, scratching], or the factor whose levels they are: answers: material",
                 "trials.answers must be two answers at least");
    role_read(&x, DESIGN_ROLE_ANCHOR, "anchors");
    role_read(&x, DESIGN_ROLE_REFERENCE, "reference");
    training_read(&x);
    if ((t->session >= 0 && t->within[t->session]) || (t->block >= 0 && t->within[t->block]))
        diag_add(diag, map->at, "leave it out of within",
                 "a factor of sessions or blocks cannot differ within a trial");
    r->design->trials = t;
    if (diag->n == 0 && !trials_make(r->design, r->arena, &all, &e)) diag_add(diag, map->key->at, NULL, "%s", e.text);
}

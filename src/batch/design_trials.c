/* `trials` of a design: what listeners do with the stimuli, once all else of it is known. The trials themselves are
   made of it by trials.c, here to see that it can be done; nothing that is rendered depends on it. */
#include <string.h>

#include "base/text.h"
#include "batch/design_reading.h"
#include "batch/trials.h"

const char *const design_trials_tasks[] = {"rate", "choose", "compare", NULL};
const char *const design_trials_roles[] = {"test", "reference", "anchor", NULL};

static const char cure[] = "write for instance: trials: {task: rate, question: How real is it?, within: [condition]}";

struct reading_trials {
    const struct design_reading *r;
    const struct yaml_node *map;
    struct design_trials *t;
};

static const struct yaml_node *value(const struct reading_trials *x, const char *key)
{
    const struct yaml_node *node = yaml_get(x->map, key);
    return node && yaml_null(node) ? NULL : node;
}

/* One line that listeners read; NULL: it is none, which is reported. */
static const char *line(const struct reading_trials *x, const struct yaml_node *node, const char *label)
{
    bool good = node->kind == YAML_SCALAR && *node->text;
    for (const char *s = good ? node->text : ""; *s; s++)
        good = good && ((unsigned char)*s >= ' ' || (!s[1] && *s == '\n')) && *s != 127;
    if (!good) {
        design_reading_must(x->r, node, label, "a text of one line", cure);
        return NULL;
    }
    return arena_format(x->r->arena, "%.*s", (int)strcspn(node->text, "\n"), node->text);
}

static const char *line_of(const struct reading_trials *x, const char *key)
{
    const struct yaml_node *node = value(x, key);
    return node ? line(x, node, arena_format(x->r->arena, "trials.%s", key)) : NULL;
}

/* A factor by its name; -1: none is given, or it is wrong, which is reported. */
static int factor_of(const struct reading_trials *x, const struct yaml_node *node, const char *label)
{
    if (!node) return -1;
    if (node->kind == YAML_SCALAR) return design_reading_factor(x->r, node);
    design_reading_must(x->r, node, label, "the name of a factor", cure);
    return -1;
}

static void within_read(const struct reading_trials *x)
{
    const struct yaml_node *node = value(x, "within");
    x->t->within = ARENA_TAKE(x->r->arena, bool, x->r->design->n_factors + 1);
    for (const struct yaml_node *one = node && node->kind == YAML_LIST ? node->first : node; one; one = one->next) {
        int f = factor_of(x, one, "trials.within");
        if (f >= 0) x->t->within[f] = true;
        if (one == node) break;
    }
    if (x->t->task == DESIGN_TASK_CHOOSE && node)
        diag_add(x->r->yaml->diag, node->at, "leave it out", "a trial has one sound where listeners choose: no within");
    if (x->t->task == DESIGN_TASK_COMPARE && !node)
        diag_add(x->r->yaml->diag, x->map->at, cure,
                 "trials.within must say in which factors two compared sounds differ");
}

static void answers_read(const struct reading_trials *x)
{
    static const char *const scale[] = {"Bad", "Poor", "Fair", "Good", "Excellent", NULL}, *const pair[] = {
                                                                                               "A", "equal", "B", NULL};
    struct arena *a = x->r->arena;
    const struct yaml_node *node = value(x, "answers");
    struct design_trials *t = x->t;
    if (node && node->kind == YAML_SCALAR) { /* the levels of a factor that sounds have, in order */
        int f = factor_of(x, node, "trials.answers");
        const struct design_factor *factor = f < 0 ? NULL : &x->r->design->factors[f];
        t->asked = f;
        if (t->task != DESIGN_TASK_CHOOSE)
            diag_add(x->r->yaml->diag, node->at, "write for instance: answers: [not at all, somewhat, exactly]",
                     "trials.answers can be a factor only where the task is to choose");
        t->answers = ARENA_TAKE(a, struct design_answer, factor ? factor->n_levels + 1 : 1);
        for (int i = 0; factor && i < factor->n_levels; i++) {
            const struct design_level *l = &factor->levels[i];
            if (!l->recorded)
                t->answers[t->n_answers++] = (struct design_answer){l->label, l->text ? l->text : l->label};
        }
    } else {
        const char *const *standard = t->task == DESIGN_TASK_COMPARE ? pair : scale;
        t->answers = ARENA_TAKE(a, struct design_answer, node ? node->n + 1 : 5);
        if (node && node->kind != YAML_LIST) design_reading_must(x->r, node, "trials.answers", "a list of texts", cure);
        for (const struct yaml_node *one = node ? node->first : NULL; one && node->kind == YAML_LIST; one = one->next) {
            const char *text = line(x, one, "an entry of trials.answers");
            for (int i = 0; text && i < t->n_answers; i++)
                if (!strcmp(t->answers[i].label, text))
                    diag_add(x->r->yaml->diag, one->at, "remove one of them", "the answer '%s' is there twice", text);
            if (text) t->answers[t->n_answers++] = (struct design_answer){text, text};
        }
        if (node && t->task == DESIGN_TASK_COMPARE && t->n_answers != 2 && t->n_answers != 3)
            diag_add(x->r->yaml->diag, node->at, "write for instance: answers: [A is larger, the same, B is larger]",
                     "of two sounds there are two or three answers: A, neither perhaps, B");
        for (; !node && t->task != DESIGN_TASK_CHOOSE && standard[t->n_answers]; t->n_answers++)
            t->answers[t->n_answers] = (struct design_answer){standard[t->n_answers], standard[t->n_answers]};
        for (int i = 0; t->task == DESIGN_TASK_COMPARE && i < t->n_answers; i++)
            t->answers[i].label = i == t->n_answers - 1 ? "B>A" : i == 0 ? "A>B" : "A=B";
    }
    if (t->n_answers < 2 && x->r->yaml->diag->n == 0)
        diag_add(x->r->yaml->diag, node ? node->at : x->map->at,
                 "write answers: [rubbing, scratching], or the factor whose levels they are: answers: material",
                 "trials.answers must be two answers at least");
}

/* Stimuli that an entry of the list picks have that role; DESIGN_ROLE_TEST: they are for training. */
static void role_read(const struct reading_trials *x, enum design_role role, const char *key)
{
    const struct design *d = x->r->design;
    const struct yaml_node *list = value(x, key);
    const char *label = arena_format(x->r->arena, "trials.%s", key);
    bool training = role == DESIGN_ROLE_TEST;
    int n;
    if (list && list->kind == YAML_SCALAR && training) {
        if (!text_int(list->text, 0, 1000, &x->t->training))
            design_reading_must(x->r, list, label, "a number of trials from 0 to 1000, or a list of maps of levels",
                                "write for instance: training: 3");
        return;
    }
    struct design_match *all = design_rows_matches(x->r, list, label, &n);
    for (int i = 0; i < d->n_stimuli && x->r->yaml->diag->n == 0; i++)
        if (n > 0 && design_rows_match(d, d->stimuli[i].level, all, n)) {
            if (training)
                x->t->for_training[i] = true;
            else
                x->t->roles[i] = role;
        }
    for (int i = 0; i < n && x->r->yaml->diag->n == 0; i++)
        if (!all[i].matched)
            diag_add(x->r->yaml->diag, all[i].entry->at, "remove it, or mend it", "%s: no stimulus is so", label);
    if (n > 0 && !training && (x->t->task != DESIGN_TASK_RATE || !value(x, "within")))
        diag_add(x->r->yaml->diag, list->at, "leave it out",
                 "%s: only a trial in which several sounds are rated (task: rate, within) has such", label);
}

void design_trials_read(struct design_reading *r)
{
    static const char *const names[] = {"task",    "question", "instructions", "within", "answers", "reference",
                                        "anchors", "training", "session",      "blocks", NULL};
    const struct yaml_node *map = design_reading_value(r, "trials"), *task = map ? yaml_get(map, "task") : NULL;
    struct design_trials *t = ARENA_TAKE(r->arena, struct design_trials, 1);
    const struct reading_trials x = {r, map, t};
    struct trials all;
    struct err e = {0};
    int k = 0;
    if (!map) return;
    if (map->kind != YAML_MAP) {
        design_reading_must(r, map, "trials", "a map", cure);
        return;
    }
    design_reading_known(r, map, names, " in trials");
    while (task && task->kind == YAML_SCALAR && design_trials_tasks[k] &&
           strcmp(design_trials_tasks[k], task->text) != 0)
        k++;
    if (!task)
        diag_add(r->yaml->diag, map->at, cure, "trials.task is missing: rate, choose or compare");
    else if (task->kind != YAML_SCALAR || !design_trials_tasks[k])
        design_reading_must(r, task, "trials.task", "rate, choose or compare", cure);
    if (r->yaml->diag->n) return;
    *t = (struct design_trials){.task = (enum design_task)k, .asked = -1};
    t->question = line_of(&x, "question");
    t->instructions = line_of(&x, "instructions");
    t->session = factor_of(&x, value(&x, "session"), "trials.session");
    t->block = factor_of(&x, value(&x, "blocks"), "trials.blocks");
    t->roles = ARENA_TAKE(r->arena, enum design_role, r->design->n_stimuli + 1);
    t->for_training = ARENA_TAKE(r->arena, bool, r->design->n_stimuli + 1);
    within_read(&x);
    answers_read(&x);
    role_read(&x, DESIGN_ROLE_ANCHOR, "anchors");
    role_read(&x, DESIGN_ROLE_REFERENCE, "reference");
    role_read(&x, DESIGN_ROLE_TEST, "training");
    if ((t->session >= 0 && t->within[t->session]) || (t->block >= 0 && t->within[t->block]))
        diag_add(r->yaml->diag, map->at, "leave it out of within",
                 "a factor of sessions or blocks cannot differ within a trial");
    r->design->trials = t;
    if (r->yaml->diag->n == 0 && !trials_make(r->design, r->arena, &all, &e))
        diag_add(r->yaml->diag, map->key->at, NULL, "%s", e.text);
}

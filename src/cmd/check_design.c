/* See check_design.h. What rasp batch finds out before it renders anything, and what it leaves to the rendering: whether a promised error can be kept. */
#include "cmd/check_design.h"

#include <string.h>

#include "batch/batch.h"
#include "cmd/batch.h"
#include "cmd/tell.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

struct broken {             /* promises that cannot be kept */
    struct prepare_fault *faults;
    int n, stimuli, worst;
};

/* Whether the promise of stimulus i can be kept; its error is told with its place. */
static bool promise_kept(const struct design *d, int i, struct arena *a, struct err *e)
{
    struct scene s, kept;
    const char *messages;
    bool ok = design_scene(d, i, a, &s, &messages, e);
    if (ok)
        design_scene_places(d, &s, a);
    return ok && (promise_keep(&s, a, &kept, NULL, e) || scene_places_tell(&s, e));
}

/* Of a cell, with all its replicates. */
static void note(struct broken *b, const struct design *d, const char *name, const struct err *e, struct arena *a)
{
    int k = 0;
    while (k < b->n && strcmp(b->faults[k].err->text, e->text) != 0)
        k++;
    if (k == b->n) {
        struct err *own = ARENA_TAKE(a, struct err, 1);
        *own = *e;
        b->faults[b->n++] = (struct prepare_fault){.messages = "", .err = own, .name = name};
    }
    b->faults[k].n += d->replicates;
    b->stimuli += d->replicates;
    b->worst = (int)e->kind > b->worst ? (int)e->kind : b->worst;
}

/* The first of each cell is looked at: others differ in their noise alone. */
static bool promises_kept(struct cmd_call *c, const char *file, const struct design *d, struct err *e)
{
    struct broken b = {.faults = ARENA_TAKE(c->arena, struct prepare_fault, d->n_stimuli)};
    for (int i = 0; i < d->n_stimuli; i++) {
        const struct design_stimulus *x = &d->stimuli[i];
        struct err cause = {0};
        struct arena *a = arena_open();
        if (!x->recording && x->replicate == 1 && !promise_kept(d, i, a, &cause))
            note(&b, d, x->name, &cause, c->arena);
        arena_close(a);
    }
    batch_tell_faults(c, "check", file, &(struct prepare){.faults = b.faults, .n_faults = b.n});
    return !b.stimuli || err_set(e, (enum err_kind)b.worst, "%s: %d of %d stimuli cannot be rendered", file, b.stimuli, d->n_stimuli);
}

/* What is wrong is told, and what it comes to is set. */
static void tell_wrong(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    struct err cause = *e;
    if (*r->messages) {
        batch_tell_unread(c, file, r, e);
        return;
    }
    batch_tell_faults(c, "check", file, &r->prepare);
    *e = (struct err){0};
    err_set(e, cause.kind, "%s: %s", file, cause.text);
}

bool check_design(struct cmd_call *c, const char *file, const char **remark, struct err *e)
{
    if (args_given(&c->args, "set") || args_given(&c->args, "seed"))
        return err_set(e, ERR_USAGE, "%s is a design: --set and --seed change scenes; write set: and seed: into it", file);
    struct batch_report r;
    bool ok = batch_run(&(struct batch_ask){.design = file, .build = "", .threads = batch_cores(), .shard = {1, 1}, .dry = true, .quiet = true}, c->arena, &r, e);
    if (!ok)
        tell_wrong(c, file, &r, e);
    else if ((ok = promises_kept(c, file, &r.design, e)))
        *remark = lengths_told(&r.prepare.own, &r.design, c->arena);
    batch_close(&r);
    return ok;
}

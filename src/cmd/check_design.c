/* See check_design.h. What rasp batch finds out before it renders anything, and what it leaves to the rendering: whether a promised error can be kept. */
#include "cmd/check_design.h"

#include <string.h>

#include "batch/batch.h"
#include "cmd/batch.h"
#include "cmd/tell.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

struct broken {                 /* promises that cannot be kept */
    struct prepare_fault *faults;
    int n, worst, *of_cell;     /* of_cell: from 1; 0: it is kept */
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

static void note(struct broken *b, const struct design_stimulus *x, const struct err *e, struct arena *a)
{
    int k = 0;
    while (k < b->n && strcmp(b->faults[k].err->text, e->text) != 0)
        k++;
    if (k == b->n) {
        struct err *own = ARENA_TAKE(a, struct err, 1);
        *own = *e;
        b->faults[b->n++] = (struct prepare_fault){.messages = "", .err = own, .name = x->name};
    }
    b->of_cell[x->cell] = k + 1;
    b->worst = (int)e->kind > b->worst ? (int)e->kind : b->worst;
}

/* The first of each cell is looked at: others differ in their noise alone. */
static bool promises_kept(struct cmd_call *c, const char *file, const struct design *d, struct err *e)
{
    long cells = 0;
    for (int i = 0; i < d->n_stimuli; i++)
        cells = d->stimuli[i].cell >= cells ? d->stimuli[i].cell + 1 : cells;
    struct broken b = {.faults = ARENA_TAKE(c->arena, struct prepare_fault, d->n_stimuli), .of_cell = ARENA_TAKE(c->arena, int, cells)};
    int broken = 0;
    for (int i = 0; i < d->n_stimuli; i++) {
        const struct design_stimulus *x = &d->stimuli[i];
        struct err cause = {0};
        struct arena *a = arena_open();
        if (!x->recording && x->replicate == 1 && !promise_kept(d, i, a, &cause))
            note(&b, x, &cause, c->arena);
        arena_close(a);
    }
    for (int i = 0; i < d->n_stimuli; i++) {
        int k = d->stimuli[i].recording ? 0 : b.of_cell[d->stimuli[i].cell];
        if (k)
            b.faults[k - 1].n++;
        broken += k > 0;
    }
    batch_tell_faults(c, "check", file, &(struct prepare){.faults = b.faults, .n_faults = b.n});
    return !broken || err_set(e, (enum err_kind)b.worst, "%s: %d of %d stimuli cannot be rendered", file, broken, d->n_stimuli);
}

/* What is wrong is told, and what it comes to is set. */
static void tell_wrong(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    struct err cause = *e;
    *e = (struct err){0};
    if (*r->messages) {
        tell_scene(c, r->design.diag, r->messages, cause.kind);
        err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_INPUT ? "cannot be read" : "is not a valid design");
        return;
    }
    batch_tell_faults(c, "check", file, &r->prepare);
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

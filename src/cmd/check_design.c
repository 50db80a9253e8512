/* See check_design.h. What rasp batch finds out before it renders anything, and what it leaves to the rendering: whether a promised error can be kept. */
#include "cmd/check_design.h"

#include "batch/batch.h"
#include "cmd/batch.h"
#include "cmd/tell.h"
#include "pipeline/promise.h"

/* The first of each cell: others differ in their noise alone. */
static bool promises_kept(const struct design *d, struct err *e)
{
    bool ok = true;
    for (int i = 0; ok && i < d->n_stimuli; i++) {
        struct arena *a = arena_open();
        struct scene s, kept;
        const char *messages;
        struct err cause = {0};
        if (!d->stimuli[i].recording && d->stimuli[i].replicate == 1)
            ok = design_scene(d, i, a, &s, &messages, &cause) && promise_keep(&s, a, &kept, NULL, &cause);
        if (!ok)
            err_set(e, cause.kind, "%s (%s)", cause.text, d->stimuli[i].name);
        arena_close(a);
    }
    return ok;
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
    else if ((ok = promises_kept(&r.design, e)))
        *remark = lengths_told(&r.prepare.own, &r.design, c->arena);
    batch_close(&r);
    return ok;
}

/* See check_design.h. What rasp batch finds out before it renders anything, and what it leaves to the rendering:
 * whether a promised error can be kept. */
#include "cmd/check_design.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "batch/batch.h"
#include "batch/pool.h"
#include "cmd/batch.h"
#include "cmd/tell.h"
#include "num/resample.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

struct promises {
    const struct design *design;
    struct err **broken; /* [n_stimuli] by malloc, until it is taken; NULL: kept, or none is made */
    struct set_fault *faults;
    int n, stimuli, worst;
    struct arena *arena;
};

/* Whether the promise of stimulus i can be kept; its error is told with its place. */
static bool is_kept(const struct design *d, int i, struct arena *a, struct err *e)
{
    struct scene s, kept;
    const char *messages;
    bool ok = design_scene(d, i, a, &s, &messages, e);
    if (ok)
        design_scene_places(d, &s, a);
    return ok && (promise_keep(&s, a, &kept, NULL, e) || scene_places_tell(&s, e));
}

static bool look(void *context, int i)
{
    struct promises *p = context;
    struct err e = {0};
    struct arena *a = arena_open();
    if (!p->design->stimuli[i].recording && !is_kept(p->design, i, a, &e))
        *(p->broken[i] = memory_take(sizeof e)) = e;
    arena_close(a);
    return true;
}

static void note(struct promises *p, const char *name, const struct err *e)
{
    int k = 0;
    while (k < p->n && strcmp(p->faults[k].err->text, e->text) != 0)
        k++;
    if (k == p->n) {
        struct err *own = ARENA_TAKE(p->arena, struct err, 1);
        *own = *e;
        p->faults[p->n++] = (struct set_fault){.messages = "", .err = own, .name = name};
    }
    p->faults[k].n++;
    p->stimuli++;
    p->worst = (int)e->kind > p->worst ? (int)e->kind : p->worst;
}

static void took(void *context, int i)
{
    struct promises *p = context;
    if (p->broken[i])
        note(p, p->design->stimuli[i].name, p->broken[i]);
    free(p->broken[i]);
    p->broken[i] = NULL;
}

/* Each is looked at, replicates too: an error is measured with the noise that is there. */
static bool promises_kept(struct cmd_call *c, const char *file, const struct design *d, struct err *e)
{
    struct promises p = {.design = d,
                         .broken = ARENA_TAKE(c->arena, struct err *, d->n_stimuli),
                         .faults = ARENA_TAKE(c->arena, struct set_fault, d->n_stimuli),
                         .arena = c->arena};
    resample_prepare();
    pool_run(
        &(struct pool_work){.n = d->n_stimuli, .threads = batch_cores(), .context = &p, .job = look, .took = took});
    batch_tell_faults(c, "check", file, &(struct set_plan){.faults = p.faults, .n_faults = p.n});
    return !p.stimuli ||
           err_set(e, (enum err_kind)p.worst, "%s: %d of %d stimuli cannot be rendered", file, p.stimuli, d->n_stimuli);
}

/* What is wrong is told, and what it comes to is set. */
static void tell_wrong(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    struct err cause = *e;
    if (*r->messages) {
        batch_tell_unread(c, file, r, e);
        return;
    }
    batch_tell_faults(c, "check", file, &r->plan);
    *e = (struct err){0};
    err_set(e, cause.kind, "%s: %s", file, cause.text);
}

bool check_design(struct cmd_call *c, const char *file, const char **remark, struct err *e)
{
    if (args_given(&c->args, "set") || args_given(&c->args, "seed"))
        return err_set(e, ERR_USAGE, "%s is a design: --set and --seed change scenes; write set: and seed: into it",
                       file);
    struct batch_report r;
    bool ok = batch_run(
        &(struct batch_ask){
            .design = file, .program = "", .threads = batch_cores(), .shard = {1, 1}, .dry = true, .quiet = true},
        c->arena, &r, e);
    batch_tell_warnings(c, &r.plan);
    if (!ok)
        tell_wrong(c, file, &r, e);
    else if ((ok = promises_kept(c, file, &r.design, e)))
        *remark = set_lengths_text(&r.set, &r.plan, c->arena);
    batch_close(&r);
    return ok;
}

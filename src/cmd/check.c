/* rasp check: what can be known to be wrong with a scene or a design before anything is computed. Of a design: what
   rasp batch finds out before it renders anything, and what it leaves to the rendering, whether a promised error can be
   kept. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "batch/batch.h"
#include "batch/design.h"
#include "batch/pool.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/report.h"
#include "num/resample.h"
#include "pipeline/error_budget.h"
#include "pipeline/plan.h"
#include "scene/accuracy.h"
#include "scene/scene_places.h"

struct promises {
    const struct design *design;
    struct err **broken; /* [n_stimuli] by malloc, until it is taken; NULL: kept, or none is made */
    struct set_fault *faults;
    int n, stimuli, worst;
    struct arena *arena;
};

/* Whether stimulus i can have the error that it asks for; if not, that is reported with its place. */
static bool look(void *context, int i)
{
    struct promises *p = context;
    struct err e = {0};
    struct arena *a = arena_open();
    struct scene s, chosen;
    const char *messages;
    bool ok = p->design->stimuli[i].recording;
    if (!ok && design_scene(p->design, i, a, &s, &messages, &e)) {
        design_scene_places(p->design, &s, a);
        ok = isnan(s.accuracy.error) || error_budget_apply(&s, a, &chosen, NULL, &e) || scene_places_report(&s, &e);
    }
    if (!ok) *(p->broken[i] = memory_take(sizeof e)) = e;
    arena_close(a);
    return true;
}

/* A broken promise that many stimuli have is one fault. */
static void took(void *context, int i)
{
    struct promises *p = context;
    const struct err *e = p->broken[i];
    int k = 0;
    if (!e) return;
    while (k < p->n && strcmp(p->faults[k].err->text, e->text) != 0)
        k++;
    if (k == p->n) {
        struct err *own = ARENA_TAKE(p->arena, struct err, 1);
        *own = *e;
        p->faults[p->n++] = (struct set_fault){.messages = "", .err = own, .name = p->design->stimuli[i].name};
    }
    p->faults[k].n++;
    p->stimuli++;
    p->worst = (int)e->kind > p->worst ? (int)e->kind : p->worst;
    free(p->broken[i]);
    p->broken[i] = NULL;
}

/* Reads the design and the scene of every stimulus, as far as can be known before rendering. A fault that many stimuli
   have is reported once. *remark: what is worth knowing of a design without fault, or NULL. */
static bool check_design(struct cmd_call *c, const char *file, const char **remark, struct err *e)
{
    if (args_given(&c->args, "set") || args_given(&c->args, "seed"))
        return err_set(e, ERR_USAGE, "%s is a design: --set and --seed change scenes; write set: and seed: into it",
                       file);
    struct batch_report r;
    bool ok = batch_run(
        &(struct batch_ask){
            .design = file, .program = "", .threads = batch_cores(), .shard = {1, 1}, .dry = true, .quiet = true},
        c->arena, &r, e);
    batch_message_warnings(c, &r.plan);
    if (!ok && *r.messages)
        batch_message_unread(c, file, &r, e);
    else if (!ok) {
        struct err cause = *e;
        batch_message_faults(c, "check", file, &r.plan);
        *e = (struct err){0};
        err_set(e, cause.kind, "%s: %s", file, cause.text);
    } else { /* each is looked at, replicates too: an error is measured with the noise that is there */
        int n = r.design.n_stimuli;
        struct promises p = {.design = &r.design,
                             .broken = ARENA_TAKE(c->arena, struct err *, n),
                             .faults = ARENA_TAKE(c->arena, struct set_fault, n),
                             .arena = c->arena};
        resample_prepare();
        pool_run(&(struct pool_work){.n = n, .threads = batch_cores(), .context = &p, .job = look, .took = took});
        batch_message_faults(c, "check", file, &(struct set_plan){.faults = p.faults, .n_faults = p.n});
        ok = !p.stimuli ||
             err_set(e, (enum err_kind)p.worst, "%s: %d of %d stimuli cannot be rendered", file, p.stimuli, n);
        if (ok) *remark = set_lengths_text(&r.set, &r.plan, c->arena);
    }
    batch_close(&r);
    return ok;
}

static int check_run(struct cmd_call *c, struct err *e)
{
    int worst = 0;
    struct report r = report_open_list(stdout, args_given(&c->args, "json"));
    for (int i = 0; i < c->args.n_operands; i++) {
        struct err mine = {0};
        const char *remark = NULL, *name = text_shown(c->arena, c->args.operands[i]);
        if (r.json) message_collect(c);
        const char *file = c->args.operands[i];
        struct plan_scene_estimate x = {.warnings = NULL};
        struct scene s, chosen;
        if (design_is(file))
            check_design(c, file, &remark, &mine);
        else if (cmd_read_scene(c, file, &s, &mine)) {
            bool asked = !isnan(s.accuracy.error);
            if (!asked) chosen = accuracy_coarsest(&s);
            if ((asked && !error_budget_apply(&s, c->arena, &chosen, NULL, &mine)) ||
                !plan_scene(&chosen, c->arena, &x, &mine))
                scene_places_report(&s, &mine);
        }
        for (int k = 0; !mine.kind && x.warnings && x.warnings[k]; k++)
            message_warning(c, file, x.warnings[k]);
        if (mine.kind)
            message_error(c, "check", &mine);
        else
            report_text(&r, "%s: ok\n", name);
        if (remark) report_text(&r, "%s: %s\n", name, remark);
        if (r.json)
            report_set(&r, ":{ file:s ok:b code:i errors:o }", name, mine.kind == ERR_NONE, (int)mine.kind,
                       message_collected(c));
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
    }
    return !report_close(&r, 0, e) ? (int)e->kind : worst;
}

static const struct args_option options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false,
     "print an array with a row for each scene on standard output: file, ok, exit code, errors as of "
     "--diagnostics=json"},
    {0},
};

const struct command check_command = {
    .name = "check",
    .summary = "finds what is wrong with scenes, without rendering them",
    .does = "Reads each scene and says all that is wrong with its text, each fault with its line: unknown keys, wrong "
            "units, values out of range or at odds with each other, columns that are not there, nothing to compute. If "
            "the text has no fault, it says the first that is wrong with the rest: files that are missing, damaged or "
            "have changed, a motion that leaves them. It cannot know what shows in the sound itself only, such as "
            "clipping.\n"
            "Of a design (rasp-design(5)) it reads the scene of every stimulus so, and tells a fault that many have "
            "once.\n"
            "A scene or design without fault is reported on standard output as ok. The exit code is the worst of all.",
    .operands = "SCENE|DESIGN...",
    .least = 1,
    .most = -1,
    .options = options,
    .examples = "rasp check scrape.yaml\n"
                "rasp check scenes/*.yaml\n"
                "rasp check --diagnostics=json scrape.yaml   # for editors and scripts\n"
                "rasp check --set motion.rate='4 Hz' scrape.yaml\n",
    .run = check_run,
};

/* See check_design.h. */
#include "cmd/check_design.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "batch/design.h"
#include "batch/lengths.h"
#include "cmd/tell.h"
#include "file/wav_check.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

enum { FAULTS = 20 /* that are told */ };

struct fault {
    struct arena *arena;      /* of the first stimulus that has it                     */
    const struct diag *diag;
    const char *messages;     /* of its scene's text; "": the error is of another kind */
    struct err err;
    int n, first;
};

struct faults {
    const struct design *design;
    struct lengths lengths;
    struct fault *all;
    int n, stimuli, worst, recordings;
};

static bool recording_good(const char *file, struct err *e)
{
    return access(file, R_OK) == 0 ? wav_check(file, e) : err_set(e, ERR_INPUT, "%s: %s", file, strerror(errno));
}

/* What is wrong with stimulus i; false: something is. */
static bool stimulus_good(struct faults *x, int i, struct fault *f)
{
    const struct design *d = x->design;
    struct plan_scene_estimate estimate;
    struct scene s, kept;
    const char *recording = d->stimuli[i].recording;
    f->messages = "";
    x->recordings += recording != NULL;
    if (recording)
        return recording_good(recording, &f->err) || design_scene_recording(d, i, &f->err);
    bool read = design_scene(d, i, f->arena, &s, &f->messages, &f->err);
    f->diag = s.diag;
    if (!read || !((promise_keep(&s, f->arena, &kept, NULL, &f->err) && plan_scene_estimate(&kept, f->arena, &estimate, &f->err)) || scene_places_tell(&s, &f->err)))
        return false;
    if (estimate.sounds)
        lengths_add(&x->lengths, i, (double)estimate.length.frames / kept.output.sample_rate);
    return true;
}

static void fault_add(struct faults *x, struct fault *f)
{
    x->stimuli++;
    x->worst = (int)f->err.kind > x->worst ? (int)f->err.kind : x->worst;
    for (int i = 0; i < x->n; i++)
        if (strcmp(x->all[i].messages, f->messages) == 0 && (*f->messages || strcmp(x->all[i].err.text, f->err.text) == 0)) {
            x->all[i].n++;
            return;
        }
    if (x->n == FAULTS)
        return;
    x->all[x->n++] = *f;
    f->arena = NULL;
}

/* "wood_1Hz", "wood_1Hz and 59 more" */
static const char *whose(const struct faults *x, const struct fault *f)
{
    const char *name = x->design->stimuli[f->first].name;
    return f->n > 1 ? arena_format(f->arena, "%s and %d more", name, f->n - 1) : name;
}

static void fault_tell(struct cmd_call *c, const struct faults *x, const struct fault *f)
{
    struct err told = {0};
    if (*f->messages) {
        tell_scene(c, f->diag, f->messages, f->err.kind);
        err_set(&told, f->err.kind, "%s: the scene of %s is not valid", x->design->file, whose(x, f));
    } else
        err_set(&told, f->err.kind, "%s (%s)", f->err.text, whose(x, f));
    told.place = *f->messages ? told.place : f->err.place;
    tell_error(c, "check", &told);
}

static bool faults_tell(struct cmd_call *c, struct faults *x, struct err *e)
{
    for (int i = 0; i < x->n; i++) {
        fault_tell(c, x, &x->all[i]);
        arena_close(x->all[i].arena);
    }
    return x->stimuli == 0 || err_set(e, (enum err_kind)x->worst, "%s: %d of %d stimuli cannot be rendered", x->design->file, x->stimuli, x->design->n_stimuli);
}

bool check_design(struct cmd_call *c, const char *file, const char **remark, struct err *e)
{
    struct design d;
    const char *messages;
    struct err cause = {0};
    if (args_given(&c->args, "set") || args_given(&c->args, "seed"))
        return err_set(e, ERR_USAGE, "%s is a design: --set and --seed change scenes; write set: and seed: into it", file);
    if (!design_read(file, c->arena, &d, &messages, &cause)) {
        tell_scene(c, d.diag, messages, cause.kind);
        return err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_INPUT ? "cannot be read" : "is not a valid design");
    }
    struct faults x = {.design = &d, .all = ARENA_TAKE(c->arena, struct fault, FAULTS)};
    for (int i = 0; i < d.n_stimuli; i++) {
        struct fault f = {.arena = arena_open(), .n = 1, .first = i};
        if (!stimulus_good(&x, i, &f))
            fault_add(&x, &f);
        arena_close(f.arena);
    }
    if (!x.recordings && !x.stimuli) /* how long recordings are is not read */
        *remark = lengths_told(&x.lengths, &d, c->arena);
    return faults_tell(c, &x, e);
}

/* See plan_scene.h. The parts of a render are opened and closed again; what they write into their tables goes nowhere.
 */
#include "pipeline/plan_scene.h"

#include "base/memory.h"
#include "output/sound.h"
#include "pipeline/inputs.h"
#include "pipeline/render_parts.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static bool open_part(const struct scene *s, struct render_part *one, FILE *nowhere, struct err *e)
{
    one->rows.stream = one->impacts.stream = nowhere;
    if (!one->plan.targets) return true;
    one->open = run_open(&one->run, &one->plan, s, &(struct run_sinks){&one->rows, &one->impacts}, e);
    return one->open;
}

static const char **warnings_of(const struct render_parts *p, struct arena *a)
{
    enum { MOST = (int)(sizeof((struct board *)0)->warnings / sizeof((struct board *)0)->warnings[0]) };
    const char **all = ARENA_TAKE(a, const char *, p->scene->n_contacts *MOST + 1);
    int n = 0;
    for (int i = 0; i < p->scene->n_contacts; i++) {
        const struct board *b = &p->parts[i].run.board;
        for (int k = 0; p->parts[i].open && k < b->n_warnings && k < MOST; k++)
            all[n++] = arena_text(a, b->warnings[k]); /* the text ends with its run */
    }
    return all;
}

/* What is found of all parts goes into x, but for the cost. */
static bool open_parts(struct render_parts *p, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    FILE *nowhere = memory_fopen("/dev/null", "w");
    bool ok = nowhere || err_set(e, ERR_IO, "/dev/null cannot be opened");
    for (int i = 0; ok && i < p->scene->n_contacts; i++)
        ok = open_part(p->scene, &p->parts[i], nowhere, e);
    ok = ok && render_parts_agree(p, e) && render_parts_length(p, &x->length, e);
    x->quantity = ok ? render_parts_quantity(p) : -1;
    x->warnings = warnings_of(p, a);
    render_parts_close(p);
    if (nowhere) fclose(nowhere);
    return ok;
}

const struct plan *plan_scene(const struct scene *s, struct arena *a, const char ***warnings, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    struct plan *plans = ARENA_TAKE(a, struct plan, s->n_contacts);
    struct plan_scene_estimate x;
    if (!inputs_check(s, a, e) || !render_parts_plan(&p, e) || !open_parts(&p, a, &x, e) ||
        (p.asked & ITEM_BIT(ITEM_SOUND) && !sound_long_enough(s, x.length.frames, e)))
        return NULL;
    for (int i = 0; i < s->n_contacts; i++)
        plans[i] = p.parts[i].plan;
    *warnings = x.warnings;
    return plans;
}

bool plan_scene_estimate(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    if (!inputs_check(s, a, e) || !render_parts_plan(&p, e) || !open_parts(&p, a, x, e)) return false;
    x->cycles = 0;
    x->sounds = p.asked & ITEM_BIT(ITEM_SOUND);
    for (int i = 0; i < s->n_contacts; i++)
        for (int k = 0; k < p.parts[i].plan.n; k++)
            x->cycles += p.parts[i].plan.rows[k].verdict == PLAN_RUNS
                             ? p.parts[i].plan.rows[k].work * (double)x->length.frames
                             : 0;
    return true;
}

static bool add_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    bool ok = render_parts_plan(&p, e);
    for (int i = 0; ok && i < s->n_contacts; i++)
        *knobs |= plan_knobs(&p.parts[i].plan);
    return ok;
}

bool plan_scene_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    *knobs = 0;
    if (!inputs_check(s, a, e) || !add_knobs(s, a, knobs, e)) return false;
    for (int i = 0; keys_presets[i]; i++) {
        struct scene other = *s;
        struct err refused = {0};
        accuracy_preset(&other.accuracy, keys_presets[i]);
        add_knobs(&other, a, knobs, &refused);
    }
    return true;
}
